// "Really?" beside the control, where the table asks for it with `confirm`: never a dialog, which would lie over
// the button that stops motion.
import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { placeOver } from './place_over';

export class Question {
  private act: (() => void) | undefined;
  private giveUp: (() => void) | undefined;

  constructor(
    /** What the table says: a question, or true for the usual one. */
    private readonly confirm: () => Value | undefined,
    private readonly changed: () => void,
  ) {}

  /** Whether anything is asked at all. */
  get wanted(): boolean {
    const confirm = this.confirm();
    return confirm === true || (typeof confirm === 'string' && confirm !== '');
  }
  get open(): boolean {
    return this.act !== undefined;
  }

  /** Does it at once, or after a yes. */
  ask(act: () => void, giveUp: () => void = () => undefined): void {
    if (!this.wanted) return act();
    this.act = act;
    this.giveUp = giveUp;
    this.changed();
  }

  answer(yes: boolean): void {
    const { act, giveUp } = this;
    this.act = this.giveUp = undefined;
    if (yes) act?.();
    else giveUp?.();
    this.changed();
  }

  /** After drawing: over what is beside it. */
  place(root: ParentNode): void {
    const question = root.querySelector<HTMLElement>('.question');
    if (question) placeOver(question);
  }

  render(label: string): TemplateResult | typeof nothing {
    if (!this.open) return nothing;
    const confirm = this.confirm();
    return html`<span class="question over" role="group" aria-label="Confirm">
      <span role="alert">${typeof confirm === 'string' ? confirm : `Really: ${label}?`}</span>
      <button type="button" id="yes" @click=${() => this.answer(true)}>Yes</button>
      <button type="button" id="no" @click=${() => this.answer(false)}>No</button>
    </span>`;
  }
}
