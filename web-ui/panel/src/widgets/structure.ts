// A structure as the group of its members, or an array as that of its elements, each with a widget of its own.
import { css, html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { ItemInfo, WidgetElement } from '../contract';
import { most_cells } from './array_readout';
import { createBuiltIn } from './choose';
import { widgetStyles } from './styles';
import { WidgetBase } from './widget_base';

export class Structure extends WidgetBase {
  static override styles = [
    widgetStyles,
    css`
      fieldset {
        border: 1px solid var(--track);
        border-radius: var(--radius);
        margin: 0;
        padding: 0.25em 0.75em 0.5em;
        min-width: 0;
      }
      legend {
        color: var(--muted);
        padding: 0 0.25em;
      }
      .members {
        display: grid;
        gap: var(--gap);
      }
    `,
  ];
  private members: WidgetElement[] = [];

  protected override prepare(): void {
    super.prepare();
    if (this.members.length > 0) return;
    this.members = this.parts().map((item) => createBuiltIn(this.host, item));
  }

  private parts(): readonly ItemInfo[] {
    const item = this.item;
    if (!item || item.shape.length === 0) return item?.members ?? [];
    const elements = Array.from({ length: Math.min(item.shape[0]!, most_cells) }, (_, i) => this.host.item(`${item.key}[${i}]`));
    return elements.filter((element) => element !== undefined);
  }

  /** The members watch for themselves. */
  protected override begin(): void {}
  protected override show(): void {}

  protected override render(): TemplateResult {
    return html`<fieldset aria-describedby="summary">
      <legend id="label" title=${this.item?.summary ?? ''}>${this.label}</legend>
      ${this.note === '' ? nothing : html`<div class="notes"><span class="note">${this.note}</span></div>`}
      <div class="members">${this.members}</div>
      <span id="summary" class="hidden">${this.item?.summary ?? ''}</span>
    </fieldset>`;
  }
}
