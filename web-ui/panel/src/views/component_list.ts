// The list of units, or of devices, with their state.
import { css, html, nothing } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import { repeat } from 'lit/directives/repeat.js';
import type { Component } from '../core/descriptor';
import { componentRows, stateText, urgency, type ComponentRow } from './component_actions';
import { table } from './table';
import { addressOf, ViewBase } from './view_base';
import { viewStyles } from './view_styles';

@customElement('flexrf-component-list')
export class ComponentList extends ViewBase {
  static override styles = [
    ...viewStyles,
    css`
      .state::before {
        content: '● ';
        color: var(--fill);
      }
      .state.fault::before {
        content: '▲ ';
        color: var(--alarm);
      }
      .state.idle::before {
        content: '○ ';
      }
    `,
  ];

  @property() kind: 'unit' | 'device' = 'unit';
  private rows = new Map<string, ComponentRow>();

  override connectedCallback(): void {
    super.connectedCallback();
    this.watchAge();
    this.until(
      this.core.watchTopic('components', (body) => {
        this.rows = new Map(componentRows(body).map((row) => [row.name, row]));
        this.requestUpdate();
      }, 2),
    );
  }

  protected override render(): unknown {
    const components = [...this.core.model.components.values()].filter((component) => component.kind === this.kind);
    const title = this.kind === 'unit' ? 'Units' : 'Devices';
    if (components.length === 0) return html`<h2>${title}</h2><p>The application has no ${title.toLowerCase()}.</p>`;
    return html`
      <h2>${title}</h2>
      ${this.faults(components)}
      <div class="scroll ${this.age}" tabindex="0" role="region" aria-label=${title}>
        ${table(
          `All ${title.toLowerCase()}, in the order of the tables`,
          ['Name', 'State', ...(this.kind === 'unit' ? ['Type', 'Population'] : ['Interface', 'Driver']), 'Thread'],
          repeat(components, (component) => component.name, (component) => this.row(component)),
        )}
      </div>
    `;
  }

  private row(component: Component): unknown {
    const row = this.rows.get(component.name);
    const sign = row?.life === 'fault' ? 'fault' : row?.life === 'running' && row.active ? 'running' : 'idle';
    return html`
      <tr>
        <th scope="row"><a href=${addressOf(`${this.kind}s`, component.name)}>${component.name}</a></th>
        <td><span class="state ${sign}">${row ? stateText(row) : 'not known yet'}</span></td>
        <td>${component.typeName}</td>
        <td>${this.kind === 'unit' ? this.membership(component) : (row?.driver ?? '')}</td>
        <td>${component.thread === '' ? nothing : html`<a href=${addressOf('threads', component.thread)}>${component.thread}</a>`}</td>
      </tr>
    `;
  }

  private membership(component: Component): string {
    const member = component.unit?.member;
    if (component.population === '') return '';
    return member === undefined ? component.population : `${component.population}, member ${member}`;
  }

  /** What is in fault, before everything else. */
  private faults(components: readonly Component[]): unknown {
    const faulty = components
      .flatMap((component) => this.rows.get(component.name) ?? [])
      .filter((row) => urgency(row) === 0);
    if (faulty.length === 0) return nothing;
    return html`
      <div class="box abnormal-box ${this.age}">
        ${faulty.map(
          (row) => html`<p><a href=${addressOf(`${this.kind}s`, row.name)}>${row.name}</a> <span class="alarm">is in fault:</span> ${row.fault}</p>`,
        )}
      </div>
    `;
  }
}
