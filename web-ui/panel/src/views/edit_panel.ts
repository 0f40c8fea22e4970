// Edit, Apply, Discard: the flow of changing configuration parameters, as it is seen on a component's page.
import { html, nothing, type PropertyValues } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import { countdownText } from './durations';
import type { Draft, EditState } from './edit_flow';
import { EditSession } from './edit_session';
import { addressOf, ViewBase } from './view_base';
import { viewStyles } from './view_styles';

const outcomes = {
  done: 'Applied. Everything was initialised again; nothing moves before the next Start of motion.',
  fault: 'Fault: a component could be initialised neither with these values nor with the former ones.',
} as const;

const failures = {
  refused: 'Refused; nothing was stopped.',
  rolled_back: 'Rolled back: a component could not be initialised with these values. The former ones are in force.',
} as const;

@customElement('flexrf-edit-panel')
export class EditPanel extends ViewBase {
  static override styles = viewStyles;

  /** The component whose page this is. */
  @property() component = '';
  private session!: EditSession;
  private shownStep: EditState['step'] = 'closed';

  override connectedCallback(): void {
    super.connectedCallback();
    this.session = EditSession.of(this.core);
    this.shownStep = this.session.flow.state.step;
    this.until(this.session.watch(() => this.requestUpdate()));
  }

  protected override render(): unknown {
    const { state } = this.session.flow;
    switch (state.step) {
      case 'closed':
      case 'opening':
        return this.closed(state.step === 'opening');
      case 'denied':
        return this.denied(state.detail, state.moving);
      case 'editing':
      case 'applying':
        return this.editing(state.draft, state.step === 'applying');
      case 'applied':
        return this.result(outcomes[state.outcome], state.causes, state.outcome !== 'done', state.owners);
      case 'ended':
        return this.result(state.reason, [], true, []);
    }
  }

  /** When a step replaces another, the focus goes to what replaced it rather than being lost. */
  protected override updated(_changed: PropertyValues): void {
    const { step } = this.session.flow.state;
    if (step === this.shownStep) return;
    const began = this.shownStep === 'closed' && step === 'opening';
    this.shownStep = step;
    const focused = (this.renderRoot as ShadowRoot).activeElement;
    if (began || step === 'applying' || focused !== null) return;
    const elsewhere = document.activeElement !== null && document.activeElement !== document.body;
    if (!elsewhere) this.renderRoot.querySelector<HTMLElement>('[data-first]')?.focus();
  }

  private closed(opening: boolean): unknown {
    const { denied } = this.session;
    return html`
      <p class="muted" id="why">
        ${denied === '' ? 'Locked while initialised. Edit needs that nothing moves, and stops what uses these values.' : `Locked: ${denied}`}
      </p>
      <button
        data-first
        aria-describedby="why"
        aria-disabled=${denied === '' ? nothing : 'true'}
        aria-busy=${opening ? 'true' : nothing}
        @click=${() => this.open()}
      >
        Edit
      </button>
    `;
  }

  private denied(detail: string, moving: readonly string[]): unknown {
    return html`
      <div class="box abnormal-box" role="alert">
        <p class="alarm">Edit is not possible now.</p>
        <p>${detail}</p>
        ${moving.length === 0
          ? nothing
          : html`<p>What moves:</p>
              <ul>
                ${moving.map((name) => html`<li>${this.link(name)}</li>`)}
              </ul>
              <p>Use Stop motion, then try again.</p>`}
      </div>
      <div class="buttons">
        <button data-first aria-disabled=${this.session.denied === '' ? nothing : 'true'} @click=${() => this.open()}>Try again</button>
        <button @click=${() => this.session.flow.discard()}>Close</button>
      </div>
    `;
  }

  private editing(draft: Draft, applying: boolean): unknown {
    const { flow } = this.session;
    const { unlinked } = this.session;
    const cannot = applying ? 'The changes are being applied.' : unlinked || flow.cannotApply;
    const count = flow.changes.reduce((sum, change) => sum + Object.keys(change.values).length, 0);
    const here = draft.configuration[this.component] !== undefined;
    return html`
      <div class="box edit-box" role="group" aria-label="Editing configuration" tabindex="-1" data-first>
        <p>
          <strong>${applying ? 'Applying…' : 'Editing.'}</strong> ${here ? nothing : html`This component is not part of this edit. `}
          ${count === 0 ? 'Nothing was changed yet.' : `${count} ${count === 1 ? 'value' : 'values'} changed.`}
          <span role="timer">Discarded in ${countdownText(flow.left / 1000)}.</span>
        </p>
        <p>Apply stops, in this order, and initialises again:</p>
        <ol>
          ${draft.reinitialised.map((name) => html`<li>${this.link(name)}</li>`)}
        </ol>
        ${this.changes(draft)}
        <div role="alert">${this.failure(draft)}</div>
        <div class="buttons">
          <div>
            <button
              aria-disabled=${cannot === '' ? nothing : 'true'}
              aria-busy=${applying ? 'true' : nothing}
              aria-describedby="cannot"
              @click=${() => cannot === '' && flow.apply()}
            >
              Apply
            </button>
            <small id="cannot">${cannot}</small>
          </div>
          <div>
            <button
              aria-disabled=${applying || unlinked ? 'true' : nothing}
              title=${unlinked || nothing}
              @click=${() => unlinked === '' && flow.discard()}
            >
              Discard
            </button>
          </div>
        </div>
      </div>
    `;
  }

  private failure(draft: Draft): unknown {
    if (draft.failure === '') return nothing;
    return html`
      <p class="alarm">${failures[draft.failure]}</p>
      <ul>
        ${draft.causes.map((cause) => html`<li>${cause}</li>`)}
      </ul>
    `;
  }

  /** What was edited on other pages, so that nobody applies what he does not see. */
  private changes(draft: Draft): unknown {
    const others = Object.entries(draft.changed).filter(([component]) => component !== this.component);
    if (others.length === 0) return nothing;
    return html`
      <p>Changed elsewhere in this edit:</p>
      <ul>
        ${others.map(([component, values]) => html`<li>${this.link(component)}: ${Object.keys(values).join(', ')}</li>`)}
      </ul>
    `;
  }

  private result(text: string, causes: readonly string[], abnormal: boolean, owners: readonly string[]): unknown {
    return html`
      <div class="box ${abnormal ? 'abnormal-box' : 'edit-box'}" role=${abnormal ? 'alert' : 'status'}>
        <p class=${abnormal ? 'alarm' : ''}>${text}</p>
        ${causes.length === 0
          ? nothing
          : html`<ul>
              ${causes.map((cause) => html`<li>${cause}</li>`)}
            </ul>`}
        ${owners.length === 0 ? nothing : html`<p class="muted">Initialised again: ${owners.join(', ')}.</p>`}
      </div>
      <button data-first @click=${() => this.session.flow.discard()}>Close</button>
    `;
  }

  private link(name: string): unknown {
    const component = this.core.model.components.get(name);
    return component === undefined ? name : html`<a href=${addressOf(`${component.kind}s`, name)}>${name}</a>`;
  }

  private open(): void {
    if (this.session.denied === '') void this.session.flow.open([this.component]);
  }
}
