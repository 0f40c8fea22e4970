// What every widget shares that acts: a lock with its reason, and what was refused.
import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { ItemInfo } from '../contract';
import { LiveText } from './live_text';
import { Needs } from './needs';
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
  private needs: Needs | undefined;
  private said = '';

  override connectedCallback(): void {
    super.connectedCallback();
    this.needs = new Needs(this.host, this.commands(), () => this.takeAccess());
    this.until(() => this.needs?.end());
    this.takeAccess();
  }

  /** What it can press or hold. */
  protected commands(): readonly ItemInfo[] {
    return this.item ? [this.item] : [];
  }

  /** Why this command cannot be given now; empty when it can. */
  protected lockOf(item: ItemInfo): string {
    return this.host.locked(item.key) || (this.needs?.unmet(item) ?? '');
  }

  /** The reason, where it is what the table says the command needs: that is to be read, not only to be asked for. */
  private get unmet(): string {
    return this.commands().some((item) => item.needs?.some((need) => need.reason === this.locked)) ? this.locked : '';
  }

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
    return this.item ? this.lockOf(this.item) : 'nothing to change';
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
      html`${this.unmet === '' ? nothing : html`<span class="note need">${this.unmet}</span>`}<span id="refusal" class="refusal" role="status"></span>`,
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
        ${this.unmet === '' ? nothing : html`<span class="note need">${this.unmet}</span>`}
        <span id="refusal" class="refusal" role="status"></span>
      </div>
      <span id="summary" class="hidden">${this.description()}</span><span id="lock" class="hidden">${this.locked}</span>
    </div>`;
  }
}
