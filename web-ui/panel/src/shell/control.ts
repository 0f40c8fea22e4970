// The control token: who holds it, taking and giving it back. The question to its holder: consent.ts.
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
