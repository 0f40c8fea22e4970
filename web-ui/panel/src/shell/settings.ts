// What a person may choose for this computer: theme, size of controls, units.
import { LitElement, css, html } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import { displayUnits } from '../core/units';
import type { Preferences, Theme, Touch } from './preferences';
import { shellStyles } from './styles';
import './dialog';

@customElement('flexrf-settings')
export class Settings extends LitElement {
  static override styles = [
    shellStyles,
    css`
      div {
        display: grid;
        gap: 10px;
      }
      label {
        display: grid;
        gap: 2px;
      }
    `,
  ];

  @property({ attribute: false }) preferences!: Preferences;

  protected override render(): unknown {
    const choose = (label: string, value: string, options: readonly (readonly [string, string])[], set: (value: string) => void) => html`
      <label>${label}
        <select @change=${(event: Event) => set((event.target as HTMLSelectElement).value)}>
          ${options.map(([name, text]) => html`<option value=${name} ?selected=${name === value}>${text}</option>`)}
        </select>
      </label>`;
    return html`
      <flexrf-dialog heading="Settings of this computer" @close=${() => this.dispatchEvent(new Event('close'))}>
        <div>
          ${choose('Theme', this.preferences.theme, [['system', 'As the system'], ['light', 'Light'], ['dark', 'Dark']],
            (value) => { this.preferences.theme = value as Theme; })}
          ${choose('Controls', this.preferences.touch, [['system', 'Large on a touch screen'], ['large', 'Always large']],
            (value) => { this.preferences.touch = value as Touch; })}
          ${choose('Units', displayUnits.si ? 'si' : 'workshop', [['workshop', 'mm, degrees'], ['si', 'm, radians (SI)']],
            (value) => { displayUnits.si = value === 'si'; })}
        </div>
      </flexrf-dialog>
    `;
  }
}
