// A vector or matrix of numbers to be typed in: a field for each element, sent by itself.
import { css, html } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { arrayStyles, elementAt, elementName, gridOf } from './array_readout';
import { Edit } from './edit';
import { EditorBase } from './editor_base';
import { Keypad, keypadStyles } from './keypad';
import { setAttribute } from './live_text';
import { stepOfKey } from './number_field';
import { widgetStyles } from './styles';
import { dash } from './widget_base';

export class ArrayField extends EditorBase {
  static override styles = [
    widgetStyles,
    arrayStyles,
    keypadStyles,
    css`
      .cell input,
      td input {
        width: 9ch;
        text-align: right;
      }
    `,
  ];
  private cells: Edit[] = [];
  private whole: Value | null = null;
  private readonly keypad = new Keypad(() => this.requestUpdate());

  protected override prepare(): void {
    super.prepare();
    if (this.cells.length > 0 || !this.item) return;
    const { rows, columns } = gridOf(this.item);
    this.cells = Array.from({ length: rows * columns }, (_, i) => {
      const index = this.indexOf(i);
      return new Edit(
        (value, options) => this.host.set(`${this.item!.key}${index}`, value, options),
        () => (this.item?.path === undefined ? undefined : `${this.item.path}${index}`),
        () => this.presentCell(i),
      );
    });
  }

  /** "[2]", "[1][0]" */
  private indexOf(cell: number): string {
    const { columns } = gridOf(this.item!);
    return this.item!.shape.length === 2 ? `[${Math.floor(cell / columns)}][${cell % columns}]` : `[${cell}]`;
  }

  /** For people: "x", "2", "[1][0]". */
  private nameOf(cell: number): string {
    return this.item!.shape.length === 1 ? elementName(this.item!, cell) : this.indexOf(cell);
  }

  protected override render(): TemplateResult {
    const item = this.item!;
    const { rows, columns } = gridOf(item);
    const fields = this.cells.map((_, i) => this.field(i));
    if (item.shape.length === 1) {
      return this.controlFrame(html`<span class="cells">
          ${fields.map(
            (field, i) => html`<span class="cell"><span class="index" aria-hidden="true">${elementName(item, i)}</span>${field}</span>`,
          )}${this.unitMark()} </span
        >${this.keypad.render()}`);
    }
    return this.controlFrame(html`<div class="scroll">
        <table role="presentation">
          ${Array.from(
            { length: rows },
            (_, row) => html`<tr>
              ${fields.slice(row * columns, (row + 1) * columns).map((field) => html`<td>${field}</td>`)}
            </tr>`,
          )}
        </table></div
      >${this.unitMark()}${this.keypad.render()}`);
  }

  private field(i: number): TemplateResult {
    const edit = this.cells[i]!;
    return html`<input
      data-cell=${i}
      type="text"
      inputmode=${this.keypad.inputMode('text')}
      autocomplete="off"
      spellcheck="false"
      aria-label=${`${this.label} ${this.nameOf(i)}`}
      aria-describedby="refusal lock"
      ?disabled=${this.locked !== ''}
      @input=${() => edit.touch()}
      @focus=${(event: Event) => this.keypad.focus(event.target as HTMLInputElement)}
      @blur=${() => this.leave(i)}
      @keydown=${(event: KeyboardEvent) => this.onKey(event, i)}
    />`;
  }

  private input(i: number): HTMLInputElement {
    return this.find<HTMLInputElement>(`[data-cell="${i}"]`);
  }

  private onKey(event: KeyboardEvent, i: number): void {
    const edit = this.cells[i]!;
    if (event.key === 'Enter') return this.commitCell(i);
    if (event.key === 'Escape') return edit.cancel();
    const from = edit.shown;
    const { fine, coarse } = this.quantity.steps(typeof from === 'number' ? from : 0);
    const step = stepOfKey(event, fine, coarse);
    if (step === undefined) return;
    event.preventDefault();
    if (typeof from === 'number' && !edit.touched) edit.put(this.quantity.stepped(from, step));
  }

  private leave(i: number): void {
    this.commitCell(i);
    this.keypad.blur();
  }

  private commitCell(i: number): void {
    const edit = this.cells[i]!;
    if (!edit.touched || this.locked !== '' || this.question.open) return;
    const parsed = this.quantity.parse(this.input(i).value);
    if (!('value' in parsed)) return edit.refuse(parsed.problem);
    this.commit(parsed.value, edit);
  }

  protected override dismiss(): void {
    this.cells.forEach((cell) => (cell.refusal = ''));
    super.dismiss();
  }

  protected override updated(): void {
    super.updated();
    this.keypad.reveal(this.renderRoot);
  }

  protected override onLocked(): void {
    super.onLocked();
    this.cells.forEach((cell) => cell.cancel());
    this.keypad.blur();
  }

  /** The whole: from a reading, or after a reset. */
  protected override write(value: Value | null): void {
    const { columns } = gridOf(this.item!);
    const matrix = this.item!.shape.length === 2;
    if (Array.isArray(value)) this.quantity.seeAll(value);
    // Once each: an element's own answer is newer than the whole before it.
    const isNew = value !== this.whole;
    this.whole = value;
    this.cells.forEach((cell, i) => {
      if (isNew) cell.echo(elementAt(value, Math.floor(i / columns), i % columns, matrix) ?? null);
      this.presentCell(i);
    });
  }

  private presentCell(i: number): void {
    if (!this.hasUpdated) return;
    const edit = this.cells[i]!;
    const input = this.input(i);
    const shown = edit.shown;
    const text = typeof shown === 'number' ? this.quantity.plain(shown) : '';
    if (!edit.touched && input.value !== text) input.value = text;
    input.placeholder = shown === null ? dash : '';
    setAttribute(input, 'aria-busy', String(edit.pending));
    const refused = this.cells.findIndex((cell) => cell.refusal !== '');
    if (refused >= 0) this.say(`${this.nameOf(refused)}: ${this.cells[refused]!.refusal}`);
    else if (this.locked === '') this.say(this.edit.refusal);
  }
}
