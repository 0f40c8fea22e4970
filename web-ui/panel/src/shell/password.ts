// The password of whoever is logged in, asked for anew before something that concerns the whole PC.
import { css, html, nothing } from 'lit';
import { customElement, property, state } from 'lit/decorators.js';
import { deniedLink } from '../core/access';
import type { PasswordQuestion } from '../core/core';
import './dialog';
import { ShellPart } from './part';
import { shellStyles } from './styles';

@customElement('flexrf-password')
export class PasswordDialog extends ShellPart {
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

  @property({ attribute: false }) question!: PasswordQuestion;
  @state() private refusal = '';
  @state() private busy = false;

  protected override render(): unknown {
    const { question } = this;
    const dead = deniedLink(this.core) !== '';
    const user = this.core.session?.user ?? '';
    return html`
      <flexrf-dialog heading=${question.heading} @close=${() => this.#close()}>
        <form @submit=${(event: SubmitEvent) => this.#submit(event)}>
          ${question.says.map((paragraph) => html`<p>${paragraph}</p>`)}
          <input name="user" autocomplete="username" value=${user} hidden />
          <label>Password of ${user} <input name="password" type="password" autocomplete="current-password" data-first required /></label>
          <button class="first" ?disabled=${this.busy || dead}>${this.busy ? 'Asking…' : question.action}</button>
          ${this.refusal ? html`<p class="alarm" role="alert">✕ ${this.refusal}</p>` : nothing}
          ${dead ? html`<p class="warning">⚠ No connection to the application.</p>` : nothing}
        </form>
      </flexrf-dialog>
    `;
  }

  async #submit(event: SubmitEvent): Promise<void> {
    event.preventDefault();
    const form = event.target as HTMLFormElement;
    const password = String(new FormData(form).get('password'));
    this.busy = true;
    this.refusal = '';
    this.refusal = await this.question.act(password);
    this.busy = false;
    if (this.refusal === '') this.#close();
    else form.querySelector<HTMLInputElement>('[type=password]')!.select();
  }

  #close(): void {
    this.dispatchEvent(new Event('close'));
  }
}
