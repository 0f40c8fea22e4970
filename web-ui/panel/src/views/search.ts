// Finds what units and devices declare, by name, label, summary and value: all of it, what is modified, or what a person marked.
import { css, html, nothing } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { repeat } from 'lit/directives/repeat.js';
import type { Value } from '../contract';
import type { Item } from '../core/descriptor';
import { addressOfRoute } from '../core/route';
import { componentRows } from './component_actions';
import { EditSession } from './edit_session';
import { Favourites } from './favourites';
import './group_reset';
import { askedBy, isModified, isParameter, matches, pathOf, searchable, type Group, type Show } from './search_rows';
import './undo';
import { addressOf, ViewBase } from './view_base';
import { viewStyles } from './view_styles';
import { wordsOf } from './wanted_words';
import './widget_place';

const shows: readonly (readonly [Show, string])[] = [['all', 'All'], ['modified', 'Modified'], ['favourites', 'Favourites']];
/** Widgets at first; more when asked for. */
const rowsAtFirst = 60;

@customElement('flexrf-search')
export class Search extends ViewBase {
  static override styles = [
    ...viewStyles,
    css`
      .tools,
      .head {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: var(--gap) 16px;
      }
      .tools {
        margin-block: 8px;
      }
      .head {
        align-items: baseline;
      }
      .tools input[type='search'] {
        flex: 1 1 14rem;
        max-width: 28rem;
      }
      [aria-pressed='true'] {
        font-weight: 700;
        border-width: 3px;
      }
      section {
        max-width: 64rem;
      }
      .row {
        display: grid;
        grid-template-columns: auto minmax(0, 1fr);
        gap: 8px;
        align-items: start;
        padding-block: 4px;
        border-block-end: 1px solid var(--track);
      }
    `,
  ];

  @state() private wanted = '';
  @state() private show: Show = 'all';
  @state() private most = rowsAtFirst;
  private groups: readonly Group[] = [];
  private favourites!: Favourites;
  private session!: EditSession;
  private watched = new Map<string, () => void>();
  private values = new Map<string, Value | null>();
  /** What was found stays while the same is asked for: a row that is set back must not vanish under the hand. */
  private found = new Set<string>();

  override connectedCallback(): void {
    super.connectedCallback();
    this.favourites = new Favourites(this.core.model.application);
    this.session = EditSession.of(this.core);
    this.found.clear();
    this.collect();
    this.until(this.core.watchTopic('components', (body) => {
      if (this.session.learnDrivers(componentRows(body))) this.collect();
    }, 1));
    this.until(() => {
      this.watched.forEach((end) => end());
      this.watched.clear();
    });
  }

  /** The address says what is asked for: a reload, and a way back to here, find the same. */
  protected override willUpdate(changed: Map<PropertyKey, unknown>): void {
    if (!changed.has('path')) return;
    const { wanted, show } = askedBy(this.path);
    if (wanted !== this.wanted || show !== this.show) this.ask(wanted, show);
  }

  /** Everything there is, with the drivers that the devices have. */
  private collect(): void {
    const { host, model } = this.core;
    this.groups = searchable(model, (component) => this.session.items(component));
    const keys = new Set(this.groups.flatMap((group) => group.items).filter(isParameter).map((item) => item.key));
    for (const [key, end] of this.watched) {
      if (keys.has(key)) continue;
      end();
      this.watched.delete(key);
    }
    for (const key of keys) {
      if (this.watched.has(key)) continue;
      this.watched.set(key, host.watch(key, ({ value }) => {
        this.values.set(key, value);
        if (this.show === 'modified' || this.wanted !== '') this.requestUpdate();
      }, { rate: 2 }));
    }
    this.requestUpdate();
  }

  protected override render(): unknown {
    const words = wordsOf(this.wanted);
    const groups = this.groups.map((group) => ({ ...group, items: group.items.filter((item) => this.finds(item, words)) }));
    const count = groups.reduce((sum, group) => sum + group.items.length, 0);
    let left = this.most;
    return html`
      <h2>Search</h2>
      <div class="tools">
        <input type="search" aria-label="Search in names, labels, meanings and values" placeholder="Name, label, meaning or value"
          .value=${this.wanted} @input=${(event: Event) => this.choose((event.target as HTMLInputElement).value, this.show)} />
        <span role="group" aria-label="Show">${shows.map(([show, label]) => html`<button
          aria-pressed=${this.show === show} @click=${() => this.choose(this.wanted, show)}>${label}</button> `)}</span>
        <flexrf-undo .core=${this.core}></flexrf-undo>
        <span class="muted" role="status">${count === 1 ? '1 found' : `${count} found`}</span>
      </div>
      ${count === 0 ? html`<p>${this.nothingFound()}</p>` : nothing}
      ${repeat(groups, (group) => group.component.name, (group) => {
        const items = group.items.slice(0, Math.max(0, left));
        left -= group.items.length;
        return items.length === 0 ? nothing : this.group(group, items);
      })}
      ${count > this.most ? html`<button @click=${() => (this.most = Infinity)}>Show all ${count}</button>` : nothing}
    `;
  }

  private group({ component }: Group, items: readonly Item[]): unknown {
    const all = this.groups.find((group) => group.component === component)?.items ?? [];
    return html`
      <section aria-label=${component.name}>
        <div class="head">
          <h3><a href=${addressOf(`${component.kind}s`, component.name)}>${component.name}</a></h3>
          <flexrf-group-reset .core=${this.core} .items=${all}></flexrf-group-reset>
        </div>
        ${repeat(items, (item) => item.key, (item) => this.row(component.name, item))}
      </section>`;
  }

  private row(component: string, item: Item): unknown {
    const marked = this.favourites.has(item.key);
    return html`
      <div class="row">
        <button aria-pressed=${marked} aria-label="Favourite: ${item.label} of ${component}" title="Favourite" @click=${() => this.mark(item)}>
          ${marked ? '★' : '☆'}
        </button>
        <flexrf-item .core=${this.core} .item=${item}></flexrf-item>
      </div>`;
  }

  private finds(item: Item, words: readonly string[]): boolean {
    if (this.found.has(item.key)) return true;
    const value = this.values.get(item.key);
    const wanted = this.show === 'all' || (this.show === 'modified' ? isModified(item, value) : this.favourites.has(item.key));
    if (!wanted || !matches(item, words, value, this.core.units)) return false;
    this.found.add(item.key);
    return true;
  }

  private nothingFound(): string {
    if (this.wanted.trim() !== '') return 'Nothing has all these words in its name, label, meaning or value.';
    return this.show === 'modified' ? 'All parameters have their defaults.' : 'Nothing is marked yet: press the star beside a parameter.';
  }

  private choose(wanted: string, show: Show): void {
    this.ask(wanted, show);
    history.replaceState(history.state, '', addressOfRoute({ view: 'search', path: pathOf(wanted, show) }));
  }

  private ask(wanted: string, show: Show): void {
    this.wanted = wanted;
    this.show = show;
    this.most = rowsAtFirst;
    this.found.clear();
  }

  private mark(item: Item): void {
    this.favourites.toggle(item.key);
    this.requestUpdate();
  }
}
