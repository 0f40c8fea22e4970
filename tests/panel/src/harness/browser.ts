// Debian's Chromium, and pages of it that report whatever should not happen.
import { createRequire } from 'node:module';
import { readFileSync } from 'node:fs';
import { chromium as chromiumType, type Browser, type BrowserContext, type BrowserServer, type Locator, type Page } from 'playwright-core';
import { chromium, outerAddress } from './environment';
import { Rest } from './rest';
import { within } from './waiting';

/** After this time a person presses a button once more. */
const pressAgainAfter = 7_500;

const options = {
  executablePath: chromium,
  headless: true,
  args: [
    '--no-sandbox',
    '--enable-unsafe-swiftshader',
    '--disable-background-networking',
    '--disable-component-update',
    // Whatever a page asks for, there is no other host than this machine.
    `--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1, EXCLUDE ${outerAddress() ?? '127.0.0.1'}`,
  ],
};

export async function launch(): Promise<Browser> {
  return chromiumType.launch(options);
}

/** A browser whose process can be told. */
export async function launchProcess(): Promise<{ server: BrowserServer; browser: Browser }> {
  const server = await chromiumType.launchServer(options);
  return { server, browser: await chromiumType.connect(server.wsEndpoint()) };
}

export const sizes = {
  phone: { width: 390, height: 844 },
  panel: { width: 1024, height: 768 },
  desktop: { width: 1440, height: 900 },
} as const;
export type Size = keyof typeof sizes;

export interface ViewerOptions {
  readonly size?: Size;
  readonly touch?: boolean;
  readonly dark?: boolean;
  /** A cookie: the page is of this script's session. */
  readonly session?: string;
}

/** One person before one browser of their own: cookies, storage and pages are nobody else's. */
export class Viewer {
  readonly problems: string[] = [];
  private readonly allowed: RegExp[] = [];

  private constructor(readonly context: BrowserContext, readonly page: Page) {}

  static async open(browser: Browser, address: string, given: ViewerOptions = {}): Promise<Viewer> {
    const context = await browser.newContext({
      viewport: sizes[given.size ?? 'desktop'],
      hasTouch: given.touch ?? false,
      colorScheme: given.dark ? 'dark' : 'light',
      reducedMotion: 'reduce',
      ignoreHTTPSErrors: true, // certificates are the tests' own
    });
    context.setDefaultTimeout(within);
    if (given.session) {
      const [name, value] = given.session.split('=') as [string, string];
      await context.addCookies([{ name, value, url: address }]);
    }
    await context.addInitScript(() => {
      document.addEventListener('securitypolicyviolation', (event) =>
        console.error(`content policy: ${event.violatedDirective} ${event.blockedURI}`));
    });
    const { host } = new URL(address);
    const viewer = new Viewer(context, await context.newPage());
    await context.route((url) => url.host !== host && /^(https?|wss?):$/.test(url.protocol), (route) => {
      viewer.problems.push(`a request left the host: ${route.request().url()}`);
      return route.abort();
    });
    viewer.watch(host);
    await viewer.page.goto(address);
    await viewer.page.locator('flexrf-stop-motion button').waitFor();
    return viewer;
  }

  /** What this test itself brings about. */
  allow(...patterns: readonly RegExp[]): void {
    this.allowed.push(...patterns);
  }

  /** Goes to "#/units/jog", and waits until the view has something to show. */
  async go(view: string, ...path: readonly string[]): Promise<void> {
    const hash = `#/${[view, ...path].map(encodeURIComponent).join('/')}`;
    await this.page.evaluate((to) => { location.hash = to; }, hash);
    await this.page.locator('main h2').first().waitFor();
  }

  /** Takes control by the page's own button. A press that came while the browser had no processor, and the page was dead for that,
   *  is done again: a person would, too. */
  async takeControl(): Promise<void> {
    const take = this.page.getByRole('button', { name: 'Take control' });
    const taken = this.page.getByText('You have control');
    await take.click();
    for (let presses = 1; presses < 4; ++presses) {
      await taken.waitFor({ timeout: pressAgainAfter }).catch(() => undefined);
      if (await taken.isVisible()) return;
      if (!(await take.isEnabled())) continue;
      console.log(`"Take control" is pressed again; the page says, ${await frames(this.page)}:\n${await this.page.getByRole('banner').ariaSnapshot()}`);
      await take.click();
    }
    await taken.waitFor();
  }

  /** The page as it is when it is opened, in the same session. */
  async again(): Promise<void> {
    await this.page.reload();
    await this.page.locator('flexrf-stop-motion button').waitFor();
  }

  /** A script of this person's session, beside the page. */
  async script(): Promise<Rest> {
    const rest = new Rest(new URL(this.page.url()).origin);
    rest.cookie = (await this.context.cookies()).map((one) => `${one.name}=${one.value}`).join('; ');
    return rest;
  }

  async logIn(user: { readonly name: string; readonly password: string }): Promise<void> {
    const { page } = this;
    const dialog = page.locator('flexrf-login'); // what it holds is slotted, so no descendant of the element with the role
    await page.getByRole('dialog', { name: 'Log in' }).waitFor(); // which opens by itself
    await dialog.getByLabel('User').fill(user.name);
    await dialog.getByLabel('Password').fill(user.password);
    await dialog.getByRole('button', { name: 'Log in' }).click();
    await page.getByText(`${user.name}: `).waitFor();
  }

  async close(): Promise<void> {
    await this.context.close();
    this.check();
  }

  /** Throws what was wrong with the page so far, once. */
  check(): void {
    const unexpected = this.problems.filter((problem) => !this.allowed.some((pattern) => pattern.test(problem)));
    this.problems.length = 0;
    if (unexpected.length > 0) throw new Error(`the page had problems:\n${unexpected.join('\n')}`);
  }

  private watch(host: string): void {
    const { page, problems } = this;
    page.on('console', (message) => {
      if (message.type() === 'error') problems.push(`console: ${message.text()} ${message.location().url}`);
    });
    page.on('pageerror', (error) => problems.push(`error: ${error.stack ?? error.message}`));
    page.on('crash', () => problems.push('the page crashed'));
    page.on('websocket', (socket) => {
      if (new URL(socket.url()).host !== host) problems.push(`a socket left the host: ${socket.url()}`);
    });
  }
}

/** Whether the browser draws this page: without frames nothing of it can be pressed, or seen to change. */
export async function frames(page: Page): Promise<string> {
  const waited = await page.evaluate(() => new Promise<number>((resolve) => {
    const began = performance.now();
    requestAnimationFrame(() => resolve(performance.now() - began));
    setTimeout(() => resolve(-1), 2000);
  }));
  return waited < 0 ? 'which got no frame of the screen for 2 s' : `which got a frame of the screen after ${waited.toFixed()} ms`;
}

/** The row of a parameter in a list of them, by its label, which may bear the mark of a modified value. */
export function itemOf(page: Page, label: string): Locator {
  return page.locator('flexrf-item').filter({ has: page.getByText(new RegExp(`^${label}( ●.*)?$`)) });
}

const axeSource = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

interface Violation {
  readonly id: string;
  readonly help: string;
  readonly nodes: readonly { readonly target: readonly unknown[]; readonly failureSummary?: string }[];
}

/** Everything of WCAG 2.2 A and AA that axe can see in the page as it is now. */
export async function violations(page: Page): Promise<string[]> {
  await page.evaluate(axeSource);
  const found = await page.evaluate(async () => {
    const { axe } = window as unknown as { axe: { run(context: Document, options: object): Promise<{ violations: Violation[] }> } };
    const tags = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa'];
    return (await axe.run(document, { runOnly: { type: 'tag', values: tags }, resultTypes: ['violations'] })).violations;
  });
  return found.flatMap((violation) =>
    violation.nodes.map((node) => `${violation.id} (${violation.help}) at ${JSON.stringify(node.target)}: ${node.failureSummary ?? ''}`));
}
