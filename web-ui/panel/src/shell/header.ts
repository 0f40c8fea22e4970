// What is always seen: which application, what it does, whether it may move, how old the page's data is, who has control.
import { css, html, nothing } from 'lit';
import { customElement, query } from 'lit/decorators.js';
import { textOf } from '../core/host';
import type { LinkStatus } from '../core/core';
import './control';
import { logOut } from './log_out';
import { ShellPart } from './part';
import { shellStyles } from './styles';
import { modeText, motionOf, motionText, stopText } from './words';

const clockPeriod = 250;

export function linkText(link: LinkStatus): string {
  if (link.phase === 'connecting') return 'Connecting…';
  if (link.phase === 'waiting') return '✕ No connection';
  if (link.stale) return `⚠ Silent for ${(link.silence / 1000).toFixed(1)} s`;
  const trip = link.roundTrip === undefined ? 'Connected' : `Round trip ${link.roundTrip.toFixed(link.roundTrip < 10 ? 1 : 0)} ms`;
  return `${trip}\ndata ${(link.silence / 1000).toFixed(1)} s old`;
}

/** Says `login` and `settings` (Events) when the person wants these dialogs. */
@customElement('flexrf-header')
export class Header extends ShellPart {
  static override styles = [
    shellStyles,
    css`
      :host {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 4px 24px;
        padding: 6px 12px;
        background: var(--flexrf-surface);
      }
      h1 {
        font-size: 1.2em;
        margin: 0;
      }
      div {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 4px 8px;
      }
      .link {
        font-size: 0.85em;
        font-variant-numeric: tabular-nums;
        white-space: pre-line;
        min-width: 7.5rem;
      }
      .session {
        margin-inline-start: auto;
        flex-wrap: nowrap;
      }
      .stale :is(span, flexrf-control) {
        color: var(--flexrf-stale);
        font-style: italic;
        font-weight: 400;
      }
      @media (max-height: 500px) {
        :host {
          --target: min(var(--flexrf-target-coarse), 44px);
        }
      }
      @media (max-width: 760px) {
        :host {
          --target: min(var(--flexrf-target-coarse), 44px);
          gap: 2px 12px;
          padding: 2px 8px;
        }
        .session {
          flex: 1 1 100%;
        }
        .link {
          flex: 1;
        }
      }
    `,
  ];

  @query('.link') private link!: HTMLElement;
  #timer: ReturnType<typeof setInterval> | undefined;

  override connectedCallback(): void {
    super.connectedCallback();
    this.#timer = setInterval(() => this.#tick(), clockPeriod);
  }
  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearInterval(this.#timer);
  }

  protected override updated(): void {
    this.#tick();
  }

  protected override render(): unknown {
    const { core } = this;
    const { state, session } = core;
    const stale = core.link.stale ? 'stale' : '';
    const motion = motionOf(state);
    const abnormal = motion === 'stopped' ? 'alarm' : motion === 'inhibited' ? 'warning' : '';
    return html`
      <h1>${core.application || 'FlexRF'}</h1>
      <div class=${stale}>
        <span class=${state && state.mode !== 'running' && state.mode !== 'starting' ? 'warning' : ''}>${state ? modeText(state.mode) : '–'}</span>
        <span class=${abnormal}>${abnormal === 'alarm' ? '■ ' : abnormal ? '⚠ ' : ''}${motionText[motion]}</span>
        ${motion === 'stopped' ? html`<small>${stopText(state)}</small>${this.#action('clear_stop_motion', 'Clear stop')}` : nothing}
        ${motion === 'inhibited' ? this.#action('start_motion', 'Start motion') : nothing}
      </div>
      <div class=${stale}><flexrf-control .core=${core}></flexrf-control></div>
      <div class="session">
        <span class="link"></span>
        <small>${session?.lapsed ? `${session.user}: log in again` : session ? `${session.user || session.name}: ${session.role}` : ''}</small>
        ${session?.user && !session.lapsed
          ? html`<button @click=${() => logOut(core)}>Log out</button>`
          : session?.role === 'admin'
            ? nothing // by the address that the application printed
            : html`<button @click=${() => this.dispatchEvent(new Event('login'))}>Log in</button>`}
        <button aria-label="Settings" title="Settings" @click=${() => this.dispatchEvent(new Event('settings'))}>⚙</button>
      </div>
    `;
  }

  #action(op: 'clear_stop_motion' | 'start_motion', label: string): unknown {
    const denied = this.core.deniedAction('operator');
    return html`<button ?disabled=${denied !== ''} title=${denied || nothing} @click=${() => this.#ask(op)}>${label}</button>
      ${denied ? html`<small>${denied}</small>` : nothing}`;
  }

  async #ask(op: string): Promise<void> {
    const answer = await this.core.request(op);
    if (!answer.ok) this.core.notify(textOf(answer.problem), 'warning');
  }

  /** Outside of render(): four times a second, and a value is one Text node. */
  #tick(): void {
    const text = linkText(this.core.link);
    if (this.link && this.link.textContent !== text) this.link.textContent = text;
  }
}
