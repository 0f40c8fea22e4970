// The widget of one item, in a place of its own: made once, and again only when the item is another.
import { LitElement, css, html } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import type { ItemInfo, WidgetHost } from '../contract';
import type { Core } from '../core/core';

@customElement('flexrf-item')
export class ItemWidget extends LitElement {
  static override styles = css`
    :host {
      display: block;
    }
  `;

  @property({ attribute: false }) core!: Core;
  @property({ attribute: false }) item!: ItemInfo;
  /** Of widgets that are not to talk with the page's own host. */
  @property({ attribute: false }) host: WidgetHost | undefined;

  private made: ItemInfo | undefined;

  protected override render(): unknown {
    return html`<slot></slot>`;
  }

  protected override updated(): void {
    if (this.made === this.item) return;
    this.made = this.item;
    void this.make(this.item);
  }

  private async make(item: ItemInfo): Promise<void> {
    const widget = await this.core.createWidget({ item });
    if (this.made !== item) return;
    if (this.host !== undefined) widget.host = this.host;
    this.replaceChildren(widget);
  }
}
