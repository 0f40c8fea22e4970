// The acts of one unit or device as buttons, each locked one with its reason.
import { css, html, nothing } from 'lit';
import { customElement, property, state } from 'lit/decorators.js';
import { textOf } from '../core/reasons';
import { actionsOf, type ActionOffer, type ComponentRow } from './component_actions';
import { ViewBase } from './view_base';
import { viewStyles } from './view_styles';

@customElement('flexrf-component-buttons')
export class ComponentButtons extends ViewBase {
  static override styles = [
    ...viewStyles,
    css`
      /* Reasons come and go; what is below them stays where it is. */
      .reasons,
      .buttons small {
        min-height: 1.35em;
      }
      .reasons {
        margin: 4px 0;
      }
    `,
  ];

  @property({ attribute: false }) row!: ComponentRow;
  /** Active members of its population: what a clone may be made of. */
  @property({ attribute: false }) sources: readonly string[] = [];
  /** The act that is under way. */
  @state() private busy = '';
  @state() private source = '';

  override connectedCallback(): void {
    super.connectedCallback();
    this.until(this.core.watchState(() => this.requestUpdate()));
  }

  protected override render(): unknown {
    const offers = actionsOf(this.row);
    // Said once, not below every button.
    const denied = [...new Set(offers.map((offer) => this.core.deniedAction(offer.role)))].filter((reason) => reason !== '');
    return html`
      <p class="reasons muted">${denied.length === 0 ? nothing : `Locked: ${denied.join('; ')}`}</p>
      <div class="buttons">${offers.map((offer) => this.button(offer))}</div>
    `;
  }

  private button(offer: ActionOffer): unknown {
    const denied = this.core.deniedAction(offer.role);
    const noSource = offer.action === 'clone' && this.sources.length === 0 ? 'No other member is active.' : '';
    const locked = offer.locked || noSource;
    const note = `note-${offer.action}`;
    const reason = denied === '' ? locked : '';
    const dead = denied !== '' || locked !== '' || this.busy !== '';
    return html`
      <div>
        ${offer.action === 'clone' && this.sources.length > 0 ? this.choice(denied !== '' || locked !== '') : nothing}
        <button
          aria-disabled=${dead ? 'true' : nothing}
          aria-busy=${this.busy === offer.action ? 'true' : nothing}
          aria-describedby=${note}
          title=${offer.effect}
          @click=${() => !dead && this.act(offer)}
        >
          ${offer.label}
        </button>
        <small id=${note}>${reason === '' ? html`<span class="hidden">${offer.effect}</span>` : reason}</small>
      </div>
    `;
  }

  private choice(disabled: boolean): unknown {
    return html`
      <label>
        Clone of
        <select ?disabled=${disabled} @change=${(event: Event) => (this.source = (event.target as HTMLSelectElement).value)}>
          ${this.sources.map((name) => html`<option value=${name} ?selected=${name === this.source}>${name}</option>`)}
        </select>
      </label>
    `;
  }

  private async act(offer: ActionOffer): Promise<void> {
    const component = this.row.name;
    const source = this.sources.includes(this.source) ? this.source : this.sources[0];
    this.busy = offer.action;
    const fields = { component, action: offer.action, ...(offer.action === 'clone' && { source }) };
    const answer = await this.core.request('action', fields, 60_000);
    this.busy = '';
    if (answer.ok) this.core.notify(`${component}: ${offer.label} done.`);
    else this.core.notify(`${component}: ${offer.label} failed: ${textOf(answer.problem)}`, 'alarm');
  }
}
