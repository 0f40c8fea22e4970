// Threads: how late they were released, how long they took, and what they use.
import { css, html, nothing, svg } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { repeat } from 'lit/directives/repeat.js';
import type { ThreadJson } from '../core/descriptor_json';
import { countText, durationText, rateText } from './durations';
import { budgetUse, columnsOf, histogramPath, LogAxis, type DurationHistogram } from './histogram_scale';
import { RateMeters } from './rates';
import { table } from './table';
import { addressOf, ViewBase } from './view_base';
import { viewStyles } from './view_styles';

/** A row of topic "threads". */
export interface ThreadRow {
  readonly name: string;
  readonly cycles: number;
  readonly overruns: number;
  readonly skipped: number;
  readonly skipped_time_ns: number;
  /** 0: there was none. */
  readonly longest_standstill_ns: number;
  readonly allocations: number;
  readonly budget_ns: number;
  readonly response_estimate_ns: number | null;
  /** Which one it runs on, where it is pinned to one. */
  readonly cpu: number | null;
  readonly cpu_time_ns: number | null;
  /** Of one that polls by back-off: what it learned of the time between arrivals; 0: nothing yet. */
  readonly backoff?: { readonly mean_ns: number; readonly spread_ns: number } | null;
  readonly lateness: DurationHistogram;
  readonly execution: DurationHistogram;
}

const quantileNames = ['p50', 'p99', 'p99.9', 'Longest'];

const width = 480;
const height = 70;
const foot = 18;

@customElement('flexrf-threads')
export class Threads extends ViewBase {
  static override styles = [
    ...viewStyles,
    css`
      section {
        border-block-start: 2px solid var(--track);
      }
      .charts {
        display: flex;
        flex-wrap: wrap;
        gap: 1em;
      }
      figure {
        margin: 0.5em 0;
        flex: 1 1 20rem;
        max-width: 40rem;
      }
      figcaption {
        color: var(--muted);
      }
      svg {
        width: 100%;
        height: auto;
        overflow: visible;
      }
      svg .columns {
        fill: var(--fill);
      }
      svg .axis {
        stroke: var(--border);
        fill: none;
      }
      svg .mark {
        stroke: var(--text);
        stroke-dasharray: 3 2;
      }
      svg .budget {
        stroke: var(--alarm);
        stroke-width: 2;
      }
      svg text {
        fill: var(--muted);
        font-size: 12px;
      }
      svg.budget-bar {
        display: block;
        height: 12px;
        max-width: 30rem;
        background: var(--track);
        border-radius: 2px;
        fill: var(--fill);
      }
      svg.budget-bar.over {
        fill: var(--alarm);
      }
      @media (forced-colors: active) {
        svg.budget-bar,
        svg .columns {
          fill: CanvasText;
        }
      }
    `,
  ];

  @state() private rows = new Map<string, ThreadRow>();
  private readonly meters = new RateMeters();
  private readonly rates = new Map<string, { cycles: number | null; cpu: number | null }>();

  override connectedCallback(): void {
    super.connectedCallback();
    this.watchAge();
    this.until(this.core.watchTopic('threads', (body) => this.take(body), 1));
  }

  protected override updated(changed: Map<PropertyKey, unknown>): void {
    // The first figures push what is below them away.
    if (!changed.has('path') && !(changed.has('rows') && (changed.get('rows') as Map<string, ThreadRow>).size === 0)) return;
    const name = this.path[0];
    if (name !== undefined) this.renderRoot.querySelector(`[data-thread="${CSS.escape(name)}"]`)?.scrollIntoView();
  }

  protected override render(): unknown {
    return html`
      <h2>Threads</h2>
      <div class=${this.age}>
        ${repeat(this.core.model.threads, (thread) => thread.name, (thread) => this.thread(thread))}
      </div>
    `;
  }

  private take(body: unknown): void {
    if (!Array.isArray(body)) return;
    const rows = body as readonly ThreadRow[];
    const now = performance.now() / 1000;
    for (const row of rows) {
      const share = row.cpu_time_ns === null ? null : this.meters.add(`cpu ${row.name}`, row.cpu_time_ns, now);
      this.rates.set(row.name, {
        cycles: this.meters.add(row.name, row.cycles, now),
        cpu: share === null ? null : share / 1e9,
      });
    }
    this.rows = new Map(rows.map((row) => [row.name, row]));
  }

  private thread(thread: ThreadJson): unknown {
    const row = this.rows.get(thread.name);
    return html`
      <section data-thread=${thread.name} aria-label="Thread ${thread.name}">
        <h3>${thread.name}</h3>
        ${thread.summary === '' ? nothing : html`<p class="muted">${thread.summary}</p>`} ${this.facts(thread, row)}
        ${row === undefined ? html`<p class="muted">Not known yet.</p>` : [this.budget(row), this.quantiles(row), this.charts(thread, row)]}
      </section>
    `;
  }

  private facts(thread: ThreadJson, row: ThreadRow | undefined): unknown {
    const rates = this.rates.get(thread.name);
    const steps = [
      ...thread.devices.map((name) => html`<a href=${addressOf('devices', name)}>${name}</a>`),
      ...thread.units.map((name) => html`<a href=${addressOf('units', name)}>${name}</a>`),
    ];
    const abnormal = (count: number): unknown =>
      count === 0 ? '0' : html`<strong class="alarm">▲ ${countText(count)}</strong>`;
    return html`
      <dl>
        <dt>Released by</dt>
        <dd>${triggerText(thread)}</dd>
        <dt>Serves</dt>
        <dd>${steps.map((step, i) => [i > 0 ? ', ' : '', step])}</dd>
        <dt>Priority</dt>
        <dd>${thread.priority === 0 ? 'not real-time' : `${thread.priority}, role ${thread.role}`}</dd>
        ${row === undefined
          ? nothing
          : html`<dt>CPU</dt>
              <dd>
                ${row.cpu === null ? 'any' : `number ${row.cpu}`}${rates?.cpu == null ? '' : `, ${(100 * rates.cpu).toFixed(1)} % used`}
              </dd>
              <dt>Releases</dt>
              <dd>${countText(row.cycles)}, ${rateText(rates?.cycles ?? null)}</dd>
              ${row.backoff == null
                ? nothing
                : html`<dt>Learned interval</dt>
                    <dd>
                      ${row.backoff.mean_ns === 0 ? 'not known yet' : `${durationText(row.backoff.mean_ns)} ± ${durationText(row.backoff.spread_ns)}`}
                    </dd>`}
              <dt>Overruns</dt>
              <dd>${abnormal(row.overruns)}</dd>
              <dt>Skipped</dt>
              <dd>${row.skipped === 0 ? 0 : `${countText(row.skipped)}, ${durationText(row.skipped_time_ns)} in all`}</dd>
              ${row.longest_standstill_ns === 0
                ? nothing
                : html`<dt>Stood still</dt>
                    <dd><strong class="alarm">▲ ${durationText(row.longest_standstill_ns)}</strong> at most</dd>`}
              <dt>Allocations</dt>
              <dd>${thread.priority === 0 ? countText(row.allocations) : abnormal(row.allocations)}</dd>
              ${row.response_estimate_ns === null
                ? nothing
                : html`<dt>Response, estimated</dt>
                    <dd>${durationText(row.response_estimate_ns)}</dd>`}`}
      </dl>
    `;
  }

  private budget(row: ThreadRow): unknown {
    const use = budgetUse(row.budget_ns, row.execution);
    if (use.share === null) return nothing;
    const percent = Math.round(100 * use.share);
    return html`
      <p class=${use.over ? 'alarm' : ''}>
        ${use.over ? '▲ Over budget: ' : ''}Execution p99.9 is ${durationText(row.execution['p99.9_ns'])}, ${percent} % of the budget of
        ${durationText(row.budget_ns)}.
      </p>
      <svg class="budget-bar ${use.over ? 'over' : ''}" viewBox="0 0 100 4" preserveAspectRatio="none" aria-hidden="true">
        <rect width=${Math.min(100, percent)} height="4" />
      </svg>
    `;
  }

  private quantiles(row: ThreadRow): unknown {
    const line = (name: string, histogram: DurationHistogram): unknown => html`
      <tr>
        <th scope="row">${name}</th>
        ${[histogram.p50_ns, histogram.p99_ns, histogram['p99.9_ns'], histogram.max_ns].map((value) =>
          html`<td class="number">${histogram.count === 0 ? '–' : durationText(value)}</td>`)}
      </tr>
    `;
    return html`
      <div class="scroll">
        ${table(
          `Durations since the start, ${row.name}`,
          ['What', ...quantileNames],
          [line('Lateness', row.lateness), line('Execution', row.execution)],
          quantileNames,
        )}
      </div>
    `;
  }

  private charts(thread: ThreadJson, row: ThreadRow): unknown {
    // One axis for both: lateness and execution can be compared by eye.
    const lateness = columnsOf(row.lateness.buckets);
    const execution = columnsOf(row.execution.buckets);
    const ends = [...lateness, ...execution].flatMap((column) => [column.low, column.high]);
    const axis = LogAxis.over(row.budget_ns > 0 ? [...ends, row.budget_ns] : ends);
    return html`
      <div class="charts">
        ${this.chart('Lateness', thread.name, lateness, row.lateness, axis, 0)}
        ${this.chart('Execution', thread.name, execution, row.execution, axis, row.budget_ns)}
      </div>
    `;
  }

  private chart(
    what: string, thread: string, columns: ReturnType<typeof columnsOf>, histogram: DurationHistogram, axis: LogAxis, budget: number,
  ): unknown {
    const label = `${what} of thread ${thread}: half below ${durationText(histogram.p50_ns)}, 99.9 % below ` +
      `${durationText(histogram['p99.9_ns'])}, longest ${durationText(histogram.max_ns)}`;
    const at = (duration: number): number => Math.round(axis.place(duration) * width);
    const marks = histogram.count === 0 ? [] : [histogram.p50_ns, histogram.p99_ns, histogram['p99.9_ns']];
    return html`
      <figure>
        <figcaption>${what}; counts on a logarithmic scale, dashed: p50, p99, p99.9${budget > 0 ? '; red: budget' : ''}</figcaption>
        <svg viewBox="0 0 ${width} ${height + foot}" role="img" aria-label=${label}>
          <path class="columns" d=${histogramPath(columns, axis, width, height)} />
          <path class="axis" d="M0 ${height}H${width}" />
          ${marks.map((mark) => svg`<path class="mark" d="M${at(mark)} 0V${height}" />`)}
          ${budget > 0 ? svg`<path class="budget" d="M${at(budget)} 0V${height}" />` : nothing}
          ${axis.ticks.map((tick, i, all) => svg`
            <path class="axis" d="M${at(tick)} ${height}v4" />
            <text x=${at(tick)} y=${height + foot - 2} text-anchor=${i === 0 ? 'start' : i + 1 === all.length ? 'end' : 'middle'}>${tickText(tick)}</text>
          `)}
        </svg>
      </figure>
    `;
  }
}

/** "10 µs": decades have no digits beyond the point. */
function tickText(nanoseconds: number): string {
  return durationText(nanoseconds).replace(/\.0+ /, ' ');
}

/** "period 7.00 ms", "slots keys", "device keyboard". */
export function triggerText(thread: ThreadJson): string {
  const { trigger } = thread;
  if (trigger.period_ns !== undefined) return `its period of ${durationText(trigger.period_ns)}`;
  const sources = trigger['sources'];
  const timeout = trigger['timeout_ns'];
  const words = [trigger.kind];
  if (Array.isArray(sources)) words.push(sources.join(', '));
  if (typeof trigger['device'] === 'string') words.push(trigger['device']);
  return typeof timeout === 'number' ? `${words.join(' ')}, or after ${durationText(timeout)}` : words.join(' ');
}
