// The members of a population, a row each: how it stands with them, what they are worth, what they cost, and their weights.
import { css, html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { ItemInfo, Value, WidgetElement } from '../contract';
import { addressOfRoute } from '../core/route';
import { lastOf } from '../core/value_path';
import { arrayStyles, most_cells } from './array_readout';
import { createBuiltIn } from './choose';
import { LiveText, setAttribute } from './live_text';
import { historyOf, linePath, type Judged } from './member_history';
import { Quantity } from './quantity';
import { nameIn, namesIn } from './row_options';
import { barStyles, widgetStyles } from './styles';
import { unitsOf } from './units_of';
import { scalarText, words } from './value_text';
import { WidgetBase, dash } from './widget_base';

type Fields = { readonly [field: string]: Value };

interface Column {
  readonly name: string;
  readonly item: ItemInfo;
  readonly quantity: Quantity;
}

interface Weight {
  readonly label: string;
  readonly summary: string;
  readonly quantity: Quantity;
  /** Without one the bars go by the largest weight that was seen. */
  readonly range: readonly [number, number] | undefined;
  seen: [number, number];
}

/** What of a row changes. */
interface RowParts {
  readonly row: HTMLElement;
  readonly identity: LiveText;
  readonly state: LiveText;
  readonly texts: readonly LiveText[];
  readonly line: Element;
  readonly weights: readonly { readonly bar: HTMLElement; readonly text: LiveText }[];
}

function fieldsOf(value: Value | null | undefined): Fields | undefined {
  return typeof value === 'object' && value !== null && !Array.isArray(value) ? value : undefined;
}

function numberOf(value: Value | undefined): number {
  return typeof value === 'number' ? value : Number.NaN;
}

export class Population extends WidgetBase {
  static override styles = [
    widgetStyles,
    arrayStyles,
    barStyles,
    css`
      .content > .scroll {
        flex: 1 1 100%;
      }
      th,
      td {
        padding: 2px 0.5em;
        text-align: start;
        white-space: nowrap;
        border-block-end: 1px solid var(--track);
      }
      thead th {
        vertical-align: bottom;
      }
      tbody th {
        font-size: 1em;
        color: var(--text);
      }
      .number,
      td.value {
        text-align: end;
      }
      .identity {
        color: var(--muted);
        font-size: 0.8em;
      }
      .state {
        min-width: 7em;
      }
      a {
        color: var(--focus);
        display: inline-block;
        min-height: 24px;
        line-height: 24px;
      }
      a:focus-visible {
        outline: 3px solid var(--focus);
      }
      svg {
        display: block;
        width: 7rem;
        height: 1.6em;
        background: var(--field);
      }
      path {
        fill: none;
        stroke: var(--fill);
        stroke-width: 2;
        stroke-linecap: round;
        stroke-linejoin: round;
        vector-effect: non-scaling-stroke;
      }
      /* Names stand upright: there are many, and their columns narrow. */
      .upright > span {
        writing-mode: vertical-rl;
        rotate: 180deg;
      }
      .weight {
        padding-inline: 3px;
        text-align: center;
      }
      .weight .bar {
        display: block;
        width: 3.2rem;
        min-width: 0;
      }
      .weight .value {
        font-size: 0.8em;
        line-height: 1.2;
      }
      .free {
        color: var(--muted);
      }
      .free svg,
      .free .bar {
        visibility: hidden;
      }
      .actions {
        display: flex;
        flex-wrap: wrap;
        gap: var(--gap);
        flex: 1 1 100%;
      }
      @media (pointer: coarse) {
        a {
          min-height: 44px;
          line-height: 44px;
        }
      }
      @media (forced-colors: active) {
        path {
          stroke: CanvasText;
        }
      }
    `,
  ];
  private actions: WidgetElement[] = [];
  private members: readonly string[] = [];
  private rows = 0;
  private columns: readonly Column[] = [];
  private weights: readonly Weight[] = [];
  private parts: RowParts[] = [];

  override connectedCallback(): void {
    const slot = this.placement?.slots['members'];
    const item = slot === undefined ? undefined : this.host.item(`slot:${slot}`);
    if (item) this.item = item;
    super.connectedCallback();
  }

  protected override prepare(): void {
    super.prepare();
    if (this.actions.length === 0) {
      this.actions = Object.values(this.placement?.parameters ?? {}).flatMap((key) => {
        const item = this.host.item(key);
        return item ? [createBuiltIn(this.host, item)] : [];
      });
    }
    const list = this.host.item(`${this.item?.key}.${this.listName}`);
    const population = nameIn(this.options, 'population');
    this.members = population === undefined ? [] : unitsOf(this.host, population).map((unit) => unit.name);
    const places = Math.min(list?.shape[0] ?? 0, most_cells);
    this.rows = this.members.length > 0 ? Math.min(places, this.members.length) : places;
    const fields = (list && this.host.item(`${list.key}[0]`)?.members) ?? [];
    const find = (name: string | undefined): ItemInfo | undefined => fields.find((field) => lastOf(field.key) === name);
    const shown = [nameIn(this.options, 'fitness'), nameIn(this.options, 'cost'), ...namesIn(this.options, 'columns')];
    this.columns = shown.flatMap((name) => {
      const item = find(name);
      return name === undefined || item === undefined ? [] : [{ name, item, quantity: new Quantity(item) }];
    });
    this.weights = this.weightsOf(find(nameIn(this.options, 'weights')));
  }

  private get listName(): string {
    return nameIn(this.options, 'list') ?? '';
  }

  /** Named by the row, or by the members of the structure that they are. */
  private weightsOf(item: ItemInfo | undefined): Weight[] {
    if (!item) return [];
    const names = namesIn(this.options, 'weight_names');
    const single: readonly ItemInfo[] = item.members ?? Array.from({ length: Math.min(item.shape[0] ?? 0, most_cells) }, (_, i) => {
      const name = names[i];
      const first = this.members[0];
      // A parameter of the members has a range.
      const parameter = name === undefined || first === undefined ? undefined : this.host.item(`${first}.${name}`);
      return parameter ?? { ...item, shape: [], label: name === undefined ? String(i) : words(name) };
    });
    return single.map((one) => ({
      label: one.label, summary: one.summary, range: one.range, seen: [0, 0],
      quantity: new Quantity({ scalar: one.scalar, unit: one.unit, ...(one.range && { range: one.range }) }, { decimals: 2 }),
    }));
  }

  protected override watchOptions(): { rate: number } {
    return { rate: 5 };
  }

  protected override render(): TemplateResult {
    const columns = this.columns.map(({ item, quantity }, i) => html`<th scope="col" class="number">${item.label} ${quantity.unit}</th>
      ${i === 0 ? html`<th scope="col">${this.hasGenerations ? 'Over generations' : 'Lately'}</th>` : nothing}`);
    return this.frame(html`<div class="scroll" tabindex="0" role="region" aria-labelledby="label">
        <table>
          <thead>
            <tr>
              <th scope="col">Member</th>
              <th scope="col">State</th>
              ${columns}
              ${this.weights.map((weight) => html`<th scope="col" class="weight upright" title=${weight.summary}>
                <span>${weight.label} ${weight.quantity.unit}</span>
              </th>`)}
            </tr>
          </thead>
          <tbody>
            ${Array.from({ length: this.rows }, (_, place) => this.row(place))}
          </tbody>
        </table>
      </div>
      <div class="actions">${this.actions}</div>`);
  }

  private row(place: number): TemplateResult {
    const name = this.members[place];
    return html`<tr class="free">
      <th scope="row">
        ${name === undefined ? place : html`<a href=${addressOfRoute({ view: 'units', path: [name] })}>${name}</a>`}
        <span class="identity"></span>
      </th>
      <td class="state"></td>
      ${this.columns.map((_, i) => html`<td class="value"></td>
        ${i === 0 ? html`<td><svg viewBox="-3 -6 106 112" preserveAspectRatio="none" aria-hidden="true"><path d="" /></svg></td>` : nothing}`)}
      ${this.weights.map(() => html`<td class="weight"><span class="bar" aria-hidden="true"><i></i></span><span class="value"></span></td>`)}
    </tr>`;
  }

  protected override firstUpdated(): void {
    this.parts = [...this.renderRoot.querySelectorAll<HTMLElement>('tbody > tr')].map((row) => ({
      row,
      identity: new LiveText(row.querySelector('.identity')!),
      state: new LiveText(row.querySelector('.state')!),
      texts: [...row.querySelectorAll('td.value')].map((cell) => new LiveText(cell)),
      line: row.querySelector('path') ?? row,
      weights: [...row.querySelectorAll('.weight')].map((cell) => ({
        bar: cell.querySelector<HTMLElement>('i')!, text: new LiveText(cell.querySelector('.value')!),
      })),
    }));
    super.firstUpdated();
  }

  private get hasGenerations(): boolean {
    return nameIn(this.options, 'generation') !== undefined;
  }

  protected override show(value: Value | null): void {
    const whole = fieldsOf(value);
    const list = whole?.[this.listName];
    const members = this.parts.map((_, place) => (Array.isArray(list) ? fieldsOf(list[place]) : undefined));
    const active = members.map((member) => this.isActive(member));
    this.columns.forEach(({ name, quantity }) => {
      quantity.seeAll(members.flatMap((member, place) => (active[place] ? [member?.[name] ?? 0] : [])));
    });
    if (whole) this.remember(whole, members, active);
    const history = historyOf(this.host, this.placement?.name ?? '');
    const [span, range] = [history.span, history.range];
    this.parts.forEach((parts, place) => {
      this.showMember(parts, members[place], active[place]!);
      setAttribute(parts.line, 'd', linePath(history.lines[place] ?? [], span, range));
    });
  }

  private isActive(member: Fields | undefined): boolean {
    const field = nameIn(this.options, 'active');
    return member !== undefined && (field === undefined || member[field] === true);
  }

  private remember(whole: Fields, members: readonly (Fields | undefined)[], active: readonly boolean[]): void {
    const generation = nameIn(this.options, 'generation');
    const at = generation === undefined ? Math.floor((this.reading?.sampledAt ?? 0) / 1e9) : numberOf(whole[generation]);
    const identity = nameIn(this.options, 'identity');
    const fitness = nameIn(this.options, 'fitness') ?? '';
    const judged = members.map((member, place): Judged => ({
      active: active[place]!, value: numberOf(member?.[fitness]), identity: identity === undefined ? 0 : numberOf(member?.[identity]),
    }));
    historyOf(this.host, this.placement?.name ?? '').note(at, judged);
  }

  private showMember(parts: RowParts, member: Fields | undefined, active: boolean): void {
    setAttribute(parts.row, 'class', active ? '' : 'free');
    parts.identity.text = active ? this.identityText(member!) : '';
    parts.state.text = member === undefined ? dash : active ? this.stateText(member) : 'not active';
    this.columns.forEach(({ name, item, quantity }, i) => {
      const value = active ? member![name] : undefined;
      parts.texts[i]!.text = value === undefined ? dash : scalarText(item, quantity, value);
    });
    const weights = active ? member![nameIn(this.options, 'weights') ?? ''] : undefined;
    const values = Array.isArray(weights) ? weights : Object.values(fieldsOf(weights) ?? {});
    this.weights.forEach((weight, i) => {
      const { bar, text } = parts.weights[i]!;
      const value = numberOf(values[i]);
      text.text = Number.isNaN(value) ? '' : weight.quantity.text(value);
      bar.style.transform = barTransform(weight, value);
    });
  }

  private identityText(member: Fields): string {
    const [identity, parent] = ['identity', 'parent'].map((option) => member[nameIn(this.options, option) ?? '']);
    if (identity === undefined) return '';
    return parent === undefined || parent === identity ? `no. ${identity}` : `no. ${identity}, child of ${parent}`;
  }

  private stateText(member: Fields): string {
    const told = namesIn(this.options, 'state').flatMap((name) => {
      const value = member[name];
      if (typeof value === 'string') return [words(value)];
      return value === true ? [words(name).replace(/^is /, '')] : [];
    });
    return told.length === 0 ? 'active' : told.join(', ');
  }
}

/** From zero, or the end of the range that is nearer to it, to the value. */
function barTransform(weight: Weight, value: number): string {
  if (!Number.isFinite(value)) return 'scaleX(0)';
  const { seen } = weight;
  seen[0] = Math.min(seen[0], value);
  seen[1] = Math.max(seen[1], value);
  const [low, high] = weight.range ?? seen;
  const share = (one: number): number => (high > low ? Math.min(1, Math.max(0, (one - low) / (high - low))) : 0);
  const [from, to] = [share(0), share(value)];
  return `translateX(${(100 * Math.min(from, to)).toFixed(1)}%) scaleX(${Math.abs(to - from).toFixed(3)})`;
}
