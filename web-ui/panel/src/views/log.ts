// The application's log: follows the newest line unless one scrolls up.
import { css, html, nothing } from 'lit';
import { customElement, query, state } from 'lit/decorators.js';
import type { LogLine } from '../core/protocol';
import { filterField, toolStyles } from './list_tools';
import { filterLines, severities, severityOf, type LogSeverity } from './log_lines';
import { ViewBase } from './view_base';
import { viewStyles } from './view_styles';

const linesShown = 1000;
const signs: { readonly [severity in LogSeverity]: string } = { debug: '', info: '', warning: '⚠ ', error: '✕ ' };

@customElement('flexrf-log')
export class Log extends ViewBase {
  static override styles = [
    viewStyles,
    toolStyles,
    css`
      :host {
        display: flex;
        flex-direction: column;
        height: 100%;
        box-sizing: border-box;
        padding: 0;
      }
      /* The whole label is what a finger meets. */
      input[type='checkbox'] {
        min-width: 0;
        min-height: 0;
        width: 24px;
        height: 24px;
      }
      .lines {
        flex: 1 1 20rem;
        overflow: auto;
        background: var(--field);
        border: 1px solid var(--border);
        padding: 6px 10px;
        font: 13px/1.45 ui-monospace, monospace;
        max-height: 70vh;
      }
      .lines:focus-visible {
        outline: 3px solid var(--focus);
      }
      ol {
        list-style: none;
        margin: 0;
        padding: 0;
      }
      li {
        white-space: pre-wrap;
        overflow-wrap: anywhere;
      }
      .error {
        color: var(--alarm);
      }
    `,
  ];

  @state() private lines: readonly LogLine[] = [];
  @state() private follow = true;
  @state() private least: LogSeverity = 'debug';
  @state() private wanted = '';
  @query('.lines') private box!: HTMLElement;

  override connectedCallback(): void {
    super.connectedCallback();
    this.lines = [];
    this.until(this.core.watchLog((fresh) => {
      this.lines = [...this.lines, ...fresh].slice(-2 * linesShown);
    }));
  }

  protected override updated(): void {
    if (this.follow) this.box.scrollTop = this.box.scrollHeight;
  }

  protected override render(): unknown {
    const wanted = filterLines(this.lines, this.least, this.wanted);
    const shown = wanted.slice(-linesShown);
    return html`
      <h2>Log</h2>
      <div class="tools">
        ${filterField(this.wanted, (wanted) => { this.wanted = wanted; })}
        <label>At least <select @change=${(event: Event) => {
          this.least = (event.target as HTMLSelectElement).value as LogSeverity;
        }}>${severities.map((name) => html`<option ?selected=${name === this.least}>${name}</option>`)}</select></label>
        <label><input type="checkbox" .checked=${this.follow} @change=${(event: Event) => {
          this.follow = (event.target as HTMLInputElement).checked;
        }} /> Follow</label>
        <span class="muted">${shown.length} of ${this.lines.length} lines</span>
      </div>
      <div class="lines" tabindex="0" role="log" aria-label="Lines of the log" aria-live="off" @scroll=${() => this.onScroll()}>
        <ol>${shown.map((line) => {
          const severity = severityOf(line.text);
          return html`<li class=${severity}>${signs[severity]}${line.text}</li>`;
        })}</ol>
        ${shown.length === 0 ? html`<p>${this.lines.length === 0 ? 'Nothing was logged yet.' : 'No line is like this.'}</p>` : nothing}
      </div>
    `;
  }

  private onScroll(): void {
    const { scrollTop, scrollHeight, clientHeight } = this.box;
    this.follow = scrollHeight - scrollTop - clientHeight < 24;
  }
}
