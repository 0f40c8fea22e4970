// The widget of one item, or of a row [widget.NAME], in a place of its own: made once, and again only when that is another.
import { LitElement, css, html } from 'lit';
import { property } from 'lit/decorators.js';
import type { ItemInfo, Placement, WidgetHost } from '../contract';
import type { Core } from '../core/core';

class WidgetPlace extends LitElement {
  static override styles = css`
    :host {
      display: block;
    }
  `;

  @property({ attribute: false }) core!: Core;
  /** One of the two. */
  @property({ attribute: false }) item: ItemInfo | undefined;
  @property({ attribute: false }) placement: Placement | undefined;
  /** Of widgets that are not to talk with the page's own host. */
  @property({ attribute: false }) host: WidgetHost | undefined;
  private made: ItemInfo | Placement | undefined;

  protected override render(): unknown {
    return html`<slot></slot>`;
  }

  protected override updated(): void {
    const { item, placement } = this;
    if (item && item !== this.made) void this.make((this.made = item), { item });
    if (placement && placement !== this.made) void this.make((this.made = placement), { placement });
  }

  private async make(made: ItemInfo | Placement, what: { item: ItemInfo } | { placement: Placement }): Promise<void> {
    const widget = await this.core.createWidget(what);
    if (this.made !== made) return;
    if (this.host) widget.host = this.host;
    this.replaceChildren(widget);
  }
}

customElements.define('flexrf-item', class extends WidgetPlace {});
customElements.define('flexrf-placement', class extends WidgetPlace {});
