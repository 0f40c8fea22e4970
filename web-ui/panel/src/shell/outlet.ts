// Where the current view is shown: loads it when it is first asked for, and gives it its path.
import { LitElement, css, html, nothing } from 'lit';
import { customElement, property, state } from 'lit/decorators.js';
import type { PanelCore } from '../core/panel_core';
import { loadPart } from '../core/parts';
import type { Route } from '../core/route';
import type { ViewElement, ViewInfo } from '../views/view';
import './missing';
import { shellStyles } from './styles';

@customElement('flexrf-outlet')
export class Outlet extends LitElement {
  static override styles = [
    shellStyles,
    css`
      :host {
        display: block;
        padding: 4px 16px 16px;
      }
      @media (max-width: 760px) {
        :host {
          padding: 0 8px 16px;
        }
      }
    `,
  ];

  @property({ attribute: false }) core!: PanelCore;
  @property({ attribute: false }) views: readonly ViewInfo[] = [];
  @property({ attribute: false }) route!: Route;
  /** Changes with the application's descriptor: views are made anew then. */
  @property() generation = '';
  /** Why there is nothing to show; only what could not be loaded is worth a second try. */
  @state() private failure = '';
  @state() private unloaded = '';

  #shown: ViewElement | undefined;
  #shownAs = '';

  protected override render(): unknown {
    return html`<slot></slot>${this.failure ? html`<p class="alarm" role="alert">✕ ${this.failure}</p>` : nothing}${this.unloaded
      ? html`<flexrf-missing .text=${this.unloaded} .again=${() => this.#show()}>
          <button @click=${() => location.reload()}>Load the page again</button> <small>That gives up what is typed and not yet set.</small>
        </flexrf-missing>`
      : nothing}`;
  }

  protected override updated(changed: Map<string, unknown>): void {
    if (changed.has('route') || changed.has('generation')) void this.#show();
  }

  async #show(): Promise<void> {
    const { route } = this;
    const as = `${this.generation} ${route.view}`;
    if (this.#shown && as === this.#shownAs) {
      this.#shown.path = route.path;
      return;
    }
    const info = this.views.find((view) => view.name === route.view);
    if (!info) {
      this.#clear();
      this.failure = `There is no view "${route.view}".`;
      return;
    }
    try {
      await loadPart(info.load);
    } catch (error) {
      if (this.route !== route) return;
      this.#clear();
      this.unloaded = `“${info.label || route.path.join('/')}” cannot be shown: ${(error as Error).message}`;
      return;
    }
    if (this.route !== route) return; // went on meanwhile
    this.#clear();
    const view = Object.assign(document.createElement(info.tag) as ViewElement, {
      core: this.core, host: this.core.host, path: route.path,
    });
    this.#shown = view;
    this.#shownAs = as;
    this.replaceChildren(view);
    this.dispatchEvent(new Event('shown', { bubbles: true, composed: true }));
  }

  #clear(): void {
    this.failure = this.unloaded = '';
    this.#shown = undefined;
    this.replaceChildren();
  }
}
