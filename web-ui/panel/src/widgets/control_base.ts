// What every widget shares that acts: a lock with its reason, and what was refused. What is said and asked lies over the page.
import { html, nothing } from 'lit';
import type { CSSResultGroup, CSSResultOrNative, TemplateResult } from 'lit';
import type { ItemInfo } from '../contract';
import { controlStyles } from './control_styles';
import { LiveText } from './live_text';
import { Needs } from './needs';
import { placeOver } from './place_over';
import { Question } from './question';
import { WidgetBase } from './widget_base';

/** How long a dead control says why it is dead when it is touched, ms. */
const passing = 6000;

export abstract class ControlBase extends WidgetBase {
  /** Each control's own go on from those of all controls. */
  protected static override finalizeStyles(styles: CSSResultGroup = []): CSSResultOrNative[] {
    return super.finalizeStyles([controlStyles, styles]);
  }

  /** Why nothing can be changed now; empty when it can. */
  protected locked = '';
  protected readonly question = new Question(
    () => this.options['confirm'] ?? this.item?.confirm,
    () => this.requestUpdate(),
  );
  private refusal: LiveText | undefined;
  private needs: Needs | undefined;
  private said = '';
  private passing: ReturnType<typeof setTimeout> | undefined;

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

  /** That its table says when it acts, beside the motion that each hold needs. */
  private get hasNeeds(): boolean {
    return this.commands().some((item) => item.needs?.some((need) => need.key !== undefined || item.scalar !== 'hold'));
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

  /** At the control, and spoken; empty: nothing. */
  protected say(text: string): void {
    clearTimeout(this.passing);
    if (text === this.said) return;
    this.said = text;
    this.showSaid();
  }

  /** The person has read it. */
  protected dismiss(): void {
    this.say('');
  }

  private sayLocked(): void {
    if (this.locked === '') return;
    this.say(`Locked: ${this.locked}`);
    this.passing = setTimeout(() => this.say(''), passing);
  }

  private showSaid(): void {
    if (!this.refusal) return;
    this.refusal.text = this.said;
    this.toggleAttribute('said', this.said !== '' || this.question.open);
    if (this.said !== '') placeOver(this.find('#refusal'));
  }

  protected override firstUpdated(): void {
    this.refusal = new LiveText(this.find('#refusal'));
    this.showSaid();
    super.firstUpdated();
  }

  protected override updated(): void {
    this.toggleAttribute('said', this.said !== '' || this.question.open);
    this.question.place(this.renderRoot);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.passing);
  }

  protected override over(): TemplateResult {
    return html`${this.question.render(this.label)}<span
        id="refusal"
        class="refusal over"
        role="status"
        @click=${() => this.dismiss()}
      ></span>`;
  }

  /** As frame(), with what a control needs. A touch on a dead control tells why it is dead. */
  protected controlFrame(content: TemplateResult, control = '', notes: TemplateResult | typeof nothing = nothing): TemplateResult {
    return this.frame(
      html`<span
          class="controls"
          title=${this.locked === '' ? nothing : this.locked}
          @click=${() => this.sayLocked()}
          >${content}</span
        ><span id="lock" class="hidden">${this.locked}</span>`,
      control,
      html`${this.unmet === '' ? nothing : html`<span class="note need">${this.unmet}</span>`}${notes}`,
    );
  }

  /**
   * For buttons, which bear the label themselves. Why one is dead stands beside it where there is room; where its table says what it
   * needs it has a line of its own, which is there also while it acts, so that nothing moves.
   */
  protected buttonFrame(content: TemplateResult): TemplateResult {
    return html`<div class="row">
      <span
        class="controls"
        title=${this.locked === '' ? (this.item?.summary ?? nothing) : this.locked}
        @click=${() => this.sayLocked()}
        >${content}</span
      >${this.hasNeeds
        ? html`<span class="why need" aria-hidden="true">${this.locked}</span>`
        : html`<span class="why" aria-hidden="true">${this.locked}</span>`}${this.over()}
      <div class="notes">${this.note === '' ? nothing : html`<span class="note">${this.note}</span>`}</div>
      <span id="summary" class="hidden">${this.description()}</span><span id="lock" class="hidden">${this.locked}</span>
    </div>`;
  }
}
