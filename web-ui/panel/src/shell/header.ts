// What is always seen: which application, what it does, whether it may move, how old the page's data is, who has control.
import { css, html, nothing } from 'lit';
import { customElement, query } from 'lit/decorators.js';
import { deniedLink } from '../core/access';
import type { LinkStatus } from '../core/core';
import { modeOf, modeText, motionOf, motionText, stopText } from '../core/words';
import './control';
import './faults';
import { logOut } from './log_out';
import { ShellPart } from './part';
import { Settled } from './settled';
import { shellStyles } from './styles';

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
      /* Lines of fixed height, whatever they say: nothing in the header moves the views below it. */
      :host {
        display: grid;
        gap: 4px;
        padding: 6px 12px;
        background: var(--flexrf-surface);
      }
      .line,
      .motion,
      .session {
        display: flex;
        align-items: center;
        gap: 4px 8px;
        min-width: 0;
        min-height: var(--target);
      }
      .line {
        column-gap: 24px;
      }
      :is(.motion, flexrf-control) {
        min-height: max(var(--target), 2.5em);
      }
      h1 {
        flex: 0 1 auto;
        min-width: 4rem;
        font-size: 1.2em;
        line-height: 1.3;
        margin: 0;
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      flexrf-faults {
        flex: 1 1 0;
      }
      .motion,
      flexrf-control {
        flex: 1 1 0;
      }
      .link {
        font-size: 0.85em;
        font-variant-numeric: tabular-nums;
        white-space: pre-line;
        min-width: 7.5rem;
      }
      .session {
        margin-inline-start: auto;
      }
      .session button {
        flex: none;
      }
      .session > small {
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      .stale :is(span, small),
      flexrf-control.stale {
        color: var(--flexrf-stale);
        font-style: italic;
        font-weight: 400;
      }
      @media (max-height: 500px) {
        :host {
          --target: min(var(--flexrf-target-coarse), 44px);
        }
      }
      /* No larger than a finger needs, as there are more lines. */
      @media (max-width: 1200px) {
        :host {
          --target: min(var(--flexrf-target-coarse), 44px);
        }
        /* Their own host's size for fingers would be the larger one. */
        flexrf-control {
          --target: inherit;
        }
        .line {
          column-gap: 12px;
        }
        .first {
          flex-wrap: wrap;
        }
        h1 {
          flex: 1 1 0;
        }
        flexrf-faults {
          flex: 1 0 100%;
          order: 1;
        }
      }
      @media (max-width: 760px) {
        :host {
          gap: 2px;
          padding: 2px 8px;
        }
        .line {
          row-gap: 2px;
        }
        h1,
        .session {
          flex: 1 0 100%;
        }
        .second {
          display: grid;
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
  readonly #settled = new Settled(this);

  override connectedCallback(): void {
    super.connectedCallback();
    const timer = setInterval(() => this.#tick(), clockPeriod);
    this.until(() => clearInterval(timer));
  }

  protected override updated(): void {
    this.#tick();
  }

  protected override render(): unknown {
    const { core } = this;
    const { session } = core;
    const stale = core.link.stale ? 'stale' : '';
    // Who is not logged in has no link either, and gets one by it.
    const unlinked = deniedLink(core) !== '' && core.link.detail !== 'login';
    const mode = modeOf(core);
    const motion = motionOf(core);
    const abnormal = motion === 'stopped' ? 'alarm' : motion === 'enabled' || motion === 'unknown' ? '' : 'warning';
    const [op, label] = motion === 'stopped' ? ['clear_stop_motion', 'Clear stop'] as const
      : motion === 'inhibited' ? ['start_motion', 'Start motion'] as const : [];
    const denied = op ? core.deniedAction('operator') : '';
    const refused = op === 'start_motion' ? core.state?.motion.start_refused ?? '' : '';
    const settled = this.#settled.is(op ?? '');
    const note = [motion === 'stopped' ? stopText(core.state) : refused, denied && `${label}: ${denied}`].filter((part) => part !== '').join(' · ');
    return html`
      <div class="line first">
        <h1>${core.application || 'FlexRF'}</h1>
        <flexrf-faults .core=${core}></flexrf-faults>
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
      </div>
      <div class="line second">
        <div class="motion ${stale}">
          <div class="said" title=${note || nothing}><span class=${['running', 'starting', 'unknown'].includes(mode) ? '' : 'warning'}>${modeText(mode)}</span>
            <span class=${abnormal}>${abnormal === 'alarm' ? '■ ' : abnormal ? '⚠ ' : ''}${motionText[motion]}</span>
            <small>${note}</small></div>
          ${op ? html`<button ?disabled=${denied !== '' || refused !== '' || !settled} title=${denied || refused || nothing} @click=${() => this.ask(op)}>${label}</button>` : nothing}
        </div>
        <flexrf-control class=${stale} .core=${core}></flexrf-control>
      </div>
    `;
  }

  /** Outside of render(): four times a second, and a value is one Text node. */
  #tick(): void {
    const text = linkText(this.core.link);
    if (this.link && this.link.textContent !== text) this.link.textContent = text;
  }
}
