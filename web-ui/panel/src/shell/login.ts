// Logging in. A session gets another role by it, so the connection is made anew.
import { css, html, nothing } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { deniedLink } from '../core/access';
import { postJson } from '../core/http';
import './dialog';
import { ShellPart } from './part';
import { shellStyles } from './styles';

@customElement('flexrf-login')
export class Login extends ShellPart {
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

  @state() private refusal = '';
  @state() private busy = false;

  protected override render(): unknown {
    const dead = deniedLink(this.core) !== '' && this.core.link.detail !== 'login';
    const { session } = this.core;
    const again = session?.lapsed ? session.user : '';
    return html`
      <flexrf-dialog heading="Log in" @close=${() => this.#close()}>
        <form @submit=${(event: SubmitEvent) => this.#submit(event)}>
          <label>User <input name="user" autocomplete="username" autocapitalize="none" value=${again} ?data-first=${!again} required /></label>
          <label>Password <input name="password" type="password" autocomplete="current-password" ?data-first=${again} required /></label>
          <button class="first" ?disabled=${this.busy || dead}>${this.busy ? 'Logging in…' : 'Log in'}</button>
          ${this.refusal ? html`<p class="alarm" role="alert">✕ ${this.refusal}</p>` : nothing}
          ${dead ? html`<p class="warning">⚠ No connection to the application.</p>` : nothing}
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
