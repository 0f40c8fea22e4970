// A number by a slider, with fine and coarse steps, and a field to type it in.
import { css, html } from 'lit';
import type { CSSResultGroup, TemplateResult } from 'lit';
import type { Value } from '../contract';
import { listen } from '../core/listen';
import { keypadStyles } from './keypad';
import { setAttribute } from './live_text';
import { NumberField, numberFieldStyles, stepOfKey } from './number_field';
import { widgetStyles } from './styles';

export class Slider extends NumberField {
  static override styles: CSSResultGroup = [
    widgetStyles,
    numberFieldStyles,
    keypadStyles,
    css`
      .steps {
        flex: 1 1 14rem;
      }
      .typed {
        flex: 0 0 auto;
      }
      input[type='range'] {
        flex: 1 1 4rem;
        min-width: 4rem;
        width: 100%;
        touch-action: pan-y;
      }
      .controls {
        flex: 1 1 100%;
        display: flex;
        flex-wrap: wrap;
        align-items: center;
        justify-content: flex-end;
        gap: var(--gap);
      }
    `,
  ];
  private dragging = false;

  protected override render(): TemplateResult {
    const range = this.quantity.range;
    const slider = html`<input
      id="slider"
      type="range"
      step="any"
      min=${range?.[0] ?? 0}
      max=${range?.[1] ?? 1}
      aria-labelledby="label"
      aria-describedby="summary refusal lock"
      @pointerdown=${() => this.grip()}
      @input=${() => this.drag()}
      @keydown=${(event: KeyboardEvent) => this.onSliderKey(event)}
    />`;
    return this.controlFrame(html`${this.stepsAround(slider)}<span class="steps typed">${this.field()}${this.unitMark()}</span>${this.keypad.render()}`);
  }

  override connectedCallback(): void {
    super.connectedCallback();
    // The hand may leave the slider before it lets go.
    for (const name of ['pointerup', 'pointercancel', 'blur']) this.until(listen(window, name, () => this.letGo()));
  }

  protected override onLocked(): void {
    this.dragging = false;
    super.onLocked();
  }

  private grip(): void {
    if (this.locked !== '') return;
    this.dragging = true;
    this.edit.touch();
  }

  private drag(): void {
    if (this.locked !== '') return;
    const value = this.fromSlider();
    // Where a question is asked, only the place where the hand lets go counts.
    if (this.question.wanted) {
      if (!this.dragging) this.commit(value);
    } else {
      this.edit.put(value);
    }
  }

  private letGo(): void {
    if (!this.dragging) return;
    this.dragging = false;
    if (this.question.wanted) this.commit(this.fromSlider());
    else this.edit.letGo();
  }

  private fromSlider(): number {
    const shown = Number(this.find<HTMLInputElement>('#slider').value);
    return this.quantity.toSi(this.quantity.clamped(this.quantity.rounded(shown)));
  }

  private onSliderKey(event: KeyboardEvent): void {
    const { fine, coarse } = this.steps;
    const sideways = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
    const step = sideways !== 0 ? sideways * (event.shiftKey ? coarse : fine) : stepOfKey(event, fine, coarse);
    if (step === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    this.step(step);
  }

  protected override commitTyped(): void {
    if (!this.dragging) super.commitTyped();
  }

  protected override isTyping(): boolean {
    return super.isTyping() && !this.dragging;
  }

  protected override write(value: Value | null): void {
    super.write(value);
    const slider = this.find<HTMLInputElement>('#slider');
    slider.disabled = this.locked !== '' || value === null;
    if (typeof value !== 'number') return;
    if (!this.dragging) {
      const position = String(this.quantity.clamped(this.quantity.toShown(value)));
      if (slider.value !== position) slider.value = position;
    }
    setAttribute(slider, 'aria-valuetext', `${this.quantity.entryText(value)} ${this.quantity.unit}`.trim());
  }
}
