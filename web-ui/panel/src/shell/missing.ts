// Stands where a part of the page belongs that could not be had: says why, and offers a second try.
import { css, html } from 'lit';
import { customElement, property, state } from 'lit/decorators.js';
import { added } from '../core/watchers';
import { EndingElement } from '../widgets/ending_element';
import { shellStyles } from './styles';

/** Those that are seen now: what kept one away mostly keeps away all of them, so all are tried again at once. */
const shown = new Set<Missing>();

@customElement('flexrf-missing')
export class Missing extends EndingElement {
  static override styles = [
    shellStyles,
    css`
      p {
        margin: 0.3em 0;
        overflow-wrap: anywhere;
      }
    `,
  ];

  @property() text = '';
  /** Puts the part where this element stands, or gives it another text. Never rejects. */
  @property({ attribute: false }) again!: () => Promise<unknown>;
  @state() private busy = false;

  override connectedCallback(): void {
    super.connectedCallback();
    this.until(added(shown, this));
  }

  protected override render(): unknown {
    return html`<p class="alarm" role="alert">✕ ${this.text}.</p>
      <button ?disabled=${this.busy} @click=${() => [...shown].forEach((one) => void one.#try())}>${this.busy ? 'Trying…' : 'Try again'}</button>
      <slot></slot>`;
  }

  async #try(): Promise<void> {
    if (this.busy) return;
    this.busy = true;
    await this.again();
    this.busy = false;
  }
}

/** One that stands alone. */
export function makeMissing(text: string, again: Missing['again']): Missing {
  return Object.assign(new Missing(), { text, again });
}
