// The question to whoever has control, when another asks for it. Loaded once this page has control: before there can be one.
import { css, html, nothing } from 'lit';
import { customElement } from 'lit/decorators.js';
import { deniedLink, nameOf } from '../core/access';
import { ShellPart } from './part';
import { shellStyles } from './styles';

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

  override connectedCallback(): void {
    super.connectedCallback();
    const timer = setInterval(() => this.core.state?.control.wanted_by && this.requestUpdate(), 250);
    this.until(() => clearInterval(timer));
  }

  protected override render(): unknown {
    const control = this.core.state?.control;
    if (!control?.wanted_by || !control.holder?.you) return nothing;
    const dead = deniedLink(this.core) !== '';
    const left = Math.max(0, (control.answer_within_ms ?? 0) - (performance.now() - this.core.stateAt));
    return html`
      <div role="group" aria-label="Request for control">
        <span role="alert"><strong>⚠ ${nameOf(control.wanted_by)} asks for control.</strong>
          Handing over ends what you hold and stops manual motion.</span>
        <span>${dead ? 'No connection: no answer reaches the application.' : `Handed over in ${Math.ceil(left / 1000)} s.`}</span>
        <button class="first" ?disabled=${dead} @click=${() => this.ask('answer_control', { grant: false })}>Keep control</button>
        <button ?disabled=${dead} @click=${() => this.ask('answer_control', { grant: true })}>Hand over</button>
      </div>
    `;
  }
}
