// The control token: who holds it, taking and giving it back, and the question to its holder.
import { css, html, nothing } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { deniedControl, deniedLink, hasControl, nameOf } from '../core/access';
import { textOf } from '../core/host';
import { ShellPart } from './part';
import { shellStyles } from './styles';

@customElement('flexrf-control')
export class Control extends ShellPart {
  static override styles = [
    shellStyles,
    css`
      :host {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 2px 8px;
      }
      small {
        flex-basis: 100%;
      }
      @media (max-width: 1100px) {
        small {
          flex-basis: auto;
        }
      }
      .mine {
        font-weight: 600;
      }
    `,
  ];

  @state() private busy = false;

  protected override render(): unknown {
    const control = this.core.state?.control;
    const mine = hasControl(this.core.situation);
    const asked = control?.wanted_by?.you === true;
    const denied = deniedControl(this.core.situation);
    const holder = control?.holder;
    const note = mine ? '' : asked ? 'The holder has 10 s to refuse.' : denied || this.core.controlRefused;
    return html`
      <span class=${mine ? 'mine' : ''}>${mine ? '✓ You have control' : holder ? `${nameOf(holder)} has control` : 'Nobody has control'}</span>
      ${mine
        ? html`<button ?disabled=${this.busy || deniedLink(this.core.situation) !== ''} @click=${() => this.#ask('release_control')}>Release</button>`
        : html`<button ?disabled=${this.busy || asked || denied !== ''} aria-describedby="why"
            @click=${() => this.#ask('take_control')}>${asked ? 'Asked…' : holder ? 'Ask for control' : 'Take control'}</button>`}
      ${note ? html`<small id="why">${note}</small>` : nothing}
    `;
  }

  async #ask(op: 'take_control' | 'release_control'): Promise<void> {
    this.busy = true;
    const answer = await this.core.request(op);
    this.busy = false;
    if (!answer.ok) this.core.notify(textOf(answer.problem), 'warning');
  }
}

/**
 * Asks the holder whether another may have control. It takes neither the focus nor the pointer: a jog button that is being
 * held must see its release.
 */
@customElement('flexrf-consent')
export class Consent extends ShellPart {
  static override styles = [
    shellStyles,
    css`
      div {
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        gap: 8px;
        padding: 8px 12px;
        background: var(--flexrf-surface);
        border-block: 3px solid var(--flexrf-warning);
      }
    `,
  ];

  #timer: ReturnType<typeof setInterval> | undefined;

  override connectedCallback(): void {
    super.connectedCallback();
    this.#timer = setInterval(() => this.core.state?.control.wanted_by && this.requestUpdate(), 250);
  }
  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearInterval(this.#timer);
  }

  protected override render(): unknown {
    const control = this.core.state?.control;
    if (!control?.wanted_by || !control.holder?.you) return nothing;
    const dead = deniedLink(this.core.situation) !== '';
    const left = Math.max(0, (control.answer_within_ms ?? 0) - (performance.now() - this.core.stateAt));
    return html`
      <div role="group" aria-label="Request for control">
        <span role="alert"><strong>⚠ ${nameOf(control.wanted_by)} asks for control.</strong>
          Handing over ends what you hold and stops manual motion.</span>
        <span>${dead ? 'No connection: no answer reaches the application.' : `Handed over in ${Math.ceil(left / 1000)} s.`}</span>
        <button class="first" ?disabled=${dead} @click=${() => this.#answer(false)}>Keep control</button>
        <button ?disabled=${dead} @click=${() => this.#answer(true)}>Hand over</button>
      </div>
    `;
  }

  async #answer(grant: boolean): Promise<void> {
    const answer = await this.core.request('answer_control', { grant });
    if (!answer.ok) this.core.notify(textOf(answer.problem), 'warning');
  }
}
