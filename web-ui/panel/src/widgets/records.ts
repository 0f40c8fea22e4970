// An array of structures as a table: a row for each element, a column for each member.
import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { ItemInfo, Value } from '../contract';
import { lastOf } from '../core/value_path';
import { arrayStyles, most_cells } from './array_readout';
import { LiveText } from './live_text';
import { Quantity } from './quantity';
import { scalarText } from './value_text';
import { widgetStyles } from './styles';
import { WidgetBase, dash } from './widget_base';

export class Records extends WidgetBase {
  static override styles = [widgetStyles, arrayStyles];
  private columns: readonly { item: ItemInfo; quantity: Quantity }[] = [];
  private cells: LiveText[] = [];
  private rows = 0;

  protected override prepare(): void {
    super.prepare();
    if (!this.item) return;
    // The first element's members are those of all.
    const members = this.item.members ?? this.host.item(`${this.item.key}[0]`)?.members ?? [];
    this.columns = members.map((item) => ({ item, quantity: new Quantity(item) }));
    this.rows = Math.min(this.item.shape[0] ?? 0, Math.max(1, Math.floor(most_cells / Math.max(1, members.length))));
  }

  protected override render(): TemplateResult {
    const left = (this.item?.shape[0] ?? 0) - this.rows;
    return this.frame(
      html`<div class="scroll" tabindex="0" role="region" aria-labelledby="label">
        <table>
          <thead>
            <tr>
              <td></td>
              ${this.columns.map(({ item, quantity }) => html`<th scope="col">${item.label} ${quantity.unit}</th>`)}
            </tr>
          </thead>
          <tbody>
            ${Array.from(
              { length: this.rows },
              (_, row) => html`<tr>
                <th scope="row">${row}</th>
                ${this.columns.map(() => html`<td class="value"></td>`)}
              </tr>`,
            )}
          </tbody>
        </table>
      </div>`,
      '',
      left > 0 ? html`<span>… and ${left} more</span>` : html`${nothing}`,
    );
  }

  protected override watchOptions(): { rate: number } {
    return { rate: 10 };
  }

  protected override firstUpdated(): void {
    this.cells = [...this.renderRoot.querySelectorAll('.value')].map((cell) => new LiveText(cell));
    super.firstUpdated();
  }

  protected override show(value: Value | null): void {
    const records = Array.isArray(value) ? value : [];
    this.cells.forEach((cell, i) => {
      const column = this.columns[i % this.columns.length];
      const record = records[Math.floor(i / this.columns.length)];
      const name = column ? lastOf(column.item.key) : '';
      const member = typeof record === 'object' && !Array.isArray(record) ? record[name] : undefined;
      cell.text = column === undefined || member === undefined || member === null ? dash : scalarText(column.item, column.quantity, member);
    });
  }
}
