// A vector or matrix: a grid of cells, each with its index.
import { css, html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { ItemInfo, Value } from '../contract';
import { lastOf } from '../core/value_path';
import { BoxedText } from './live_text';
import { Quantity } from './quantity';
import { scalarText } from './value_text';
import { widgetStyles } from './styles';
import { WidgetBase, dash } from './widget_base';

/** More would neither be read nor drawn in time. */
export const most_cells = 64;

/** Rows and columns that are shown of an array; a vector is one row. */
export function gridOf(item: ItemInfo): { rows: number; columns: number; left: number } {
  const [first = 0, second] = item.shape;
  const rows = second === undefined ? 1 : Math.min(first, most_cells);
  const columns = Math.min(second ?? first, second === undefined ? most_cells : Math.max(1, Math.floor(most_cells / rows)));
  const all = item.shape.reduce((product, length) => product * length, 1);
  return { rows, columns, left: all - rows * columns };
}

/** What stands above an element of a vector: its index, or the axis where the name says that it is one. */
export function elementName(item: ItemInfo, index: number): string {
  const name = lastOf(item.key);
  if (item.shape.length === 1) {
    if (item.shape[0] === 3 && name === 'position') return 'xyz'.charAt(index);
    if (item.shape[0] === 4 && name === 'orientation') return 'xyzw'.charAt(index);
  }
  return String(index);
}

/** The element of a decoded array. */
export function elementAt(value: Value | null, row: number, column: number, matrix: boolean): Value | undefined {
  if (!Array.isArray(value)) return undefined;
  if (!matrix) return value[column];
  const cells = value[row];
  return Array.isArray(cells) ? cells[column] : undefined;
}

export const arrayStyles = css`
  .cells {
    display: flex;
    align-items: flex-end;
    flex-wrap: wrap;
    gap: 2px var(--gap);
    justify-content: flex-end;
  }
  .cell {
    text-align: right;
  }
  .index {
    display: block;
    color: var(--muted);
    font-size: 0.8em;
  }
  .scroll {
    overflow-x: auto;
    max-width: 100%;
  }
  table {
    border-collapse: collapse;
  }
  th {
    color: var(--muted);
    font-weight: normal;
    font-size: 0.8em;
  }
  td {
    text-align: right;
    padding: 1px 0.4em;
  }
`;

export class ArrayReadout extends WidgetBase {
  static override styles = [widgetStyles, arrayStyles];
  private cells: BoxedText[] = [];
  /** One for each element, where they have different units. */
  private each: Quantity[] = [];

  protected override prepare(): void {
    super.prepare();
    const { item } = this;
    this.each = item?.units?.map((unit) => new Quantity({ scalar: item.scalar, unit })) ?? [];
  }

  protected override render(): TemplateResult {
    const item = this.item;
    if (!item) return this.frame(html``);
    const { rows, columns, left } = gridOf(item);
    const grid = item.shape.length === 2 ? this.table(rows, columns) : this.list(item, columns);
    const more = left > 0 ? html`<span>… and ${left} more</span>` : nothing;
    return this.frame(html`${grid}`, '', html`${more}`);
  }

  private list(item: ItemInfo, columns: number): TemplateResult {
    return html`<span class="cells">
      ${Array.from(
        { length: columns },
        (_, i) => html`<span class="cell"><span class="index">${elementName(item, i)}</span><span class="value boxed"></span>${this.unitOf(i)}</span>`,
      )}${this.each.length === 0 ? this.unitMark() : nothing}
    </span>`;
  }

  private unitOf(element: number): TemplateResult | typeof nothing {
    const quantity = this.each[element];
    return quantity ? html` <span class="unit">${quantity.unit}</span>` : nothing;
  }

  private table(rows: number, columns: number): TemplateResult {
    const heads = Array.from({ length: columns }, (_, column) => html`<th scope="col">${column}</th>`);
    return html`<div class="scroll" tabindex="0" role="region" aria-labelledby="label">
      <table>
        <thead><tr><td></td>${heads}</tr></thead>
        <tbody>
          ${Array.from(
            { length: rows },
            (_, row) => html`<tr>
              <th scope="row">${row}</th>
              ${heads.map(() => html`<td><span class="value boxed"></span></td>`)}
            </tr>`,
          )}
        </tbody>
      </table>
    </div>${this.unitMark()}`;
  }

  protected override firstUpdated(): void {
    this.cells = [...this.renderRoot.querySelectorAll<HTMLElement>('.value')].map((cell) => new BoxedText(cell));
    super.firstUpdated();
  }

  protected override show(value: Value | null): void {
    const item = this.item;
    if (!item) return;
    const matrix = item.shape.length === 2;
    const { columns } = gridOf(item);
    if (Array.isArray(value)) this.quantity.seeAll(value);
    this.cells.forEach((cell, i) => {
      const element = elementAt(value, Math.floor(i / columns), i % columns, matrix);
      cell.text = element === undefined || element === null ? dash : scalarText(item, this.each[i] ?? this.quantity, element);
    });
  }
}
