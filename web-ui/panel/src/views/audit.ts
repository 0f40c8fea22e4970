// Who did what, newest first: the entries that the application keeps, for admins.
import { css, html, nothing } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { getJson } from '../core/http';
import { actOf, filterEntries, timeOf, type AuditEntry } from './audit_entries';
import { filterField, toolStyles } from './list_tools';
import { ViewBase } from './view_base';
import { viewStyles } from './view_styles';

const period = 2000;
const kept = 1000;

@customElement('flexrf-audit')
export class Audit extends ViewBase {
  static override styles = [
    viewStyles,
    toolStyles,
    css`
      th,
      td {
        padding: 4px 12px 4px 0;
        border-block-end: 1px solid var(--border);
        overflow-wrap: anywhere;
      }
      th:nth-child(-n + 2) {
        width: 1%;
      }
      td:nth-child(-n + 2) {
        padding-inline-end: 24px;
        white-space: nowrap;
        font-variant-numeric: tabular-nums;
      }
      @media (max-width: 760px) {
        td:nth-child(-n + 2) {
          padding-inline-end: 8px;
          white-space: normal;
        }
      }
    `,
  ];

  @state() private entries: readonly AuditEntry[] = [];
  @state() private trouble = '';
  @state() private wanted = '';
  #last = 0;

  override connectedCallback(): void {
    super.connectedCallback();
    const timer = setInterval(() => void this.#fetch(), period);
    this.until(() => clearInterval(timer));
    void this.#fetch();
  }

  async #fetch(): Promise<void> {
    const answer = await getJson<{ last: number; entries: readonly AuditEntry[] }>(`/api/v1/audit?after=${this.#last}`);
    this.trouble = answer.ok ? '' : answer.detail;
    if (!answer.ok) return;
    // An application that was started anew counts anew.
    const begun = answer.body.last < this.#last;
    this.#last = begun ? 0 : answer.body.last;
    if (begun) this.entries = [];
    else if (answer.body.entries.length > 0) this.entries = [...this.entries, ...answer.body.entries].slice(-kept);
  }

  protected override render(): unknown {
    const shown = [...filterEntries(this.entries, this.wanted)].reverse();
    return html`
      <h2>Audit</h2>
      <p class="muted">Who did what. The file of the application has more; what it did by itself is in the log.</p>
      ${this.trouble ? html`<p role="alert">⚠ ${this.trouble}</p>` : nothing}
      <div class="tools">
        ${filterField(this.wanted, (wanted) => { this.wanted = wanted; })}
        <span class="muted">${shown.length} of ${this.entries.length} entries</span>
      </div>
      ${shown.length === 0
        ? html`<p>${this.entries.length === 0 ? 'Nobody has done anything yet.' : 'No entry is like this.'}</p>`
        : html`<table>
            <thead><tr><th scope="col">When</th><th scope="col">Who</th><th scope="col">Did</th></tr></thead>
            <tbody>${shown.map((entry) => html`<tr><td>${timeOf(entry.at)}</td><td>${entry.who}</td><td>${actOf(entry)}</td></tr>`)}</tbody>
          </table>`}
    `;
  }
}
