// A button: each press reaches the unit once.
import { css, html } from 'lit';
import type { TemplateResult } from 'lit';
import { textOfError } from '../core/reasons';
import { ControlBase } from './control_base';
import { widgetStyles } from './styles';

export class Button extends ControlBase {
  static override styles = [
    widgetStyles,
    css`
      #control {
        min-width: 6em;
      }
    `,
  ];
  private pending = false;

  protected override render(): TemplateResult {
    return this.buttonFrame(html`<button
      id="control"
      type="button"
      aria-describedby="summary refusal lock"
      aria-busy=${this.pending ? 'true' : 'false'}
      ?disabled=${this.locked !== ''}
      @click=${() => this.press()}
      @keydown=${(event: KeyboardEvent) => event.repeat && event.preventDefault()}
    >
      ${this.label}
    </button>`);
  }

  /** A button has no value. */
  protected override begin(): void {}
  protected override show(): void {}

  private press(): void {
    if (this.locked !== '' || this.pending || this.question.open) return;
    this.question.ask(() => void this.send());
  }

  private async send(): Promise<void> {
    this.pending = true;
    this.say('');
    this.requestUpdate();
    try {
      const outcome = await this.host.press(this.item!.key);
      this.say(outcome.ok ? '' : outcome.detail);
    } catch (failure) {
      this.say(textOfError(failure));
    }
    this.pending = false;
    this.requestUpdate();
  }
}
