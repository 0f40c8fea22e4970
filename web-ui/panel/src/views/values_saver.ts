// What of the values that were set is in the configuration file, and the button that saves them now. Where there is one.
import { html, nothing } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import type { SavedValues } from '../core/protocol';
import { textOf } from '../core/reasons';
import { ViewBase } from './view_base';
import { viewStyles } from './view_styles';

// A slow disk has its time; the server answers within 10 s.
const patience = 15_000;

export interface Standing {
  readonly text: string;
  readonly kind: '' | 'warning' | 'alarm';
}

export function standingOf(values: SavedValues): Standing {
  if (values.failure) return { text: `✕ Not saved: ${values.failure}`, kind: 'alarm' };
  if (values.unsaved && values.on === 'command') return { text: '⚠ Not saved: changes are lost at the end.', kind: 'warning' };
  if (values.unsaved) return { text: 'Not saved yet: that follows by itself.', kind: '' };
  if (values.saved_at_ms === null) return { text: 'Nothing was changed since the start.', kind: '' };
  const written = values.writings === 1 ? 'once' : `${values.writings} times`;
  return { text: `Saved at ${new Date(values.saved_at_ms).toLocaleTimeString()}. The file was written ${written} since the start.`, kind: '' };
}

@customElement('flexrf-values-saver')
export class ValuesSaver extends ViewBase {
  static override styles = viewStyles;

  @state() private busy = false;

  override connectedCallback(): void {
    super.connectedCallback();
    this.watchAge();
    this.until(this.core.watchState(() => this.requestUpdate()));
  }

  protected override render(): unknown {
    const values = this.core.state?.values;
    if (!values) return nothing;
    const standing = standingOf(values);
    const locked = this.core.deniedAction('operator');
    const dead = locked !== '' || this.busy;
    return html`
      <p class=${`${standing.kind} ${this.age}`} role=${standing.kind === 'alarm' ? 'alert' : nothing}>${standing.text}</p>
      <div class="buttons">
        <div>
          <button aria-disabled=${dead ? 'true' : nothing} aria-busy=${this.busy ? 'true' : nothing} aria-describedby="why"
            @click=${() => !dead && this.save()}>Save now</button>
          <small id="why">${locked}</small>
        </div>
      </div>
    `;
  }

  private async save(): Promise<void> {
    this.busy = true;
    const answer = await this.core.request('save_values', {}, patience);
    this.busy = false;
    if (answer.ok) this.core.notify('The values are saved.');
    else this.core.notify(textOf(answer.problem), 'alarm');
  }
}
