// The widget of a row [widget.NAME], in a place of its own: made once, and again only when the row is another.
import { LitElement, css, html } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import type { Placement } from '../contract';
import type { Core } from '../core/core';

@customElement('flexrf-placement')
export class PlacementWidget extends LitElement {
  static override styles = css`
    :host {
      display: block;
    }
  `;

  @property({ attribute: false }) core!: Core;
  @property({ attribute: false }) placement!: Placement;
  private made: Placement | undefined;

  protected override render(): unknown {
    return html`<slot></slot>`;
  }

  protected override updated(): void {
    if (this.made === this.placement) return;
    this.made = this.placement;
    void this.make(this.placement);
  }

  private async make(placement: Placement): Promise<void> {
    const widget = await this.core.createWidget({ placement });
    if (this.made === placement) this.replaceChildren(widget);
  }
}
