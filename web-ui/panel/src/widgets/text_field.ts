// A text to be typed in: Enter or leaving the field sends it, Escape gives up.
import { css, html } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { EditorBase } from './editor_base';
import { setAttribute } from './live_text';
import { widgetStyles } from './styles';

export class TextField extends EditorBase {
  static override styles = [
    widgetStyles,
    css`
      #control {
        width: 22ch;
        max-width: 100%;
      }
    `,
  ];

  protected override render(): TemplateResult {
    return this.controlFrame(
      html`<input
        id="control"
        type="text"
        autocomplete="off"
        spellcheck="false"
        aria-describedby="summary refusal lock"
        ?disabled=${this.locked !== ''}
        @input=${() => this.edit.touch()}
        @blur=${() => this.commitTyped()}
        @keydown=${(event: KeyboardEvent) => this.onKey(event)}
      />`,
      'control',
    );
  }

  private onKey(event: KeyboardEvent): void {
    if (event.key === 'Enter' && !event.isComposing) this.commitTyped();
    if (event.key === 'Escape') this.giveUp();
  }

  private commitTyped(): void {
    if (this.edit.touched && !this.question.open) this.commit(this.find<HTMLInputElement>('#control').value);
  }

  protected override write(value: Value | null): void {
    const control = this.find<HTMLInputElement>('#control');
    const text = typeof value === 'string' ? value : '';
    if ((!this.edit.touched || this.question.open) && control.value !== text) control.value = text;
    setAttribute(control, 'aria-busy', String(this.edit.pending));
  }
}
