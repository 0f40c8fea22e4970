// The blackboard: every slot and queue, live. Only rows that are seen are subscribed.
import { css, html, nothing } from 'lit';
import { customElement, query, state } from 'lit/decorators.js';
import { repeat } from 'lit/directives/repeat.js';
import type { QueueJson } from '../core/descriptor_json';
import { words } from '../widgets/value_text';
import { ownerOf, slotColumns, SlotRow, type SlotCounters } from './blackboard_rows';
import { countText, rateText } from './durations';
import { RateMeters } from './rates';
import { scoreBars, type Scores } from './score_bars';
import { table } from './table';
import { addressOf, ViewBase } from './view_base';
import { viewStyles } from './view_styles';
import { hasAll, wordsOf } from './wanted_words';

/** A row of topic "queues". */
interface QueueCounters {
  readonly name: string;
  /** Items that wait. */
  readonly fill: number;
  /** Of a queue that is ordered by a score: of what waits, the highest first. */
  readonly scores?: Scores;
  readonly writers: readonly { readonly name: string; readonly pushed: number; readonly popped: number; readonly dropped: number }[];
}

/** Of a queue that has room for more the bars become narrower when they come. */
const most_bars = 32;

@customElement('flexrf-blackboard')
export class Blackboard extends ViewBase {
  static override styles = [
    ...viewStyles,
    css`
      .value-cell {
        min-width: 12rem;
        max-width: clamp(12rem, 32cqw, 36rem);
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      button.expand {
        text-align: start;
        font-weight: 600;
        white-space: nowrap;
        min-height: 28px;
      }
      button.expand::before {
        content: '▸ ';
      }
      button.expand[aria-expanded='true']::before {
        content: '▾ ';
      }
      @media (pointer: coarse) {
        button.expand {
          min-height: var(--target);
        }
      }
      .detail td {
        padding: 0 0 0.8em;
      }
      #slots-box {
        container-type: inline-size;
      }
      /* As wide as what is seen of the table, and there wherever it is scrolled to. */
      .inside {
        position: sticky;
        inset-inline-start: 0;
        box-sizing: border-box;
        width: 100cqw;
        max-width: 64rem;
        padding-inline: 1.5em 8px;
      }
      .scores-cell {
        white-space: nowrap;
        /* There also while nothing waits: what is beside it stays where it is. */
        min-width: 13rem;
      }
      svg.scores {
        width: 6rem;
        height: 1.35em;
        vertical-align: bottom;
        background: var(--field);
        fill: var(--fill);
      }
      .score-range {
        color: var(--muted);
      }
      @media (forced-colors: active) {
        svg.scores {
          fill: CanvasText;
        }
      }
      .filter {
        display: flex;
        flex-wrap: wrap;
        gap: var(--gap);
        align-items: center;
        margin-block: 0.6em;
      }
      .filter input {
        flex: 1 1 12rem;
        max-width: 28rem;
      }
    `,
  ];

  @state() private filter = '';
  @state() private queues = new Map<string, QueueCounters>();
  @query('#slots') private body!: HTMLTableSectionElement;
  private rows: SlotRow[] = [];
  private readonly rates = new RateMeters();
  private readonly queueRates = new Map<string, number | null>();
  private observer: IntersectionObserver | undefined;

  override connectedCallback(): void {
    super.connectedCallback();
    if (this.hasUpdated) this.begin();
  }

  protected override firstUpdated(): void {
    this.begin();
  }

  private begin(): void {
    this.rows = this.core.model.slots.map((slot) => new SlotRow(slot, this.core, this.host));
    this.body.replaceChildren(...this.rows.map((row) => row.element));
    const byElement = new Map<Element, SlotRow>(this.rows.map((row) => [row.element, row]));
    const byName = new Map(this.rows.map((row) => [row.slot.name, row]));
    this.observer = new IntersectionObserver(
      (entries) => entries.forEach((entry) => (byElement.get(entry.target)!.visible = entry.isIntersecting)),
      { rootMargin: '100px' },
    );
    this.rows.forEach((row) => this.observer!.observe(row.element));
    const timer = setInterval(() => {
      const now = performance.now();
      this.rows.forEach((row) => row.tick(now));
    }, 500);
    this.until(() => {
      clearInterval(timer);
      this.observer?.disconnect();
      this.rows.forEach((row) => row.close());
    });
    this.watchAge();
    this.until(this.core.watchTopic('slots', (body) => this.countSlots(byName, body), 2));
    this.until(this.core.watchTopic('queues', (body) => this.countQueues(body), 2));
    this.applyFilter();
    this.open();
  }

  protected override updated(changed: Map<PropertyKey, unknown>): void {
    if (changed.has('filter')) this.applyFilter();
    if (changed.has('path') && changed.get('path') !== undefined) this.open();
  }

  protected override render(): unknown {
    const { slots } = this.core.model;
    const shown = slots.length === this.shownSlots ? `${slots.length} slots` : `${this.shownSlots} of ${slots.length} slots`;
    return html`
      <h2>Blackboard</h2>
      <div class="filter">
        <label for="filter">Filter</label>
        <input
          id="filter"
          type="search"
          autocomplete="off"
          placeholder="name, type, writer, reader"
          .value=${this.filter}
          @input=${(event: Event) => (this.filter = (event.target as HTMLInputElement).value)}
        />
        <span role="status">${shown}</span>
      </div>
      <h3 id="slots-title">Slots</h3>
      <div id="slots-box" class="scroll ${this.age}" tabindex="0" role="region" aria-labelledby="slots-title">
        <table>
          <caption>
            Latest values; open a slot for all its fields
          </caption>
          <thead>
            <tr>
              ${slotColumns.map((name) =>
                html`<th scope="col" class=${['Rate', 'Age', 'Missed'].includes(name) ? 'number' : ''}>${name}</th>`)}
            </tr>
          </thead>
          <tbody id="slots"></tbody>
        </table>
      </div>
      ${this.queueTable()}
    `;
  }

  private get words(): string[] {
    return wordsOf(this.filter);
  }

  private get shownSlots(): number {
    return this.rows.length === 0 ? this.core.model.slots.length : this.rows.filter((row) => row.matches(this.words)).length;
  }

  private queueTable(): unknown {
    const queues = this.core.model.queues.filter((queue) =>
      hasAll([queue.name, queue.type, ...queue.writers, ...queue.readers].join(' '), this.words));
    if (this.core.model.queues.length === 0) return nothing;
    const scores = this.hasScores ? ['Scores'] : [];
    return html`
      <h3 id="queues-title">Queues</h3>
      <div class="scroll ${this.age}" tabindex="0" role="region" aria-labelledby="queues-title">
        ${table(
          'Each item goes to one reader; a line for each writer',
          ['Queue', 'Waiting', ...scores, 'Capacity', 'When full', 'Type', 'Writer', 'Pushed', 'Rate', 'Taken', 'Dropped', 'Readers'],
          repeat(queues, (queue) => queue.name, (queue) => queue.writers.map((name, i) => this.queueRow(queue, name, i))),
          ['Waiting', 'Capacity', 'Pushed', 'Rate', 'Taken', 'Dropped'],
        )}
      </div>
    `;
  }

  private queueRow(queue: QueueJson, writer: string, index: number): unknown {
    const figures = this.queues.get(queue.name);
    const counters = figures?.writers[index];
    const count = (value: number | undefined): string => (value === undefined ? '–' : countText(value));
    const dropped = counters !== undefined && counters.dropped > 0;
    return html`
      <tr>
        ${index === 0
          ? html`<th scope="rowgroup" rowspan=${queue.writers.length} title=${queue.summary}>${queue.name}</th>
              <td rowspan=${queue.writers.length} class="number">${count(figures?.fill)}</td>
              ${this.hasScores ? html`<td rowspan=${queue.writers.length} class="scores-cell">${scoresOf(queue, figures)}</td>` : nothing}
              <td rowspan=${queue.writers.length} class="number">${queue.capacity}</td>
              <td rowspan=${queue.writers.length}>${words(queue.policy)}</td>
              <td rowspan=${queue.writers.length}>${queue.type}</td>`
          : nothing}
        <td>${this.portLink(writer)}</td>
        <td class="number">${count(counters?.pushed)}</td>
        <td class="number">${rateText(this.queueRates.get(`${queue.name} ${index}`) ?? null)}</td>
        <td class="number">${count(counters?.popped)}</td>
        <td class="number ${dropped ? 'warning' : ''}">${dropped ? '▲ ' : ''}${count(counters?.dropped)}</td>
        ${index === 0
          ? html`<td rowspan=${queue.writers.length}>${queue.readers.map((reader, i) => [i > 0 ? ', ' : '', this.portLink(reader)])}</td>`
          : nothing}
      </tr>
    `;
  }

  private get hasScores(): boolean {
    return this.core.model.queues.some((queue) => queue.score !== undefined);
  }

  private portLink(port: string): unknown {
    const component = ownerOf(this.core.model, port);
    if (component === undefined) return port;
    return html`<a href=${addressOf(`${component.kind}s`, component.name)}>${port}</a>`;
  }

  private countSlots(rows: ReadonlyMap<string, SlotRow>, body: unknown): void {
    const now = performance.now() / 1000;
    for (const counters of listOf<SlotCounters>(body)) {
      rows.get(counters.name)?.count(counters, this.rates.add(counters.name, counters.published, now));
    }
  }

  private countQueues(body: unknown): void {
    const now = performance.now() / 1000;
    const rows = listOf<QueueCounters>(body);
    for (const queue of rows) {
      queue.writers.forEach((writer, i) => {
        const key = `${queue.name} ${i}`;
        this.queueRates.set(key, this.rates.add(`queue ${key}`, writer.pushed, now));
      });
    }
    this.queues = new Map(rows.map((row) => [row.name, row]));
  }

  private applyFilter(): void {
    for (const row of this.rows) row.hidden = !row.matches(this.words);
  }

  /** "#/blackboard/NAME" shows that slot with all its fields. */
  private open(): void {
    const name = this.path[0];
    const row = name === undefined ? undefined : this.rows.find((one) => one.slot.name === name);
    if (row !== undefined) {
      row.expand();
      row.focus();
    } else if (name !== undefined && this.core.model.queues.some((queue) => queue.name === name)) {
      this.renderRoot.querySelector('#queues-title')?.scrollIntoView();
    }
  }
}

function scoresOf(queue: QueueJson, figures: QueueCounters | undefined): unknown {
  if (queue.score === undefined || figures?.scores === undefined) return nothing;
  return scoreBars(figures.scores, figures.fill, Math.min(queue.capacity, most_bars), queue.score);
}

function listOf<Row>(body: unknown): Row[] {
  return Array.isArray(body) ? (body as Row[]) : [];
}
