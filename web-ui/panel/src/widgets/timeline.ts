// Which unit worked when: members of populations and units, a row each, over the last frames; beside it what each came to.
import { css, html, nothing, svg } from 'lit';
import type { TemplateResult } from 'lit';
import type { ItemInfo, Reading, Value } from '../contract';
import { addressOfRoute } from '../core/route';
import { significantText } from '../core/units';
import { lastOf, partOf, partsOf } from '../core/value_path';
import { arrayStyles } from './array_readout';
import { Quantity } from './quantity';
import { nameIn, namesIn } from './row_options';
import { widgetStyles } from './styles';
import { unitsOf, type UnitInfo } from './units_of';
import { absence, scalarText, words } from './value_text';
import { WidgetBase, dash } from './widget_base';
import { workPath, WorkTrace, type Work } from './work_trace';

/** More rows would neither be read nor drawn in time. */
const most_rows = 64;
const width = 1000;
/** Updates a second. */
const rate = 4;
/** Steps of a thread that are kept while no frame is known. */
const most_steps = 4000;

/** A row of the list `threads`, as far as it is of use here. */
interface ThreadRow {
  readonly name: string;
  /** Of a thread that polls by back-off: what it learned of the time between arrivals; 0: nothing yet. */
  readonly backoff?: { readonly mean_ns: number; readonly spread_ns: number } | null;
}

interface Field {
  readonly path: string;
  readonly item: ItemInfo | undefined;
  readonly quantity: Quantity;
}

/** "33.3 ms", "4.66 µs". */
function timeText(nanoseconds: number): string {
  const isShort = nanoseconds > 0 && nanoseconds < 1e5;
  return `${significantText(nanoseconds / (isShort ? 1e3 : 1e6), 3)} ${isShort ? 'µs' : 'ms'}`;
}

export class Timeline extends WidgetBase {
  static override styles = [
    widgetStyles,
    arrayStyles,
    css`
      .content > .scroll {
        flex: 1 1 100%;
      }
      table {
        width: 100%;
      }
      caption {
        text-align: start;
        color: var(--muted);
      }
      th,
      td {
        padding: 1px 0.5em;
        text-align: start;
        white-space: nowrap;
        border-block-end: 1px solid var(--track);
      }
      tbody th {
        font-size: 1em;
      }
      .number {
        text-align: end;
        min-width: 5em;
      }
      .work {
        width: 60%;
        min-width: 14rem;
        padding: 1px 0;
      }
      .result {
        min-width: 6em;
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
        width: 100%;
        height: 1.3em;
        background: var(--field);
      }
      .frame {
        stroke: var(--track);
        vector-effect: non-scaling-stroke;
      }
      .busy {
        fill: var(--text);
      }
      .missing {
        color: var(--warning);
      }
      @media (pointer: coarse) {
        a {
          min-height: 44px;
          line-height: 44px;
        }
      }
      @media (forced-colors: active) {
        .busy {
          fill: CanvasText;
        }
      }
    `,
  ];
  private units: readonly UnitInfo[] = [];
  /** Whose steps begin the frames. */
  private beat: UnitInfo | undefined;
  private fields: readonly Field[] = [];
  private readonly trace = new WorkTrace();
  private readonly results = new Map<string, Reading>();
  private threads: readonly ThreadRow[] = [];

  protected override prepare(): void {
    super.prepare();
    this.units = namesIn(this.options, 'rows').flatMap((name) => unitsOf(this.host, name)).slice(0, most_rows);
    this.beat = unitsOf(this.host, nameIn(this.options, 'frame') ?? '')[0];
    const slot = this.units.map((unit) => this.slotOf(unit)).find((name) => name !== undefined);
    const list = nameIn(this.options, 'list');
    const root = list === undefined ? `slot:${slot}` : `slot:${slot}.${list}[0]`;
    this.fields = slot === undefined ? [] : namesIn(this.options, 'fields').map((path) => {
      const item = this.host.item(`${root}.${path}`);
      return { path, item, quantity: new Quantity(item ?? { scalar: 'f64', unit: '' }) };
    });
  }

  private slotOf(unit: UnitInfo): string | undefined {
    return unit.outputs[nameIn(this.options, 'result') ?? ''];
  }

  private get count(): number {
    const { frames } = this.options;
    return typeof frames === 'number' ? frames : 10;
  }

  protected override begin(): void {
    this.until(this.host.watchList('steps', (list) => {
      this.trace.add(list);
      this.requestUpdate();
    }, rate));
    this.until(this.host.watchList('threads', (list) => {
      if (Array.isArray(list)) this.threads = list as readonly ThreadRow[];
      this.requestUpdate();
    }, 1));
    for (const unit of this.units) {
      const slot = this.slotOf(unit);
      if (slot === undefined) continue;
      this.until(this.host.watch(`slot:${slot}`, (reading) => {
        this.results.set(unit.name, reading);
        this.requestUpdate();
      }, { rate }));
    }
  }

  protected override show(): void {}

  protected override redraw(): void {
    this.requestUpdate();
  }

  protected override render(): TemplateResult {
    const frames = this.beat ? this.trace.frames(this.beat, this.count) : [];
    const [from, to] = [frames[0] ?? 0, frames.at(-1) ?? 0];
    const known = frames.length - 1;
    if (known > 0) this.trace.keepFrom(from);
    else this.trace.keepLast(most_steps);
    const waits = this.units.some((unit) => this.backoffOf(unit));
    const isMissing = known > 0 && this.units.some((unit) => this.trace.isMissing(unit.thread, from, to));
    return this.frame(html`<div class="scroll" tabindex="0" role="region" aria-labelledby="label">
      <table>
        <caption>
          ${known > 0
            ? `Last ${known} frames, ${timeText(to - from)}: each begins with a step of ${this.beat!.name}`
            : `Waits for steps of ${this.beat?.name ?? 'no unit'}`}
          <span class="missing">${isMissing ? '▲ some steps are missing' : nothing}</span>
        </caption>
        <thead>
          <tr>
            <th scope="col">Unit</th>
            <th scope="col" class="work">Work</th>
            <th scope="col" class="number">Per frame</th>
            ${this.fields.map(({ path, item, quantity }) => html`<th scope="col">${item?.label ?? words(lastOf(path))} ${quantity.unit}</th>`)}
            ${waits ? html`<th scope="col">Learned interval</th>` : nothing}
          </tr>
        </thead>
        <tbody>
          ${this.units.map((unit) => html`<tr>
            <th scope="row"><a href=${addressOfRoute({ view: 'units', path: [unit.name] })}>${unit.name}</a></th>
            ${known > 0 ? this.work(unit, frames, from, to) : html`<td class="work"></td><td class="number">${dash}</td>`}
            ${this.result(unit)}
            ${waits ? html`<td>${this.backoffText(unit)}</td>` : nothing}
          </tr>`)}
        </tbody>
      </table>
    </div>`);
  }

  private work(unit: UnitInfo, frames: readonly number[], from: number, to: number): TemplateResult {
    const work = this.trace.work(unit, from, to);
    const busy = work.reduce((sum: number, one: Work) => sum + one.end - one.begin, 0) / (frames.length - 1);
    const lines = frames.map((at) => `M${((width * (at - from)) / (to - from)).toFixed(1)} 0V10`).join('');
    const label = `${unit.name}: ${work.length} steps, ${timeText(busy)} per frame`;
    return html`<td class="work">
        <svg viewBox="0 0 ${width} 10" preserveAspectRatio="none" role="img" aria-label=${label}>
          ${svg`<path class="frame" d=${lines} /><path class="busy" d=${workPath(work, from, to, width)} />`}
        </svg>
      </td>
      <td class="number">${work.length === 0 ? dash : timeText(busy)}</td>`;
  }

  private result(unit: UnitInfo): unknown {
    const reading = this.results.get(unit.name);
    const newest = reading && this.newestOf(reading.value);
    return this.fields.map(({ path, item, quantity }, i) => {
      const value = newest === undefined ? undefined : partOf(newest, partsOf(path));
      if (value !== undefined) return html`<td class="result">${item ? scalarText(item, quantity, value) : String(value)}</td>`;
      return html`<td class="result">${i === 0 && reading ? absence(reading) || dash : dash}</td>`;
    });
  }

  /** Of a list that is filled again and again from its beginning, the last one. */
  private newestOf(value: Value | null): Value | undefined {
    const list = nameIn(this.options, 'list');
    if (value === null || list === undefined) return value ?? undefined;
    const entries = partOf(value, [list]);
    const count = partOf(value, [nameIn(this.options, 'count') ?? '']);
    if (!Array.isArray(entries) || typeof count !== 'number' || count < 1) return undefined;
    return entries[(count - 1) % entries.length];
  }

  private backoffOf(unit: UnitInfo): ThreadRow['backoff'] {
    return this.threads.find((thread) => thread.name === unit.thread)?.backoff;
  }

  private backoffText(unit: UnitInfo): string {
    const backoff = this.backoffOf(unit);
    if (!backoff) return '';
    return backoff.mean_ns === 0 ? 'not known yet' : `${timeText(backoff.mean_ns)} ± ${timeText(backoff.spread_ns)}`;
  }
}
