// One of an enumeration's values.
import { html } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { EditorBase } from './editor_base';
import { setAttribute } from './live_text';
import { words } from './value_text';
import { dash } from './widget_base';

export class Select extends EditorBase {
  protected override render(): TemplateResult {
    return this.controlFrame(
      html`<select
        id="control"
        aria-describedby="summary refusal lock"
        ?disabled=${this.locked !== ''}
        @change=${(event: Event) => this.commit((event.target as HTMLSelectElement).value)}
        @keydown=${(event: KeyboardEvent) => event.key === 'Escape' && this.question.open && this.question.answer(false)}
      >
        <option value="" disabled hidden>${dash}</option>
        ${(this.item?.values ?? []).map((name) => html`<option value=${name}>${words(name)}</option>`)}
      </select>`,
      'control',
    );
  }

  protected override write(value: Value | null): void {
    const control = this.find<HTMLSelectElement>('#control');
    const name = typeof value === 'string' ? value : '';
    if (control.value !== name) control.value = name;
    setAttribute(control, 'aria-busy', String(this.edit.pending));
  }
}
