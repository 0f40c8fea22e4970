// What is always seen: which application, what it does, whether it may move, how old the page's data is, who has control.
import { css, html, nothing } from 'lit';
import { customElement, query } from 'lit/decorators.js';
import { deniedLink } from '../core/access';
import { textOf } from '../core/host';
import type { LinkStatus } from '../core/core';
import './control';
import './faults';
import { logOut } from './log_out';
import { ShellPart } from './part';
import { shellStyles } from './styles';
import { modeOf, modeText, motionOf, motionText, stopText } from './words';

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
        /* A button that comes or goes moves nothing below. */
        min-height: var(--target);
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
      flexrf-faults {
        flex: 1 0 100%;
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
      /* Name and session in the first line, so that the others are few; no larger than a finger needs. */
      @media (max-width: 1100px) {
        :host {
          --target: min(var(--flexrf-target-coarse), 44px);
          column-gap: 12px;
        }
        /* Their own host's size for fingers would be the larger one. */
        flexrf-control {
          --target: inherit;
        }
        h1 {
          order: -2;
          flex: 1 1 max(5rem, 100% - 26rem);
          min-width: 0;
          overflow: hidden;
          text-overflow: ellipsis;
        }
        .session {
          order: -1;
        }
      }
      @media (max-width: 760px) {
        :host {
          row-gap: 2px;
          padding: 2px 8px;
        }
        .unnamed {
          display: none;
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
    const { session } = core;
    const stale = core.link.stale ? 'stale' : '';
    // Who is not logged in has no link either, and gets one by it.
    const unlinked = deniedLink(core.situation) !== '' && core.link.detail !== 'login';
    const mode = modeOf(core);
    const motion = motionOf(core);
    const abnormal = motion === 'stopped' ? 'alarm' : motion === 'enabled' || motion === 'unknown' ? '' : 'warning';
    return html`
      <h1>${core.application || 'FlexRF'}</h1>
      <div class=${stale}>
        <span class=${['running', 'starting', 'unknown'].includes(mode) ? '' : 'warning'}>${modeText(mode)}</span>
        <span class=${abnormal}>${abnormal === 'alarm' ? '■ ' : abnormal ? '⚠ ' : ''}${motionText[motion]}</span>
        ${motion === 'stopped' ? html`<small>${stopText(core.state)}</small>${this.#action('clear_stop_motion', 'Clear stop')}` : nothing}
        ${motion === 'inhibited' ? this.#action('start_motion', 'Start motion') : nothing}
      </div>
      <div class=${stale}><flexrf-control .core=${core}></flexrf-control></div>
      <div class="session">
        <span class="link"></span>
        <small>${session?.lapsed ? `${session.user}: log in again` : session
          ? html`<span class=${session.user ? '' : 'unnamed'}>${session.user || session.name}: </span>${session.role}`
          : ''}</small>
        ${session?.user && !session.lapsed
          ? html`<button ?disabled=${unlinked} @click=${() => logOut(core)}>Log out</button>`
          : session?.role === 'admin'
            ? nothing // by the address that the application printed
            : html`<button ?disabled=${unlinked} @click=${() => this.dispatchEvent(new Event('login'))}>Log in</button>`}
        <button aria-label="Settings" title="Settings" @click=${() => this.dispatchEvent(new Event('settings'))}>⚙</button>
      </div>
      <flexrf-faults .core=${core}></flexrf-faults>
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
