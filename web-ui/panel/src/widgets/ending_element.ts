// An element that ends, when it leaves the document, what it began when it came into it.
import { LitElement } from 'lit';

export abstract class EndingElement extends LitElement {
  private endings: (() => void)[] = [];

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.endings.splice(0).forEach((end) => end());
  }

  /** Does this when it leaves; called from connectedCallback on. */
  protected until(end: () => void): void {
    this.endings.push(end);
  }
}
