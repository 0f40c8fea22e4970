// What every widget shares that changes a parameter: the value in force, the mark of a modified one, the reset.
import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { ControlBase } from './control_base';
import { Edit } from './edit';
import { differsFromDefault } from './modified';
import { anyText, scalarText } from './value_text';

export abstract class EditorBase extends ControlBase {
  protected readonly edit = new Edit(
    (value, options) => this.host.set(this.item!.key, value, options),
    () => this.item?.path,
    () => this.presentEdit(),
  );
  private modified = false;

  /** Writes into the controls what the person, or else the unit, wants. */
  protected abstract write(value: Value | null): void;

  protected override show(value: Value | null): void {
    const before = this.isRounded;
    this.edit.echo(value);
    if (this.isRounded !== before) this.takeAccess();
  }

  private get isRounded(): boolean {
    return this.quantity.isRounded(this.edit.inForce);
  }

  protected override lockReason(): string {
    return super.lockReason() || (this.isRounded ? 'this value has more digits than the page keeps: set it in the configuration file' : '');
  }

  protected override redraw(): void {
    this.presentEdit();
  }

  protected override updated(): void {
    super.updated();
    this.presentEdit();
  }

  protected override dismiss(): void {
    this.edit.refusal = '';
    super.dismiss();
  }

  protected override onLocked(): void {
    this.edit.cancel();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.edit.cancel();
  }

  /** To the unit, after a question where the table wants one. */
  protected commit(value: Value, edit = this.edit): void {
    if (this.locked !== '') return;
    if (this.question.wanted) edit.propose(value);
    this.question.ask(
      () => {
        edit.letGo();
        edit.put(value);
      },
      () => edit.cancel(),
    );
  }

  /** Escape: no to the question, or else back to the value in force. */
  protected giveUp(): void {
    if (this.question.open) this.question.answer(false);
    else this.edit.cancel();
  }

  private presentEdit(): void {
    if (!this.hasUpdated) return;
    this.write(this.edit.shown);
    if (this.locked === '' || this.edit.refusal !== '') this.say(this.edit.refusal);
    this.toggleAttribute('pending', this.edit.pending);
    const modified = this.item !== undefined && differsFromDefault(this.item, this.edit.inForce);
    if (modified !== this.modified) {
      this.modified = modified;
      this.toggleAttribute('modified', modified);
      this.requestUpdate();
    }
  }

  private get defaultText(): string {
    const value = this.item?.default;
    if (value === undefined || !this.item) return '';
    const text = Array.isArray(value) ? anyText(value) : scalarText(this.item, this.quantity, value);
    return this.quantity.unit === '' || typeof value !== 'number' ? text : `${text} ${this.quantity.unit}`;
  }

  protected override extraLabel(): TemplateResult | typeof nothing {
    if (!this.modified) return nothing;
    return html` <span class="modified" title=${`Modified; the default is ${this.defaultText}`}
      ><span aria-hidden="true">●</span><span class="hidden">modified</span></span
    >`;
  }

  /** The reset button, beside the mark of a modified value. */
  protected override headControls(): TemplateResult | typeof nothing {
    const item = this.item;
    if (!item || !this.modified) return nothing;
    return html` <button
      type="button"
      id="reset"
      ?disabled=${this.locked !== ''}
      title=${`Back to the default, ${this.defaultText}`}
      aria-label=${`Reset ${this.label} to its default, ${this.defaultText}`}
      @click=${() => this.edit.perform(() => this.host.reset(item.key))}
    >
      ↺
    </button>`;
  }
}
