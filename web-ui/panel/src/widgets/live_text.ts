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
    if (this.node.data !== text) this.node.data = text;
  }
}

/** Sets an attribute only when it differs: each set costs a style calculation. */
export function setAttribute(element: Element, name: string, value: string): void {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}
