// Rectangles and their texts in an SVG that lies over the picture; its units are the picture's pixels.
import { setAttribute } from '../live_text';
import { seam, type Stroke } from './strokes';

const namespace = 'http://www.w3.org/2000/svg';
const thin = 1.5; // px of the screen
const thick = 4;
const plain = 2.5;
const letters = 14;
const seam_width = 2.5;

export interface Mark {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
  readonly stroke: Stroke;
  /** 0 to 1: how thick; undefined: as any. */
  readonly weight: number | undefined;
  readonly text: string;
  readonly certain: boolean;
  /** It was found in a picture before this one. */
  readonly old: boolean;
}

interface Elements {
  readonly whole: SVGElement;
  readonly behind: SVGElement;
  readonly line: SVGElement;
  readonly text: SVGElement;
}

function make(name: string, parent: Element, attributes: { readonly [name: string]: string } = {}): SVGElement {
  const element = document.createElementNS(namespace, name);
  for (const [attribute, value] of Object.entries(attributes)) element.setAttribute(attribute, value);
  parent.append(element);
  return element;
}

export class Painter {
  #elements: Elements[] = [];
  /** Pixels of the picture for one of the screen. */
  #scale = 1;

  constructor(private readonly svg: Element) {}

  /** The picture's pixels, and how wide it is shown. */
  resize(width: number, height: number, shown: number): void {
    setAttribute(this.svg, 'viewBox', `0 0 ${width} ${height}`);
    if (shown > 0) this.#scale = width / shown;
    setAttribute(this.svg, 'font-size', String(letters * this.#scale));
    setAttribute(this.svg, 'stroke-width', String(seam_width * this.#scale)); // of texts
  }

  draw(marks: readonly Mark[]): void {
    while (this.#elements.length < marks.length) this.#elements.push(this.#add());
    this.#elements.forEach((elements, i) => {
      const mark = marks[i];
      setAttribute(elements.whole, 'visibility', mark ? 'visible' : 'hidden');
      if (mark) this.#write(elements, mark);
    });
  }

  #add(): Elements {
    const whole = make('g', this.svg);
    const line = { fill: 'none', 'vector-effect': 'non-scaling-stroke' };
    return {
      whole,
      behind: make('rect', whole, { ...line, stroke: seam }),
      line: make('rect', whole, line),
      text: make('text', whole, { stroke: seam, 'paint-order': 'stroke', 'stroke-linejoin': 'round', 'font-weight': '600' }),
    };
  }

  #write({ whole, behind, line, text }: Elements, mark: Mark): void {
    setAttribute(whole, 'opacity', String((mark.old ? 0.45 : 1) * (mark.certain ? 1 : 0.65)));
    for (const rectangle of [behind, line]) {
      for (const [name, value] of [['x', mark.left], ['y', mark.top], ['width', mark.width], ['height', mark.height]] as const)
        setAttribute(rectangle, name, String(value));
    }
    const width = mark.weight === undefined ? plain : thin + (thick - thin) * mark.weight;
    setAttribute(behind, 'stroke-width', String(width + 2));
    setAttribute(line, 'stroke-width', String(width));
    setAttribute(line, 'stroke', mark.stroke.colour);
    setAttribute(line, 'stroke-dasharray', mark.stroke.dashes || 'none');
    const above = mark.top - 4 * this.#scale;
    const fits = above > letters * this.#scale;
    setAttribute(text, 'x', String(mark.left + (fits ? 0 : 4 * this.#scale)));
    setAttribute(text, 'y', String(fits ? above : mark.top + (letters + 2) * this.#scale));
    setAttribute(text, 'fill', mark.stroke.colour);
    if (text.textContent !== mark.text) text.textContent = mark.text;
  }
}
