// What is drawn over a picture: the rectangles, what they mean, and the same as a table.
import { css, html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { Overlay, Value, WidgetHost } from '../../contract';
import { significantText } from '../../core/units';
import { EndingElement } from '../ending_element';
import { layerStyles } from '../layer_styles';
import { LiveText } from '../live_text';
import { widgetStyles } from '../styles';
import { fieldOf, isCertain, itemKey, numberOf, textOf, titleOf } from '../things';
import { words } from '../value_text';
import { OverlayHistory } from './history';
import { Painter, type Mark } from './painter';
import { seam, strokeOf } from './strokes';

/** s: what is older than the picture is drawn no longer than that. */
const longest = 0.5;
/** A table that is read needs no 15 pictures a second. */
const table_period_ms = 500;
const most_rows = 100;

/** What a thing is whose class has no name. */
const nameless = 'other';

/** One overlay of the row. */
interface Layer {
  readonly overlay: Overlay;
  readonly title: string;
  /** Names of the classes, as they are drawn; one without a name where there are none. Behind them comes what has none. */
  readonly classes: readonly string[];
  /** Number of the first class among those of all layers. */
  readonly first: number;
  readonly histories: ReadonlyMap<string, OverlayHistory>;
  shown: boolean;
  end: (() => void)[];
}

interface Drawn extends Mark {
  readonly layer: Layer;
  readonly kind: string;
  readonly said: string;
  readonly age: number;
  /** As the slot tells it; NaN: it does not. */
  readonly weighs: number;
}

export interface Picture {
  /** ns, when it was taken. */
  readonly time: number;
  /** Pixels of the slot's picture. */
  readonly width: number;
  readonly height: number;
}

export class Overlays extends EndingElement {
  static override styles = [
    widgetStyles,
    layerStyles,
    css`
      .sample svg {
        width: 36px;
        height: 14px;
      }
    `,
  ];

  host!: WidgetHost;
  overlays: readonly Overlay[] = [];
  /** Over the picture. */
  svg!: SVGElement;
  /** Of the picture. */
  label = '';

  private layers: readonly Layer[] = [];
  private painter: Painter | undefined;
  private picture: Picture | undefined;
  private shownWidth = 0;
  private isActive = false;
  private drawn: readonly Drawn[] = [];
  private states: readonly LiveText[] = [];
  private isDue = false;
  private open = false;
  private tableTimer: ReturnType<typeof setTimeout> | undefined;

  override connectedCallback(): void {
    super.connectedCallback();
    this.painter ??= new Painter(this.svg);
    if (this.layers.length === 0) this.layers = this.makeLayers();
    this.active = true;
    this.until(() => {
      this.active = false;
      clearTimeout(this.tableTimer);
      this.tableTimer = undefined;
    });
  }

  /** While nobody sees the picture, nothing is asked for. */
  set active(active: boolean) {
    if (active === this.isActive) return;
    this.isActive = active;
    for (const layer of this.layers) this.follow(layer);
    if (!active) this.present(undefined);
  }

  /** Another picture is seen from now on; undefined: none. */
  present(picture: Picture | undefined): void {
    this.picture = picture;
    this.size();
    this.schedule();
  }

  /** How wide the picture is shown, px of the screen. */
  set width(shown: number) {
    this.shownWidth = shown;
    this.size();
    this.schedule();
  }

  private size(): void {
    if (this.picture) this.painter?.resize(this.picture.width, this.picture.height, this.shownWidth);
  }

  private makeLayers(): Layer[] {
    let first = 0;
    return this.overlays.map((overlay) => {
      const classes = this.classesOf(overlay);
      const layer = {
        overlay, classes, first, title: titleOf(overlay), shown: overlay.shown, end: [],
        histories: new Map(overlay.slots.map((slot) => [slot, new OverlayHistory(overlay)] as const)),
      };
      first += classes.length + 1;
      return layer;
    });
  }

  private classesOf(overlay: Overlay): string[] {
    const { class: field, classes, empty } = overlay;
    if (field === undefined) return [''];
    const item = this.host.item(itemKey(overlay, field));
    if (item?.scalar === 'bool') return [words(field), `not ${words(field)}`];
    const known = classes ?? item?.values ?? [];
    return known.filter((name) => empty?.field !== field || name !== empty.value);
  }

  /** Which of the layer's classes a thing is of; their number: of none. */
  private classOf(layer: Layer, thing: Value): number {
    const { class: field, classes } = layer.overlay;
    if (field === undefined) return 0;
    const value = fieldOf(thing, field);
    if (typeof value === 'boolean') return value ? 0 : 1;
    const name = typeof value === 'number' ? classes?.[value] : value;
    const place = layer.classes.findIndex((one) => one === name);
    return place < 0 ? layer.classes.length : place;
  }

  /** Begins or ends to ask for what the layer shows. */
  private follow(layer: Layer): void {
    layer.end.splice(0).forEach((end) => end());
    if (!this.isActive || !layer.shown) return;
    for (const [slot, history] of layer.histories) {
      layer.end.push(this.host.watch(`slot:${slot}`, (reading) => {
        history.take(reading);
        this.schedule();
      }, { rate: 60 }));
    }
  }

  /** Once for all readings that come in one frame of the screen. */
  private schedule(): void {
    if (this.isDue) return;
    this.isDue = true;
    queueMicrotask(() => {
      this.isDue = false;
      this.draw();
    });
  }

  private draw(): void {
    const drawn: Drawn[] = [];
    this.layers.forEach((layer, i) => {
      const before = drawn.length;
      if (layer.shown && this.picture) this.add(layer, this.picture, drawn);
      this.say(i, this.stateOf(layer, drawn.slice(before)));
    });
    this.drawn = drawn;
    this.painter?.draw(drawn);
    if (this.open) this.tableTimer ??= setTimeout(() => this.writeTable(), table_period_ms);
  }

  private add(layer: Layer, picture: Picture, drawn: Drawn[]): void {
    const { overlay } = layer;
    const [left = '', top = '', width = '', height = ''] = overlay.rectangle;
    const found = [...layer.histories.values()].flatMap((history) => {
      const one = history.of(picture.time);
      return one && one.age <= longest ? one.things.map((thing) => ({ thing, age: one.age })) : [];
    });
    const weights = found.map(({ thing }) => (overlay.weight === undefined ? Number.NaN : numberOf(thing, overlay.weight)));
    const heaviest = Math.max(...weights.filter((weight) => Number.isFinite(weight)), 0);
    found.forEach(({ thing, age }, i) => {
      const box = {
        left: numberOf(thing, left), top: numberOf(thing, top), width: numberOf(thing, width), height: numberOf(thing, height),
      };
      // Without an extent the picture does not show it.
      if (!Object.values(box).every(Number.isFinite) || box.width <= 0 || box.height <= 0) return;
      const kind = this.classOf(layer, thing);
      const certain = isCertain(overlay, thing);
      const said = textOf(overlay, thing);
      const weighs = weights[i] ?? Number.NaN;
      drawn.push({
        ...box, layer, age, certain, said, weighs, stroke: strokeOf(layer.first + kind), kind: words(layer.classes[kind] ?? nameless),
        text: certain ? said : `${said}?`, old: age > 0,
        weight: overlay.weight === undefined ? undefined : heaviest > 0 && weighs > 0 ? weighs / heaviest : 0,
      });
    });
  }

  private stateOf(layer: Layer, drawn: readonly Drawn[]): { readonly text: string; readonly old: boolean } {
    if (!layer.shown) return { text: 'hidden', old: false };
    if (!this.picture) return { text: 'no picture yet', old: false };
    const ages = [...layer.histories.values()].map((history) => history.of(this.picture!.time)?.age);
    const known = ages.filter((age): age is number => age !== undefined);
    if (known.length === 0) {
      const reasons = [...layer.histories.values()].map((history) => history.reason).filter((reason) => reason !== '');
      return reasons.length === ages.length ? { text: `— ${reasons[0]}`, old: false } : { text: '⚠ nothing of this picture', old: true };
    }
    const freshest = Math.min(...known);
    if (freshest > longest) return { text: `⚠ nothing of this picture; the last is ${seconds(freshest)} older`, old: true };
    const oldest = Math.max(freshest, ...drawn.map((one) => one.age));
    if (oldest > 0) return { text: `⚠ ${drawn.length} drawn, up to ${seconds(oldest)} older than the picture`, old: true };
    return { text: `${drawn.length} drawn`, old: false };
  }

  private say(index: number, { text, old }: { readonly text: string; readonly old: boolean }): void {
    const state = this.states[index];
    if (!state || state.text === text) return;
    state.text = text;
    this.renderRoot.querySelectorAll('.state')[index]?.classList.toggle('abnormal', old);
  }

  private toggle(layer: Layer, shown: boolean): void {
    layer.shown = shown;
    this.follow(layer);
    this.schedule();
  }

  private writeTable(): void {
    this.tableTimer = undefined;
    this.requestUpdate();
  }

  protected override firstUpdated(): void {
    this.states = [...this.renderRoot.querySelectorAll('.state')].map((element) => new LiveText(element));
    this.schedule();
  }

  protected override render(): TemplateResult {
    return html`
      <ul aria-label="Drawn over ${this.label}">
        ${this.layers.map((layer) => html`
          <li>
            <label>
              <input
                type="checkbox"
                .checked=${layer.shown}
                @change=${(event: Event) => this.toggle(layer, (event.target as HTMLInputElement).checked)}
              />${layer.title}
            </label>
            <span>
              ${layer.classes.map((name, kind) => this.sample(name, layer.first + kind))}
              ${layer.overlay.classes ? this.sample(nameless, layer.first + layer.classes.length) : nothing}
            </span>
            <span class="state"></span>
          </li>
        `)}
      </ul>
      <details @toggle=${(event: Event) => this.turn((event.target as HTMLDetailsElement).open)}>
        <summary>What is drawn, as a table</summary>
        ${this.open ? this.table() : nothing}
      </details>
    `;
  }

  private turn(open: boolean): void {
    this.open = open;
    this.requestUpdate();
  }

  private sample(name: string, kind: number): TemplateResult {
    const { colour, dashes } = strokeOf(kind);
    return html`<span class="sample">
      <svg viewBox="0 0 36 14" aria-hidden="true">
        <rect width="36" height="14" fill=${seam} />
        <line x1="2" x2="34" y1="7" y2="7" stroke-width="3" stroke=${colour} stroke-dasharray=${dashes || 'none'} />
      </svg>${words(name)}
    </span>`;
  }

  private table(): TemplateResult {
    const left = this.drawn.length - most_rows;
    return html`
      <div class="scroll" tabindex="0" role="region" aria-label="Drawn over ${this.label}">
        <table>
          <caption>${this.label}: ${this.drawn.length} drawn, in pixels of the picture${left > 0 ? `; ${left} more than these` : ''}</caption>
          <thead>
            <tr>
              ${['Overlay', 'Kind', 'Text', 'Left', 'Top', 'Width', 'Height', 'Weight', 'Certain', 'Older than the picture'].map((name) => html`<th scope="col">${name}</th>`)}
            </tr>
          </thead>
          <tbody>
            ${this.drawn.slice(0, most_rows).map((one) => html`
              <tr>
                <th scope="row">${one.layer.title}</th>
                <td>${one.kind}</td>
                <td>${one.said}</td>
                ${[one.left, one.top, one.width, one.height].map((value) => html`<td class="number">${Math.round(value)}</td>`)}
                <td class="number">${Number.isFinite(one.weighs) ? significantText(one.weighs, 3) : ''}</td>
                <td>${one.certain ? 'yes' : 'no'}</td>
                <td>${one.old ? seconds(one.age) : 'no'}</td>
              </tr>
            `)}
          </tbody>
        </table>
      </div>
    `;
  }
}

function seconds(age: number): string {
  return `${age.toFixed(2)} s`;
}

customElements.define('flexrf-overlays', Overlays);
