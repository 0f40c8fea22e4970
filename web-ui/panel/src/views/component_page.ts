// The page of one unit or device.
import { css, html, nothing } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import { repeat } from 'lit/directives/repeat.js';
import type { Component, Item } from '../core/descriptor';
import { formatNumber } from '../core/format_number';
import { remedyOf } from '../core/words';
import { componentRows, stateText, type ComponentRow } from './component_actions';
import './component_buttons';
import { countText, durationText } from './durations';
import './edit_panel';
import { EditSession } from './edit_session';
import './group_reset';
import { portsOf, type Port } from './ports';
import './slot_age';
import './undo';
import { table } from './table';
import { addressOf, ViewBase } from './view_base';
import { viewStyles } from './view_styles';
import './widget_place';

/** Buttons and holds bear their own labels and need no line each. */
function isPressed(item: Item): boolean {
  return item.scalar === 'button' || item.scalar === 'hold';
}

@customElement('flexrf-component-page')
export class ComponentPage extends ViewBase {
  static override styles = [
    ...viewStyles,
    css`
      section {
        max-width: 64rem;
      }
      /* Of many columns. */
      section:is([data-kind='population'], [data-kind='timeline']) {
        max-width: none;
      }
      .item {
        display: block;
        padding-block: 4px;
        border-block-end: 1px solid var(--track);
      }
      .item.edited {
        border-inline-start: 4px solid var(--modified);
        padding-inline-start: 8px;
      }
      .group-head {
        display: flex;
        flex-wrap: wrap;
        align-items: baseline;
        gap: var(--gap) 16px;
      }
      .why-dead {
        margin: 4px 0;
        min-height: 1.35em;
      }
      .presses {
        display: flex;
        flex-wrap: wrap;
        gap: 4px;
      }
      .edited-note {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: var(--gap);
        color: var(--modified);
      }
      ul.plain {
        list-style: none;
        margin: 0;
        padding: 0;
      }
    `,
  ];

  @property({ attribute: false }) component!: Component;
  private rows = new Map<string, ComponentRow>();
  private session!: EditSession;

  override connectedCallback(): void {
    super.connectedCallback();
    this.session = EditSession.of(this.core);
    this.watchAge();
    this.until(this.core.host.watchAccess(() => this.requestUpdate()));
    this.until(this.session.watch(() => this.requestUpdate()));
    this.until(
      this.core.watchTopic('components', (body) => {
        this.rows = new Map(componentRows(body).map((row) => [row.name, row]));
        this.session.learnDrivers(this.rows.values());
        this.requestUpdate();
      }, 2),
    );
  }

  protected override render(): unknown {
    const { component } = this;
    const view = `${component.kind}s`;
    return html`
      <nav aria-label="Breadcrumb"><a href="#/${view}">All ${view}</a></nav>
      <h2>${component.name}</h2>
      <p>${component.summary}</p>
      ${this.state()} ${this.facts()} ${this.placed()} ${this.configuration()}
      ${this.items('Runtime parameters', component.runtime)} ${this.items('Feedback', component.feedback)} ${this.ports()}
      ${this.members()}
    `;
  }

  private get row(): ComponentRow | undefined {
    return this.rows.get(this.component.name);
  }

  private state(): unknown {
    const { row } = this;
    if (row === undefined) return html`<h3>State</h3><p class="muted">Not known yet.</p>`;
    const sources = [...this.rows.values()]
      .filter((one) => one.member !== null && one.member.population === row.member?.population && one.active && one.name !== row.name)
      .map((one) => one.name);
    return html`
      <h3>State</h3>
      <p class=${this.age}><strong class=${row.life === 'fault' ? 'alarm' : ''}>${stateText(row)}</strong></p>
      ${this.fault(row)}
      ${this.restraint(row)}
      <flexrf-component-buttons .core=${this.core} .host=${this.host} .row=${row} .sources=${sources}></flexrf-component-buttons>
    `;
  }

  private restraint(row: ComponentRow): unknown {
    if (row.restraint !== '')
      return html`<p class="box abnormal-box ${this.age}" role="status"><strong class="alarm">▲ Restrained:</strong> ${row.restraint}</p>`;
    if (row.restraints === 0) return nothing;
    return html`<p class="muted">Restrained ${row.restraints === 1 ? 'once' : `${row.restraints} times`}: the log says by what.</p>`;
  }

  private fault(row: ComponentRow): unknown {
    if (row.life === 'waiting')
      return html`<div class="box abnormal-box ${this.age}" role="status">
        <p><strong>Waiting:</strong> ${row.fault}</p>
        <p>Starts when the device is there.</p>
      </div>`;
    if (row.life !== 'fault') return nothing;
    const told = this.core.state?.faults.find((fault) => fault.component === row.name) ?? { component: row.name, kind: row.kind, cause: row.fault };
    return html`
      <div class="box abnormal-box ${this.age}" role="alert">
        <dl>
          <dt>Cause</dt>
          <dd>${row.fault || told.cause || 'not told'}</dd>
          <dt>Remedy</dt>
          <dd>${remedyOf(told)}</dd>
        </dl>
      </div>
    `;
  }

  private facts(): unknown {
    const { component, row } = this;
    const fact = (name: string, value: unknown): unknown =>
      value === undefined || value === '' ? nothing : html`<dt>${name}</dt><dd>${value}</dd>`;
    const { unit, device } = component;
    const drivers = this.core.model.json.drivers;
    const driver = drivers.find((one) => one.interface === device?.interface && one.driver === row?.driver);
    return html`
      <dl class=${this.age}>
        ${fact(unit ? 'Type' : 'Interface', component.typeName)}
        ${fact('Driver', device && row?.driver ? `${row.driver}${driver ? ` (${driver.kind}): ${driver.summary}` : ''}` : undefined)}
        ${fact('Thread', component.thread === '' ? '' : html`<a href=${addressOf('threads', component.thread)}>${component.thread}</a>`)}
        ${fact('Belongs to', device?.unit ? html`<a href=${addressOf('units', device.unit)}>${device.unit}</a>` : '')}
        ${fact('Carried by', device?.on ? html`<a href=${addressOf('devices', device.on)}>${device.on}</a>` : '')}
        ${Object.entries(unit?.devices ?? {}).map(([port, name]) => fact(`Device ${port}`, html`<a href=${addressOf('devices', name)}>${name}</a>`))}
        ${unit && row
          ? html`${fact('Steps', countText(row.steps))}
            ${fact('Step takes', `${durationText(row.execution.mean_ns)} on average, ${durationText(row.execution.max_ns)} at most`)}
            ${fact('Budget', this.budget(unit.budget_ns, row))} ${fact('Restart', unit.restart)}`
          : nothing}
      </dl>
    `;
  }

  private budget(budget: number | undefined, row: ComponentRow): unknown {
    if (!budget) return '';
    if (row.budget_overruns === 0) return durationText(budget);
    const steps = row.budget_overruns === 1 ? 'one step' : `${countText(row.budget_overruns)} steps`;
    return html`${durationText(budget)}, <strong class="alarm">▲ exceeded in ${steps}</strong>`;
  }

  /** What the application's table puts on this page. */
  private placed(): unknown {
    const { items, placements } = this.core.model.placed(this.component.name);
    const others = items.filter((item) => item.component !== this.component.name);
    return html`
      ${repeat(placements, (one) => one.name, (one) => html`
        <section data-kind=${one.kind} aria-label=${one.label}>
          <h3>${one.label}</h3>
          <flexrf-placement .core=${this.core} .placement=${one}></flexrf-placement>
        </section>
      `)}
      ${this.items('From elsewhere', others)}
    `;
  }

  private configuration(): unknown {
    const items = this.session.items(this.component.name).filter((item) => !item.hidden);
    if (items.length === 0) return nothing;
    return html`
      <section aria-labelledby="configuration">
        <h3 id="configuration">Configuration</h3>
        <flexrf-edit-panel .core=${this.core} .host=${this.host} component=${this.component.name}></flexrf-edit-panel>
        ${repeat(items, (item) => item.key, (item) => this.configured(item))}
      </section>
    `;
  }

  private configured(item: Item): unknown {
    const { flow } = this.session;
    const name = item.path ?? '';
    const edited = flow.isChanged(this.component.name, name);
    const before = flow.draft?.configuration[this.component.name]?.[name];
    return html`
      <div class="item ${edited ? 'edited' : ''}">
        <flexrf-item .core=${this.core} .host=${this.session.host} .item=${item}></flexrf-item>
        ${edited
          ? html`<div class="edited-note">
              <span>✎ Edited; in force: ${this.inForce(item, before)}</span>
              <button
                ?disabled=${flow.state.step !== 'editing'}
                aria-label="Take back ${item.label}"
                @click=${() => flow.revert(this.component.name, name)}
              >
                Take back
              </button>
            </div>`
          : nothing}
      </div>
    `;
  }

  private inForce(item: Item, value: unknown): string {
    if (typeof value !== 'number') return typeof value === 'object' ? JSON.stringify(value) : String(value);
    const unit = this.core.units.of(item.unit);
    return `${formatNumber(value * unit.factor)}${unit.text === '' ? '' : ` ${unit.text}`}`;
  }

  private items(title: string, all: readonly Item[]): unknown {
    const items = all.filter((item) => !item.hidden);
    if (items.length === 0) return nothing;
    return html`
      <section aria-label=${title}>
        <div class="group-head">
          <h3>${title}</h3>
          ${all === this.component.runtime
            ? html`<flexrf-group-reset .core=${this.core} .items=${all}></flexrf-group-reset>
                <flexrf-undo .core=${this.core}></flexrf-undo>`
            : nothing}
        </div>
        ${this.widgets(items.filter((item) => !isPressed(item)), 'item')}
        ${this.presses(items.filter(isPressed))}
      </section>
    `;
  }

  /** Buttons, below a line that says why they are dead and is there in any case. */
  private presses(items: readonly Item[]): unknown {
    if (items.length === 0) return nothing;
    const reasons = new Set(items.map((item) => this.core.host.locked(item.key)).filter((reason) => reason !== ''));
    return html`
      <p class="why-dead muted">${reasons.size === 0 ? nothing : `Dead: ${[...reasons].join('; ')}`}</p>
      <div class="presses">${this.widgets(items, '')}</div>
    `;
  }

  private widgets(items: readonly Item[], style: string): unknown {
    return repeat(items, (item) => item.key, (item) =>
      html`<flexrf-item class=${style} .core=${this.core} .host=${undefined} .item=${item}></flexrf-item>`);
  }

  private ports(): unknown {
    const ports = portsOf(this.core.model, this.component);
    if (ports.length === 0) return nothing;
    return html`
      <h3 id="ports">Inputs and outputs</h3>
      <div class="scroll" tabindex="0" role="region" aria-labelledby="ports">
        ${table(
          'What it reads and writes',
          ['Name', 'Direction', 'Type', 'Connected to', 'Age, or why NULL', 'Meaning'],
          repeat(ports, (port) => `${port.direction} ${port.name}`, (port) => this.port(port)),
        )}
      </div>
    `;
  }

  private port(port: Port): unknown {
    const line = (content: unknown): unknown => html`<li>${content}</li>`;
    return html`
      <tr>
        <th scope="row">${port.name}</th>
        <td>${port.direction}</td>
        <td>${port.type}</td>
        <td>
          ${port.connections.length === 0
            ? html`<span class="muted">not connected</span>`
            : html`<ul class="plain">
                ${port.connections.map((to) => line(html`<a href=${addressOf('blackboard', to.name)}>${to.name}</a>`))}
              </ul>`}
        </td>
        <td>
          <ul class="plain">
            ${repeat(port.connections, (to) => to.name, (to) =>
              line(
                to.kind === 'slot' && this.core.model.slotsByName.get(to.name)?.json.observe
                  ? html`<flexrf-slot-age .host=${this.host} .slotName=${to.name}></flexrf-slot-age>`
                  : html`<span class="muted">${to.kind === 'queue' ? 'a queue' : 'not observed'}</span>`,
              ))}
          </ul>
        </td>
        <td>${port.summary}${port.maxAge === undefined ? nothing : html` <span class="muted">NULL when older than ${durationText(port.maxAge)}.</span>`}</td>
      </tr>
    `;
  }

  private members(): unknown {
    const { population } = this.component;
    if (population === '') return nothing;
    const members = [...this.core.model.components.values()].filter((one) => one.population === population);
    return html`
      <h3 id="members">Population ${population}</h3>
      <table class=${this.age}>
        <caption>
          Members of the population
        </caption>
        <thead>
          <tr>
            <th scope="col">Member</th>
            <th scope="col">State</th>
          </tr>
        </thead>
        <tbody>
          ${repeat(members, (one) => one.name, (one) => {
            const row = this.rows.get(one.name);
            return html`
              <tr>
                <th scope="row"><a href=${addressOf('units', one.name)} aria-current=${one === this.component ? 'page' : nothing}>${one.name}</a></th>
                <td>${row ? stateText(row) : 'not known yet'}</td>
              </tr>
            `;
          })}
        </tbody>
      </table>
    `;
  }
}
