// The first view: what the application does, what is wrong and what to do about it, and the values chosen for it.
import { css, html, nothing } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import type { Item, Model } from '../core/descriptor';
import { loadPart } from '../core/parts';
import { addressOfFault, faultCount, modeOf, modeText, motionOf, motionText, remedyOf } from '../core/words';
import { ViewBase } from './view_base';
import { viewStyles } from './view_styles';
import './widget_place';

const place = 'overview';
const most = 24;

/** Without anything placed on the overview: feedback, a few values of each component, until the page is full. */
export function chosenFeedback(model: Model): readonly Item[] {
  const lists = [...model.components.values()]
    .map((component) => component.feedback.filter((item) => !item.hidden && item.shape.length < 2))
    .filter((list) => list.length > 0);
  const chosen = new Set<Item>();
  for (let index = 0; chosen.size < most && lists.some((list) => index < list.length); index += 1) {
    for (const list of lists) {
      const item = list[index];
      if (item && chosen.size < most) chosen.add(item);
    }
  }
  return lists.flat().filter((item) => chosen.has(item));
}

@customElement('flexrf-overview')
export class Overview extends ViewBase {
  static override styles = [
    viewStyles,
    css`
      .board,
      .cards,
      .stack {
        display: grid;
        grid-template-columns: minmax(0, 1fr);
        gap: 12px;
        align-items: start;
      }
      .cards {
        grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr));
      }
      /* What is always there stands in a column of its own, one below the other; a tall card leaves no hole beside it. */
      @media (min-width: 60rem) {
        .board:has(> .stack) {
          grid-template-columns: minmax(20rem, 1fr) minmax(0, 2fr);
        }
        .board.even {
          grid-template-columns: repeat(2, minmax(0, 1fr));
        }
      }
      section {
        background: var(--surface);
        border: 1px solid var(--track);
        border-radius: var(--radius);
        padding: 4px 12px 10px;
        min-width: 0;
      }
      section h3 {
        margin-block: 0.4em;
      }
      /* Tables of many columns, too. */
      .wide,
      [data-kind='population'],
      [data-kind='timeline'] {
        grid-column: 1 / -1;
      }
      .items {
        display: grid;
        gap: 10px;
      }
      ul {
        list-style: none;
        margin: 0;
        padding: 0;
      }
    `,
  ];

  /** The button that saves can be shown. */
  @state() private saves = false;
  /** Why it cannot. */
  @state() private saverFailure = '';

  override connectedCallback(): void {
    super.connectedCallback();
    this.watchAge();
    this.until(this.core.watchState(() => this.requestUpdate()));
  }

  protected override render(): unknown {
    const { model } = this.core;
    const placed = model.placed(place);
    const nothingPlaced = placed.items.length + placed.placements.length === 0;
    // Beside one card alone the values would stand before a hole.
    const isFew = !nothingPlaced && placed.placements.length < 2;
    const values = placed.items.length > 0 ? html`<section><h3>Values</h3>${this.items(placed.items)}</section>` : nothing;
    const file = html`<section><h3>Configuration file</h3>${this.saver()}</section>`;
    const cards = html`
      ${placed.placements.map((placement) => html`
        <section data-kind=${placement.kind}><h3>${placement.label}</h3>
          <flexrf-placement .core=${this.core} .placement=${placement}></flexrf-placement></section>`)}
      ${nothingPlaced ? this.feedback(chosenFeedback(model)) : nothing}`;
    return html`
      <h2>${model.application}</h2>
      <p class="muted">${model.json.summary}</p>
      <div class="board ${isFew ? 'even' : ''}">
        ${isFew
          ? html`<div class="stack">${this.stateCard()}${file}${cards}</div><div class="stack">${values}</div>`
          : html`<div class="stack">${this.stateCard()}${values}${file}</div><div class="cards">${cards}</div>`}
        ${this.faults() /* last: it comes and goes, and the header's line tells it, too */}
      </div>
    `;
  }

  private saver(): unknown {
    const { state } = this.core;
    if (!state) return nothing;
    if (!state.values.file) return html`<p>Values are kept until the application ends: it was started without --config FILE.</p>`;
    if (this.saverFailure) return html`<flexrf-missing .text=${this.saverFailure} .again=${() => this.loadSaver()}></flexrf-missing>`;
    if (!this.saves) {
      void this.loadSaver();
      return nothing;
    }
    return html`<flexrf-values-saver .core=${this.core} .host=${this.host}></flexrf-values-saver>`;
  }

  private async loadSaver(): Promise<void> {
    try {
      await loadPart(() => import('./values_saver'));
      this.saves = true;
      this.saverFailure = '';
    } catch (error) {
      this.saverFailure = `“Save now” cannot be shown: ${(error as Error).message}`;
    }
  }

  private faults(): unknown {
    const faults = this.core.state?.faults ?? [];
    if (faults.length === 0) return nothing;
    return html`
      <section class="wide box abnormal-box ${this.age}" role="alert">
        <h3 class="alarm">✕ ${faultCount(faults.length)}</h3>
        <ul>${faults.map((fault) => html`<li>
          <a href=${addressOfFault(fault)}>${fault.component}</a>
          <p>${fault.cause}</p>
          <p class="muted">What to do: ${remedyOf(fault)}</p>
        </li>`)}</ul>
      </section>`;
  }

  private stateCard(): unknown {
    const { state } = this.core;
    return html`
      <section>
        <h3>State</h3>
        ${state
          ? html`<dl class=${this.age}>
              <dt>Application</dt><dd>${modeText(modeOf(this.core))}${state.cause && state.cause !== 'none' ? `: ${state.cause}` : ''}</dd>
              <dt>Motion</dt><dd>${motionText[motionOf(this.core)]}</dd>
              <dt>Faults</dt><dd>${state.faults.length === 0 ? 'none' : html`<strong class="alarm">✕ ${state.faults.length}</strong>`}</dd>
              <dt>Being edited</dt><dd>${state.edit ? state.edit.components.join(', ') : 'nothing'}</dd>
              <dt>Connections</dt><dd>${state.server.connections} of ${state.server.places}</dd>
              <dt>Panel's delay</dt><dd>p99 ${(state.server.loop_delay_us.p99 / 1000).toFixed(2)} ms, most ${(state.server.loop_delay_us.max / 1000).toFixed(2)} ms</dd>
            </dl>`
          : html`<p>Not known yet.</p>`}
      </section>`;
  }

  private feedback(items: readonly Item[]): unknown {
    const components = [...new Set(items.map((item) => item.component ?? ''))];
    return components.map((component) => html`
      <section>
        <h3>${component}</h3>
        ${this.items(items.filter((item) => item.component === component))}
      </section>`);
  }

  private items(items: readonly Item[]): unknown {
    return html`<div class="items">${items.map((item) => html`
      <flexrf-item .core=${this.core} .item=${item}></flexrf-item>`)}</div>`;
  }
}
