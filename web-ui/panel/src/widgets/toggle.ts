// On or off, as a switch.
import { css, html } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { EditorBase } from './editor_base';
import { LiveText, setAttribute } from './live_text';
import { widgetStyles } from './styles';
import { dash } from './widget_base';

export class Toggle extends EditorBase {
  static override styles = [
    widgetStyles,
    css`
      #control {
        appearance: none;
        position: relative;
        width: calc(1.8 * var(--target));
        border-radius: var(--target);
        cursor: pointer;
      }
      #control::before {
        content: '';
        position: absolute;
        inset: 3px auto 3px 3px;
        aspect-ratio: 1;
        border-radius: 50%;
        background: var(--fill);
      }
      #control:checked::before {
        inset: 3px 3px 3px auto;
        background: var(--text);
      }
      #control:indeterminate::before {
        inset: 3px calc(50% - var(--target) / 2 + 3px);
        background: transparent;
        border: 2px dotted var(--fill);
      }
      .state {
        min-width: 2.5em;
      }
    `,
  ];
  private text: LiveText | undefined;

  protected override render(): TemplateResult {
    return this.controlFrame(
      html`<span class="state" aria-hidden="true"></span>
        <input
          id="control"
          type="checkbox"
          role="switch"
          aria-describedby="summary refusal lock"
          ?disabled=${this.locked !== ''}
          @change=${(event: Event) => this.commit((event.target as HTMLInputElement).checked)}
        />`,
      'control',
    );
  }

  protected override firstUpdated(): void {
    this.text = new LiveText(this.find('.state'));
    super.firstUpdated();
  }

  protected override write(value: Value | null): void {
    const control = this.find<HTMLInputElement>('#control');
    control.checked = value === true;
    control.indeterminate = value === null;
    setAttribute(control, 'aria-busy', String(this.edit.pending));
    const state = value === true ? 'on' : 'off';
    if (this.text) this.text.text = value === null ? dash : String(this.options[state] ?? state);
  }
}
