// Text that changes many times a second: one Text node, written only when it differs.

/** A Text node at the end of an element that no template writes into. */
export class LiveText {
  private readonly node: Text;

  constructor(parent: Element, text = '') {
    this.node = parent.ownerDocument.createTextNode(text);
    parent.append(this.node);
  }

  get text(): string {
    return this.node.data;
  }
  set text(text: string) {
    if (this.node.data !== text) this.write(text);
  }

  protected write(text: string): void {
    this.node.data = text;
  }
}

/**
 * In a box of its own that is as wide as the longest text so far: a new text is laid out by itself, and neither moves nor
 * measures its neighbours. For text in tabular figures.
 */
export class BoxedText extends LiveText {
  private width = 0;

  constructor(private readonly box: HTMLElement) {
    super(box);
  }

  protected override write(text: string): void {
    if (text.length > this.width) {
      this.width = text.length;
      this.box.style.width = `${text.length}ch`;
    }
    super.write(text);
  }
}

/** Sets an attribute only when it differs: each set costs a style calculation. */
export function setAttribute(element: Element, name: string, value: string): void {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}
