// A dialog that covers the views but never the header and Stop motion: it fills its place in the page, not the browser's top
// layer (which would cover everything). While it is open the shell makes the views inert.
import { LitElement, css, html } from 'lit';
import { customElement, property } from 'lit/decorators.js';
import { shellStyles } from './styles';

/** Says `close` (an Event) when the person wants to be rid of it by its button; Escape is the shell's. */
@customElement('flexrf-dialog')
export class Dialog extends LitElement {
  static override styles = [
    shellStyles,
    css`
      :host {
        position: absolute;
        inset: 0;
        display: grid;
        /* From the top: what is said below its buttons moves none of them. */
        place-items: start center;
        padding: clamp(8px, 8dvh, 5rem) 8px 8px;
        overflow: auto;
        background: color-mix(in srgb, var(--flexrf-page) 80%, transparent);
      }
      section {
        background: var(--flexrf-surface);
        border: 2px solid var(--flexrf-border);
        border-radius: var(--flexrf-radius);
        padding: 1em;
        width: min(30rem, 100%);
        box-sizing: border-box;
      }
      .head {
        display: flex;
        justify-content: space-between;
        align-items: start;
        gap: 1em;
      }
      h2 {
        margin: 0.2em 0 0.6em;
        font-size: 1.2em;
      }
    `,
  ];

  @property() heading = '';
  #before: Element | null = null;

  override connectedCallback(): void {
    super.connectedCallback();
    this.#before = deepActive();
  }
  override disconnectedCallback(): void {
    super.disconnectedCallback();
    if (this.#before instanceof HTMLElement && this.#before.isConnected) this.#before.focus();
  }

  protected override firstUpdated(): void {
    const wanted = this.querySelector<HTMLElement>('[data-first]') ?? this.renderRoot.querySelector('section');
    wanted?.focus();
  }

  protected override render(): unknown {
    return html`
      <section role="dialog" aria-labelledby="heading" tabindex="-1">
        <div class="head">
          <h2 id="heading">${this.heading}</h2>
          <button aria-label="Close" @click=${() => this.#close()}>✕</button>
        </div>
        <slot></slot>
      </section>
    `;
  }

  #close(): void {
    this.dispatchEvent(new Event('close'));
  }
}

function deepActive(): Element | null {
  let active = document.activeElement;
  while (active?.shadowRoot?.activeElement) active = active.shadowRoot.activeElement;
  return active;
}
