// What every widget shares that acts: a lock with its reason, and what was refused.
import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import { LiveText } from './live_text';
import { Question } from './question';
import { WidgetBase } from './widget_base';

export abstract class ControlBase extends WidgetBase {
  /** Why nothing can be changed now; empty when it can. */
  protected locked = '';
  protected readonly question = new Question(
    () => this.options['confirm'] ?? this.item?.confirm,
    () => this.requestUpdate(),
  );
  private refusal: LiveText | undefined;
  private said = '';

  protected override takeAccess(): void {
    super.takeAccess();
    const locked = this.lockReason();
    if (locked === this.locked) return;
    this.locked = locked;
    if (locked !== '') {
      if (this.question.open) this.question.answer(false);
      this.onLocked();
    } else {
      this.say('');
    }
    this.requestUpdate();
  }

  protected lockReason(): string {
    if (this.host.stale) return 'no word from the application: values are old';
    return this.item ? this.host.locked(this.item.key) : 'nothing to change';
  }

  /** Whatever a person has begun is void. */
  protected onLocked(): void {}

  /** Beside the control, and spoken; empty: nothing. */
  protected say(text: string): void {
    this.said = text;
    if (this.refusal) this.refusal.text = text;
  }

  protected override firstUpdated(): void {
    this.refusal = new LiveText(this.find('#refusal'), this.said);
    super.firstUpdated();
  }

  /** As frame(), with what a control needs. A touch on a dead control tells why it is dead. */
  protected controlFrame(content: TemplateResult, control = ''): TemplateResult {
    return this.frame(
      html`<span
          class="controls"
          title=${this.locked === '' ? nothing : this.locked}
          @click=${() => this.locked !== '' && this.say(`Locked: ${this.locked}`)}
          >${content}</span
        >${this.question.render(this.label)}<span id="lock" class="hidden">${this.locked}</span>`,
      control,
      html`<span id="refusal" class="refusal" role="status"></span>`,
    );
  }

  /** For buttons, which bear the label themselves. */
  protected buttonFrame(content: TemplateResult): TemplateResult {
    return html`<div class="row">
      <span
        class="controls"
        title=${this.locked === '' ? (this.item?.summary ?? nothing) : this.locked}
        @click=${() => this.locked !== '' && this.say(`Locked: ${this.locked}`)}
        >${content}</span
      >${this.question.render(this.label)}
      <div class="notes">
        ${this.note === '' ? nothing : html`<span class="note">${this.note}</span>`}
        <span id="refusal" class="refusal" role="status"></span>
      </div>
      <span id="summary" class="hidden">${this.description()}</span><span id="lock" class="hidden">${this.locked}</span>
    </div>`;
  }
}
