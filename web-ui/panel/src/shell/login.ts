// Logging in. A session gets another role by it, so the connection is made anew.
import { LitElement, css, html, nothing } from 'lit';
import { customElement, property, state } from 'lit/decorators.js';
import { postJson } from '../core/http';
import type { PanelCore } from '../core/panel_core';
import { shellStyles } from './styles';
import './dialog';

@customElement('flexrf-login')
export class Login extends LitElement {
  static override styles = [
    shellStyles,
    css`
      form {
        display: grid;
        gap: 10px;
      }
      label {
        display: grid;
        gap: 2px;
      }
      p {
        margin: 0;
      }
    `,
  ];

  @property({ attribute: false }) core!: PanelCore;
  @state() private refusal = '';
  @state() private busy = false;

  protected override render(): unknown {
    return html`
      <flexrf-dialog heading="Log in" @close=${() => this.#close()}>
        <form @submit=${(event: SubmitEvent) => this.#submit(event)}>
          <label>User <input name="user" autocomplete="username" autocapitalize="none" data-first required /></label>
          <label>Password <input name="password" type="password" autocomplete="current-password" required /></label>
          ${this.refusal ? html`<p class="alarm" role="alert">✕ ${this.refusal}</p>` : nothing}
          <button class="first" ?disabled=${this.busy}>${this.busy ? 'Logging in…' : 'Log in'}</button>
        </form>
      </flexrf-dialog>
    `;
  }

  async #submit(event: SubmitEvent): Promise<void> {
    event.preventDefault();
    const data = new FormData(event.target as HTMLFormElement);
    this.busy = true;
    this.refusal = '';
    const answer = await postJson('/api/v1/login', { user: data.get('user'), password: data.get('password') });
    this.busy = false;
    if (!answer.ok) {
      this.refusal = answer.detail;
      return;
    }
    this.core.connection.restart();
    this.#close();
  }

  #close(): void {
    this.dispatchEvent(new Event('close'));
  }
}
