// A state that is on or off. The lamp's shape and a word tell it; a colour is only for the state that the table's
// option `abnormal` names.
import { css, html } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { LiveText, setAttribute } from './live_text';
import { widgetStyles } from './styles';
import { WidgetBase, dash } from './widget_base';

export class Lamp extends WidgetBase {
  static override styles = [
    widgetStyles,
    css`
      .lamp {
        width: 0.9em;
        height: 0.9em;
        border: 2px solid var(--fill);
        border-radius: 50%;
        box-sizing: border-box;
      }
      [data-state='on'] .lamp {
        background: var(--fill);
      }
      [data-state='none'] .lamp {
        border-style: dotted;
      }
      [data-abnormal='true'] {
        color: var(--alarm);
        font-weight: 600;
      }
      [data-abnormal='true'] .lamp {
        border-color: var(--alarm);
        border-radius: 0;
        transform: rotate(45deg);
      }
      [data-abnormal='true'][data-state='on'] .lamp {
        background: var(--alarm);
      }
      .state {
        display: inline-flex;
        align-items: center;
        gap: var(--gap);
      }
    `,
  ];
  private text: LiveText | undefined;

  protected override render(): TemplateResult {
    return this.frame(html`<span class="state"><i class="lamp" aria-hidden="true"></i><span class="value"></span></span>`);
  }

  protected override firstUpdated(): void {
    this.text = new LiveText(this.find('.value'));
    super.firstUpdated();
  }

  protected override show(value: Value | null): void {
    if (!this.text) return;
    const state = typeof value === 'boolean' ? (value ? 'on' : 'off') : 'none';
    const abnormal = typeof value === 'boolean' && this.options['abnormal'] === value;
    const word = state === 'none' ? dash : String(this.options[state] ?? state);
    const shown = this.find('.state');
    setAttribute(shown, 'data-state', state);
    setAttribute(shown, 'data-abnormal', String(abnormal));
    this.text.text = abnormal ? `⚠ ${word}` : word;
  }
}
