// A button that acts only while it is held: active while its lease lives, and not a moment longer.
import { html } from 'lit';
import type { TemplateResult } from 'lit';
import { ControlBase } from './control_base';
import { HoldDriver, showPhase } from './hold_driver';
import { holdStyles } from './control_styles';
import { widgetStyles } from './styles';

export class HoldButton extends ControlBase {
  static override styles = [widgetStyles, holdStyles];
  private readonly driver = new HoldDriver(
    () => this.host.hold(this.item!.key),
    (_phase, reason) => {
      this.say(reason);
      this.present();
    },
  );
  private detach: (() => void) | undefined;

  protected override render(): TemplateResult {
    return this.buttonFrame(html`<button
      id="control"
      class="hold"
      type="button"
      aria-describedby="summary refusal lock"
      ?disabled=${this.locked !== ''}
    >
      ${this.label}
    </button>`);
  }

  /** A hold has no value. */
  protected override begin(): void {
    if (this.hasUpdated) this.listen();
  }
  protected override show(): void {}

  protected override firstUpdated(): void {
    super.firstUpdated();
    this.listen();
    this.present();
  }

  private listen(): void {
    this.detach?.();
    this.detach = this.driver.attach(this.find('#control'), () => this.locked === '');
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.detach?.();
    this.detach = undefined;
  }

  protected override onLocked(): void {
    this.driver.release();
  }

  protected override description(): string {
    return `${super.description()} Acts while held.`.trim();
  }

  private present(): void {
    showPhase(this.find('#control'), this.driver.phase);
  }
}
