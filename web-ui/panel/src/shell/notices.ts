// Short messages to the person, spoken by screen readers too. Alarms stay until they are put away.
import { LitElement, css, html } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import type { Severity } from '../core/panel_core';
import { shellStyles } from './styles';

const infoStays = 6000;
const most = 4;
const signs: { readonly [severity in Severity]: string } = { info: 'ℹ', warning: '⚠', alarm: '✕' };

interface Notice {
  readonly number: number;
  readonly text: string;
  readonly severity: Severity;
}

@customElement('flexrf-notices')
export class Notices extends LitElement {
  static override styles = [
    shellStyles,
    css`
      :host {
        position: absolute;
        inset: auto 8px 8px auto;
        width: min(28rem, calc(100% - 16px));
        pointer-events: none;
      }
      p {
        display: flex;
        align-items: center;
        justify-content: space-between;
        gap: 8px;
        margin: 6px 0 0;
        padding: 6px 6px 6px 12px;
        background: var(--flexrf-surface);
        border: 1px solid var(--flexrf-border);
        border-inline-start-width: 6px;
        border-radius: var(--flexrf-radius);
        overflow-wrap: anywhere;
        pointer-events: auto;
      }
      .alarm {
        border-color: var(--flexrf-alarm);
      }
      .warning {
        border-color: var(--flexrf-warning);
      }
    `,
  ];

  @state() private notices: readonly Notice[] = [];
  #count = 0;

  add(text: string, severity: Severity): void {
    this.#count += 1;
    const notice = { number: this.#count, text, severity };
    this.notices = [...this.notices.filter((one) => one.text !== text), notice].slice(-most);
    if (severity !== 'alarm') setTimeout(() => this.#remove(notice.number), infoStays);
  }

  protected override render(): unknown {
    const list = (alarm: boolean) => this.notices.filter((notice) => (notice.severity === 'alarm') === alarm).map((notice) => html`
      <p class=${notice.severity}><span>${signs[notice.severity]} ${notice.text}</span>
        <button aria-label="Put away: ${notice.text}" @click=${() => this.#remove(notice.number)}>✕</button></p>`);
    return html`<div role="status">${list(false)}</div><div role="alert">${list(true)}</div>`;
  }

  #remove(number: number): void {
    this.notices = this.notices.filter((notice) => notice.number !== number);
  }
}
