// The control token: who holds it, taking and giving it back. The question to its holder: consent.ts.
import { css, html } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { deniedControl, deniedLink, hasControl, nameOf } from '../core/access';
import { ShellPart } from './part';
import { Settled } from './settled';
import { shellStyles } from './styles';

@customElement('flexrf-control')
export class Control extends ShellPart {
  static override styles = [
    shellStyles,
    css`
      :host {
        display: flex;
        align-items: center;
        gap: 8px;
        min-width: 0;
        min-height: var(--target);
      }
      .mine {
        font-weight: 600;
      }
    `,
  ];

  @state() private busy = false;
  readonly #settled = new Settled(this);

  protected override render(): unknown {
    const control = this.core.state?.control;
    const mine = hasControl(this.core.situation);
    const asked = control?.wanted_by?.you === true;
    const denied = deniedControl(this.core.situation);
    const holder = control?.holder;
    const dead = !this.#settled.is(mine ? 'release' : 'take') || this.busy;
    const note = mine ? '' : asked ? 'The holder has 10 s to refuse.' : denied || this.core.controlRefused;
    const who = mine ? '✓ You have control' : holder ? `${nameOf(holder)} has control` : 'Nobody has control';
    return html`
      <div class="said" title=${`${who} ${note}`}><span class=${mine ? 'mine' : ''}>${who}</span> <small id="why">${note}</small></div>
      ${mine
        ? html`<button ?disabled=${dead || deniedLink(this.core) !== ''} @click=${() => this.#act('release_control')}>Release</button>`
        : html`<button ?disabled=${dead || asked || denied !== ''} aria-describedby="why"
            @click=${() => this.#act('take_control')}>${asked ? 'Asked…' : holder ? 'Ask for control' : 'Take control'}</button>`}
    `;
  }

  async #act(op: 'take_control' | 'release_control'): Promise<void> {
    this.busy = true;
    await this.ask(op);
    this.busy = false;
  }
}
