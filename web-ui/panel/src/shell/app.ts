// The page: header, Stop motion, banner, navigation, the current view, and dialogs above it. Each has a cell of its own in
// one grid, so that nothing ever lies over Stop motion.
import { css, html, nothing } from 'lit';
import { customElement, query, state } from 'lit/decorators.js';
import { deniedLink, hasControl, includes } from '../core/access';
import type { PasswordQuestion } from '../core/core';
import { listen } from '../core/listen';
import { PanelCore } from '../core/panel_core';
import { loadPart } from '../core/parts';
import { addressOfRoute, parseRoute, type Route } from '../core/route';
import { titleOf } from '../core/words';
import { views } from '../views';
import { EndingElement } from '../widgets/ending_element';
import './control';
import './header';
import { makeMissing } from './missing';
import './notices';
import type { Notices } from './notices';
import './outlet';
import { Preferences } from './preferences';
import './stop_motion';
import { shellStyles } from './styles';

type DialogName = 'login' | 'settings' | 'password';

/** Loaded when they are opened first: few pages ever open one. */
const dialogs: { readonly [name in DialogName]: () => Promise<unknown> } = {
  login: () => import('./login'),
  settings: () => import('./settings'),
  password: () => import('./password'),
};

type PartBelow = 'consent' | 'machine';

/** What stands below the views, loaded once it is needed: what cannot be shown without it, and how it is had. */
const partsBelow: { readonly [name in PartBelow]: readonly [string, () => Promise<unknown>] } = {
  consent: ['Who asks for control', () => import('./consent')],
  machine: ['How the PC is', () => import('./machine_lines')],
};

@customElement('flexrf-panel')
export class Panel extends EndingElement {
  static override styles = [
    shellStyles,
    css`
      :host {
        display: grid;
        height: 100dvh;
        /* Warnings come below the views: what a finger is on must not move when one comes or goes. */
        grid-template: 'header stop' auto 'nav nav' auto 'main main' minmax(0, 1fr) 'banner banner' auto / minmax(0, 1fr) auto;
        background: var(--flexrf-page);
      }
      flexrf-header {
        grid-area: header;
      }
      flexrf-stop-motion {
        grid-area: stop;
        background: var(--flexrf-surface);
      }
      .banner {
        grid-area: banner;
      }
      .banner p {
        margin: 0;
        padding: 8px 12px;
        color: var(--flexrf-stop-text);
        background: var(--flexrf-stop);
        font-weight: 600;
      }
      nav {
        grid-area: nav;
        display: flex;
        overflow-x: auto;
        border-block: 1px solid var(--flexrf-border);
        background: var(--flexrf-surface);
      }
      nav a {
        flex: none;
        display: flex;
        align-items: center;
        min-height: max(var(--target), 40px);
        padding: 0 14px;
        color: var(--flexrf-text);
        text-decoration: none;
        border-block-end: 4px solid transparent;
        box-sizing: border-box;
      }
      nav a:focus-visible {
        outline-offset: -4px;
      }
      nav a[aria-current] {
        font-weight: 700;
        border-block-end-color: var(--flexrf-fill);
        background: var(--flexrf-page);
      }
      .main {
        grid-area: main;
        position: relative;
        min-height: 0;
        display: grid;
      }
      main {
        overflow: auto;
        min-height: 0;
      }
      main:focus-visible {
        outline-offset: -3px;
      }
      @media (max-width: 760px) {
        :host {
          grid-template: 'header' auto 'nav' auto 'main' minmax(0, 1fr) 'banner' auto 'stop' auto / minmax(0, 1fr);
        }
      }
    `,
  ];

  @state() private route: Route = this.#fromAddress();
  @state() private dialog: DialogName | 'none' = 'none';
  @state() private generation = '';
  @state() private ended = '';
  /** What can be shown below the views. */
  @state() private below: ReadonlySet<PartBelow> = new Set();
  /** What the dialog that asks for the password is about. */
  @state() private question: PasswordQuestion | undefined;
  @query('flexrf-notices') private notices!: Notices;
  #preferences = new Preferences(document.documentElement, localStorage, matchMedia('(prefers-color-scheme: dark)'));
  #asked = false;
  #loading = new Set<PartBelow>();

  readonly core = new PanelCore({
    onModel: (model) => {
      this.generation = model.hash;
    },
    onNotice: (text, severity) => this.notices?.add(text, severity),
    onPasswordWanted: (question) => {
      this.question = question;
      void this.#open('password');
    },
    onEnded: (text) => { this.ended = text; },
    loadBuiltIn: () => import('../widgets'),
    makeMissing,
  });

  override connectedCallback(): void {
    super.connectedCallback();
    this.until(listen(window, 'hashchange', () => {
      this.core.endHolds('another view was opened');
      this.#turnPage();
      this.route = this.#fromAddress();
    }));
    // Also while the focus is on what no dialog covers: Stop motion, the header.
    this.until(listen(window, 'keydown', (event: KeyboardEvent) => {
      if (event.key === 'Escape' && this.dialog !== 'none') this.#close();
    }));
    this.until(this.core.watchState(() => this.#onState()));
    this.core.start();
    this.until(() => this.core.connection.stop());
  }

  /** On a narrow screen the entry of the view that is shown may lie beside what is seen of the navigation. */
  protected override updated(changed: Map<PropertyKey, unknown>): void {
    if (!changed.has('route') && !changed.has('generation')) return;
    this.renderRoot.querySelector('nav a[aria-current]')?.scrollIntoView({ block: 'nearest', inline: 'center' });
  }

  protected override render(): unknown {
    const covered = this.dialog !== 'none';
    return html`
      <flexrf-header role="banner" .core=${this.core} @login=${() => void this.#open('login')} @settings=${() => void this.#open('settings')}></flexrf-header>
      <flexrf-stop-motion .core=${this.core} role="region" aria-label="Stop motion"></flexrf-stop-motion>
      <nav aria-label="Views" ?inert=${covered}>${this.#entries().map(([route, label]) => html`
        <a href=${addressOfRoute(route)} aria-current=${this.#isCurrent(route) ? 'page' : nothing}>${label}</a>`)}
      </nav>
      <div class="main">
        <main tabindex="0" aria-label=${this.route.view} ?inert=${covered}>${this.generation
          ? html`<flexrf-outlet .core=${this.core} .views=${views} .route=${this.route} .generation=${this.generation}></flexrf-outlet>`
          : html`<p>Waiting for the application…</p>`}
        </main>
        <flexrf-notices></flexrf-notices>
        ${this.dialog === 'login' ? html`<flexrf-login .core=${this.core} @close=${() => this.#close()}></flexrf-login>` : nothing}
        ${this.dialog === 'password' ? html`<flexrf-password .core=${this.core} .question=${this.question} @close=${() => this.#close()}></flexrf-password>` : nothing}
        ${this.dialog === 'settings' ? html`<flexrf-settings .preferences=${this.#preferences} @close=${() => this.#close()}></flexrf-settings>` : nothing}
      </div>
      <div class="banner" role="region" aria-label="Warnings">
        ${this.below.has('machine') && this.core.hasMachine ? html`<flexrf-machine-lines .core=${this.core}></flexrf-machine-lines>` : nothing}
        ${this.#banner()}
        ${this.below.has('consent') ? html`<flexrf-consent .core=${this.core}></flexrf-consent>` : nothing}
      </div>
    `;
  }

  #banner(): unknown {
    const { link } = this.core;
    if (deniedLink(this.core) === '') return nothing;
    if (!this.generation && link.phase === 'connecting' && link.detail === '') return nothing; // the first try
    const why = this.ended ? `The application ended: ${this.ended}.` : link.detail === 'login' ? 'Log in to connect.' : link.detail;
    return html`<p role="alert">⚠ No connection to the application. Values are old, controls are dead. ${why}</p>`;
  }

  #entries(): (readonly [Route, string])[] {
    const entries: (readonly [Route, string])[] = views
      .filter((view) => view.label !== '' && (!view.onMachine || this.core.hasMachine) && (!view.role || (this.core.session && includes(this.core.session.role, view.role))))
      .map((view) => [{ view: view.name, path: [] }, view.label]);
    if (this.generation) for (const menu of this.core.model.menus.keys()) entries.push([{ view: 'menu', path: [menu] }, menu]);
    return entries;
  }

  #isCurrent(entry: Route): boolean {
    return entry.view === this.route.view && (entry.path.length === 0 || entry.path[0] === this.route.path[0]);
  }

  #onState(): void {
    const { link } = this.core;
    if (hasControl(this.core.situation)) void this.#loadBelow('consent');
    if (this.core.hasMachine) void this.#loadBelow('machine');
    if (this.generation) document.title = titleOf(this.core.application, this.core);
    const lapsed = this.core.session?.lapsed === true;
    if (link.phase === 'open') this.ended = '';
    if (link.phase === 'open' && !lapsed) {
      this.#asked = false;
    } else if ((link.detail === 'login' || lapsed) && !this.#asked) {
      this.#asked = true; // once: who closes the dialog finds the button
      void this.#open('login');
    }
    this.requestUpdate();
  }

  /** Another page begins at its top, and takes along the focus of whoever followed a link in the one before. */
  #turnPage(): void {
    const main = this.renderRoot.querySelector('main');
    if (main) main.scrollTop = 0;
    if ((this.renderRoot as ShadowRoot).activeElement?.localName === 'flexrf-outlet') main?.focus({ preventScroll: true });
  }

  /** The views are dead below a dialog: a jog button would not see its release. */
  async #open(dialog: DialogName): Promise<void> {
    try {
      await loadPart(dialogs[dialog]);
    } catch (error) {
      this.notices?.add(`The dialog cannot be shown: ${(error as Error).message}. Its button tries again.`, 'warning');
      return;
    }
    this.core.endHolds('a dialog was opened');
    this.dialog = dialog;
  }

  #close(): void {
    this.dialog = 'none';
  }

  /** With the next word of the application it is tried again: silence would hand control over. */
  async #loadBelow(name: PartBelow): Promise<void> {
    if (this.below.has(name) || this.#loading.has(name)) return;
    this.#loading.add(name);
    const [what, load] = partsBelow[name];
    try {
      await loadPart(load);
      this.below = new Set([...this.below, name]);
    } catch (error) {
      this.notices?.add(`${what} cannot be shown: ${(error as Error).message}. It is tried again.`, 'warning');
    }
    this.#loading.delete(name);
  }

  #fromAddress(): Route {
    return parseRoute(location.hash, 'overview');
  }
}
