// Stop motion: any session that sees the page may give it. It lies in a cell of the page's grid that nothing else can cover.
import { css, html } from 'lit';
import { customElement } from 'lit/decorators.js';
import { deniedLink } from '../core/access';
import { postJson } from '../core/http';
import { motionOf } from '../core/words';
import { ShellPart } from './part';
import { shellStyles } from './styles';

// An answer that does not come in this time is not waited for: the other way is tried beside it.
const patience = 200;

@customElement('flexrf-stop-motion')
export class StopMotion extends ShellPart {
  static override styles = [
    shellStyles,
    css`
      :host {
        display: flex;
        flex-direction: column;
        gap: 2px;
        padding: 6px 10px;
        text-align: center;
      }
      button {
        min-height: 56px;
        min-width: 13rem;
        font-size: 1.25em;
        font-weight: 700;
        color: var(--flexrf-stop-text);
        background: var(--flexrf-stop);
        border: 3px solid var(--flexrf-text);
        user-select: none;
      }
      button[aria-disabled='true'] {
        color: var(--flexrf-stale);
        background: transparent;
        border: 3px dashed var(--flexrf-stale);
      }
      button[aria-pressed='true'] {
        box-shadow: inset 0 0 0 4px var(--flexrf-stop-text);
      }
      small {
        max-width: 15rem;
        margin-inline: auto;
        line-height: 1.2;
      }
      @media (max-width: 760px) {
        small {
          max-width: none;
        }
      }
    `,
  ];

  protected override render(): unknown {
    const dead = deniedLink(this.core) !== '';
    const stopped = motionOf(this.core) === 'stopped';
    return html`
      <button aria-disabled=${dead} aria-pressed=${stopped} aria-describedby="what"
        @pointerdown=${(event: PointerEvent) => event.button === 0 && this.#stop()}
        @keydown=${(event: KeyboardEvent) => this.#onKey(event)}
        @click=${(event: MouseEvent) => event.detail === 0 && this.#stop()}>
        ■ ${stopped ? 'Motion is stopped' : 'Stop motion'}
      </button>
      <small id="what">${dead
        ? 'No connection: use the emergency stop at the machine.'
        : 'Neither an emergency stop nor an enabling device.'}</small>
    `;
  }

  /** When the key goes down: a browser's click by the space bar comes when it is let go, and not after Escape. */
  #onKey(event: KeyboardEvent): void {
    if (event.key !== ' ' && event.key !== 'Enter') return;
    event.preventDefault();
    if (!event.repeat) this.#stop();
  }

  /** By the open socket; when that has no answer at once, by a request beside it. Stopping twice is stopping. */
  #stop(): void {
    void this.core.request('stop_motion', {}, patience).then(async (answer) => {
      if (answer.ok) return;
      const second = await postJson('/api/v1/stop-motion');
      if (!second.ok) this.core.notify(`Stop motion did not reach the application (${second.detail}). Use the emergency stop at the machine.`, 'alarm');
    });
  }
}
