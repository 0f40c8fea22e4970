// A number to be typed in, with buttons and keys for fine and coarse steps.
import { css, html } from 'lit';
import type { CSSResultGroup, TemplateResult } from 'lit';
import type { Value } from '../contract';
import { EditorBase } from './editor_base';
import { Keypad, keypadStyles } from './keypad';
import { setAttribute } from './live_text';
import type { Steps } from './quantity';
import { widgetStyles } from './styles';
import { dash } from './widget_base';

/** Shift or Page: coarse. Undefined for keys that are no steps. */
export function stepOfKey(event: KeyboardEvent, fine: number, coarse: number): number | undefined {
  if (event.ctrlKey || event.altKey || event.metaKey) return undefined;
  const step = event.shiftKey ? coarse : fine;
  switch (event.key) {
    case 'ArrowUp':
      return step;
    case 'ArrowDown':
      return -step;
    case 'PageUp':
      return coarse;
    case 'PageDown':
      return -coarse;
    default:
      return undefined;
  }
}

export const numberFieldStyles = css`
  .field {
    width: 9ch;
    text-align: right;
  }
  .steps {
    display: inline-flex;
    align-items: center;
    gap: var(--gap);
  }
  .step {
    padding: 0;
  }
`;

export class NumberField extends EditorBase {
  static override styles: CSSResultGroup = [widgetStyles, numberFieldStyles, keypadStyles];
  protected readonly keypad = new Keypad(() => this.requestUpdate());

  protected override render(): TemplateResult {
    return this.controlFrame(html`${this.stepsAround(html``)}<span class="steps typed">${this.field()}${this.unitMark()}</span>${this.keypad.render()}`);
  }

  private sizes: Steps | undefined;
  private steppedTo: number | undefined;

  /** By the value in force; while steps follow one another they do not become smaller on the way. */
  protected get steps(): Steps {
    return (this.sizes ??= this.quantity.steps(0));
  }

  /** Another value than the one that was stepped to begins anew. */
  private follow(value: number): void {
    const before = this.steps;
    const next = this.quantity.steps(value);
    const stepped = this.steppedTo !== undefined && Math.abs(this.quantity.toShown(value - this.steppedTo)) <= 0.5 * before.fine;
    if (!stepped) this.steppedTo = undefined;
    else if (next.fine < before.fine) return;
    this.sizes = next;
    if (next.fine !== before.fine || next.coarse !== before.coarse) this.requestUpdate();
  }

  protected override prepare(): void {
    super.prepare();
    this.sizes = this.steppedTo = undefined; // units are others
  }

  /** −− − [middle] + ++ */
  protected stepsAround(middle: TemplateResult): TemplateResult {
    const { fine, coarse } = this.steps;
    return html`<span class="steps">
      ${this.stepButton(-coarse, '−−')}${this.stepButton(-fine, '−')}${middle}${this.stepButton(fine, '+')}${this.stepButton(coarse, '++')}
    </span>`;
  }

  private stepButton(step: number, sign: string): TemplateResult {
    const amount = this.quantity.stepText(Math.abs(step));
    return html`<button
      type="button"
      class="step"
      data-step=${sign}
      ?disabled=${this.locked !== ''}
      title=${`${step < 0 ? '−' : '+'}${amount}`}
      aria-label=${`${step < 0 ? 'Decrease' : 'Increase'} ${this.label} by ${amount}`}
      @click=${() => this.step(step)}
    >
      ${sign}
    </button>`;
  }

  /** A text field with a number's role: the native number field differs between browsers in commas, wheels and letters. */
  protected field(): TemplateResult {
    const range = this.quantity.range;
    return html`<input
      id="field"
      class="field"
      type="text"
      role="spinbutton"
      inputmode=${this.keypad.inputMode(range && range[0] >= 0 ? 'decimal' : 'text')}
      autocomplete="off"
      spellcheck="false"
      aria-labelledby="label"
      aria-describedby="summary refusal lock"
      ?disabled=${this.locked !== ''}
      @input=${() => this.edit.touch()}
      @focus=${(event: Event) => this.keypad.focus(event.target as HTMLInputElement)}
      @blur=${() => this.leave()}
      @keydown=${(event: KeyboardEvent) => this.onKey(event)}
    />`;
  }

  private onKey(event: KeyboardEvent): void {
    if (event.key === 'Enter') this.commitTyped();
    else if (event.key === 'Escape') this.giveUp();
    else {
      const step = stepOfKey(event, this.steps.fine, this.steps.coarse);
      if (step === undefined) return;
      event.preventDefault();
      this.step(step);
    }
  }

  protected override updated(): void {
    super.updated();
    this.keypad.reveal(this.renderRoot);
  }

  protected override onLocked(): void {
    super.onLocked();
    this.keypad.blur();
  }

  private leave(): void {
    this.commitTyped();
    this.keypad.blur();
  }

  protected commitTyped(): void {
    if (!this.edit.touched || this.question.open) return;
    const parsed = this.quantity.parse(this.find<HTMLInputElement>('#field').value);
    if ('value' in parsed) this.commit(parsed.value);
    else this.edit.refuse(parsed.problem);
  }

  /** From what is shown, or typed: steps add up while answers are under way. */
  protected step(step: number): void {
    const typed = this.edit.touched ? this.quantity.parse(this.find<HTMLInputElement>('#field').value) : undefined;
    const from = typed && 'value' in typed ? typed.value : this.edit.shown;
    if (typeof from !== 'number' || this.locked !== '') return;
    this.steppedTo = this.quantity.stepped(from, step);
    this.commit(this.steppedTo);
  }

  protected override write(value: Value | null): void {
    const field = this.find<HTMLInputElement>('#field');
    const number = typeof value === 'number' ? value : undefined;
    if (number !== undefined) this.follow(number);
    if (!this.isTyping()) {
      const text = number === undefined ? '' : this.quantity.entry(number);
      if (field.value !== text) field.value = text;
    }
    field.placeholder = number === undefined ? dash : '';
    setAttribute(field, 'aria-valuetext', number === undefined ? 'no value' : `${this.quantity.entryText(number)} ${this.quantity.unit}`.trim());
    setAttribute(field, 'aria-valuenow', number === undefined ? '0' : String(this.quantity.toShown(number)));
    const range = this.quantity.range;
    if (range) {
      setAttribute(field, 'aria-valuemin', String(range[0]));
      setAttribute(field, 'aria-valuemax', String(range[1]));
    }
    setAttribute(field, 'aria-busy', String(this.edit.pending));
  }

  /** What is in the field is the person's. */
  protected isTyping(): boolean {
    return this.edit.touched && !this.question.open;
  }
}
