// Takes back what this page changed last.
import { html, nothing } from 'lit';
import { customElement } from 'lit/decorators.js';
import type { Value } from '../contract';
import type { Change } from '../core/history';
import { compactText } from './compact_value';
import { ViewBase } from './view_base';
import { viewStyles } from './view_styles';

@customElement('flexrf-undo')
export class Undo extends ViewBase {
  static override styles = viewStyles;
  private busy = false;

  override connectedCallback(): void {
    super.connectedCallback();
    this.until(this.core.host.history.watch(() => this.requestUpdate()));
    this.until(this.core.host.watchAccess(() => this.requestUpdate()));
  }

  protected override render(): unknown {
    const { last } = this.core.host.history;
    const what = last ? this.text(last) : '';
    const denied = last ? this.denied(last) : 'nothing to take back';
    return html`<button
      ?disabled=${denied !== '' || this.busy}
      title=${denied || what}
      aria-label=${last ? `Undo: ${what}` : nothing}
      @click=${() => this.undo()}
    >↶ Undo</button>`;
  }

  private denied(change: Change): string {
    for (const path of Object.keys(change.before)) {
      const denied = this.core.host.locked(`${change.component}.${path}`);
      if (denied !== '') return denied;
    }
    return '';
  }

  /** "Step of jog from 20.0 mm back to 10.0 mm". */
  private text(change: Change): string {
    const paths = Object.keys(change.before);
    const path = paths[0] ?? '';
    if (paths.length !== 1) return `${paths.length} parameters of ${change.component}`;
    const item = this.core.host.item(`${change.component}.${path}`);
    const shown = (value: Value | undefined): string => (item && value !== undefined ? compactText(item, value, this.core.units) : '');
    return `${item?.label ?? path} of ${change.component} from ${shown(change.after[path])} back to ${shown(change.before[path])}`;
  }

  private async undo(): Promise<void> {
    this.busy = true;
    this.requestUpdate();
    const outcome = await this.core.host.undo();
    this.busy = false;
    this.requestUpdate();
    if (!outcome.ok) this.core.notify(outcome.detail, 'warning');
  }
}
