// Who may do what: passwords, roles, the one control token and its way from one person to another.
import { readFileSync, statSync } from 'node:fs';
import { connect, type ConnectionOptions } from 'node:tls';
import { afterEach, beforeAll, beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import {
  Application, Rest, Viewer, heldWithin, outerAddress, screenshot, tidyUp, unlessKeptWaiting, useApplication, useBrowser, violations, within,
  type ApplicationName, type StartOptions, type User,
} from './harness';

const anna: User = { name: 'anna', role: 'engineer', password: 'a long password of anna' };
const otto: User = { name: 'otto', role: 'operator', password: 'a long password of otto' };
const vera: User = { name: 'vera', role: 'viewer', password: 'a long password of vera' };

const browser = useBrowser();

let running: Application;
const seeing: Viewer[] = [];

async function open(user?: User, address = running.base): Promise<Viewer> {
  const viewer = await Viewer.open(browser(), address);
  seeing.push(viewer);
  viewer.allow(/401|WebSocket/); // before the log-in
  if (user) await viewer.logIn(user);
  return viewer;
}

afterEach(async () => {
  await tidyUp(...seeing.splice(0).map((viewer) => () => viewer.close()));
});

/** One of the test's own. */
async function start(options: StartOptions = {}, name: ApplicationName = 'panel_cell'): Promise<void> {
  running = await Application.start(name, options);
  const mine = running;
  onTestFinished(() => mine.end());
}

describe('with a password file', () => {
  const application = useApplication('panel_cell', { users: [anna, otto, vera] });
  beforeEach(() => { running = application(); });

  it('nothing is seen before the log-in, and a wrong password says so', async () => {
    const rest = running.rest();
    for (const path of ['descriptor', 'state', 'components', 'components/mover/parameters', 'slots', 'log']) {
      expect((await rest.ask(path)).status, path).toBe(401);
    }
    const viewer = await open();
    viewer.allow(/403/); // the wrong password
    const dialog = viewer.page.locator('flexrf-login');
    await dialog.getByLabel('User').fill('anna');
    await dialog.getByLabel('Password').fill('wrong');
    await dialog.getByRole('button', { name: 'Log in' }).click();
    await dialog.getByRole('alert').waitFor();
    await screenshot(viewer.page, 'login-refused');
    expect(await violations(viewer.page)).toEqual([]);
    await dialog.getByLabel('Password').fill(anna.password);
    await dialog.getByRole('button', { name: 'Log in' }).click();
    await viewer.page.getByText('anna: engineer').waitFor();
    await viewer.go('units', 'gadget');
    await viewer.page.getByRole('button', { name: 'Log out' }).click();
    await viewer.page.getByText('anna: engineer').waitFor({ state: 'hidden' });
    expect((await rest.ask('descriptor')).status).toBe(401);
  });

  it('the log-in stands still while the page tries to connect again and again', async () => {
    const viewer = await open();
    const { page } = viewer;
    const dialog = page.locator('flexrf-login');
    await dialog.getByLabel('User').fill(anna.name);
    await dialog.getByLabel('Password').fill(anna.password);
    const seen = await dialog.evaluateHandle((element) => {
      const states: string[] = [];
      const note = (): void => {
        const button = element.shadowRoot!.querySelector<HTMLButtonElement>('button.first')!;
        const state = `${button.disabled ? 'dead' : 'alive'} at ${button.getBoundingClientRect().y}`;
        if (states.at(-1) !== state) states.push(state);
      };
      note();
      new MutationObserver(note).observe(element.shadowRoot!, { subtree: true, childList: true, attributes: true, characterData: true });
      return states;
    });
    for (let tries = 0; tries < 4; tries += 1) {
      await page.waitForResponse((response) => response.url().endsWith('/api/v1/session') && response.status() === 401);
    }
    const states = await seen.jsonValue();
    expect(states).toEqual([expect.stringMatching(/^alive/)]);
    await dialog.getByRole('button', { name: 'Log in' }).click();
    await page.getByText('anna: engineer').waitFor();
  });

  it('the cookie is kept from scripts and from other sites', async () => {
    const viewer = await open(anna);
    const cookies = await viewer.context.cookies();
    expect(cookies.map((one) => ({ name: one.name, httpOnly: one.httpOnly, sameSite: one.sameSite }))).toEqual([
      { name: `flexrf_session_${running.port}`, httpOnly: true, sameSite: 'Strict' },
    ]);
    expect(await viewer.page.evaluate(() => document.cookie)).toBe('');
  });

  it('each role may do what it may, on the server', async () => {
    const setLevel = { method: 'PUT', body: { level: 4 } };
    const viewing = await running.loggedIn(vera);
    expect((await viewing.ask('control/take', { method: 'POST' })).status).toBe(403);
    expect((await viewing.ask('components/gadget/parameters', setLevel)).status).toBe(403);

    const operating = await running.loggedIn(otto);
    // Without the token not even who has the role.
    expect((await operating.ask('components/gadget/parameters', setLevel)).status).toBeGreaterThanOrEqual(400);
    await operating.do('control/take', { method: 'POST' });
    await operating.do('components/gadget/parameters', setLevel);
    expect((await operating.ask('components/gadget/parameters', { method: 'PUT', body: { expert: 0.1 } })).status).toBe(403);
    expect((await operating.ask('components/gadget/actions/stop', { method: 'POST' })).status).toBe(403);
    await operating.do('control/release', { method: 'POST' });

    const engineering = await running.loggedIn(anna);
    await engineering.do('control/take', { method: 'POST' });
    await engineering.do('components/gadget/parameters', { method: 'PUT', body: { expert: 0.1 } });
    expect((await engineering.ask('components/gadget/parameters', { method: 'PUT', body: { secret: 0.1 } })).status).toBe(403);
    // All or none: what it may set is not set beside what it may not.
    const both = { method: 'PUT', body: { level: 2, secret: 0.1 } };
    expect((await engineering.ask('components/gadget/parameters', both)).status).toBe(403);
    expect((await engineering.runtime('gadget'))['level']).toBe(4);
    await engineering.do('control/release', { method: 'POST' });
  });

  it('the page locks what the role may not', async () => {
    const viewer = await open(otto);
    await viewer.takeControl();
    await viewer.go('units', 'gadget');
    await expect.poll(() => viewer.page.getByRole('slider', { name: 'Level of it' }).isEnabled(), { timeout: within }).toBe(true);
    await expect.poll(() => viewer.page.getByRole('slider', { name: 'Expert' }).isEnabled(), { timeout: within }).toBe(false);
    await viewer.page.getByText('Locked: needs engineer').first().waitFor();
  });
});

describe('the control token', () => {
  let first: Viewer;
  let second: Viewer;
  let rest: Rest;
  const application = useApplication('panel_cell', { users: [anna, otto] });
  beforeAll(async () => { rest = await application().loggedIn(anna); });

  beforeEach(async () => {
    running = application();
    first = await open(anna);
    second = await open(otto);
    await first.takeControl();
    await second.page.getByText('anna at').waitFor();
  });

  afterEach(async () => {
    const act = (path: string) => () => rest.do(path, { method: 'POST' });
    await tidyUp(
      ...[first, second].map((viewer) => async () => (await viewer.script()).do('control/release', { method: 'POST' })),
      act('control/take'), act('stop-motion'), act('clear-stop-motion'), act('control/release'));
  });

  /** The first's hand on the button that moves, until what comes `then` is done, and longer. */
  async function hold(then: () => Promise<void>): Promise<void> {
    const { page } = first;
    await page.getByRole('button', { name: 'Start motion' }).click();
    await page.getByText('Motion enabled').first().waitFor();
    await first.go('units', 'mover');
    const button = page.locator('flexrf-item').getByRole('button', { name: 'Forward' });
    await unlessKeptWaiting(page, rest, async () => {
      await button.scrollIntoViewIfNeeded();
      const box = (await button.boundingBox())!;
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
      await page.mouse.down();
      await expect.poll(commanded, { timeout: heldWithin }).toBe(1);
      await then();
    }, async () => {
      await page.mouse.up();
      const keep = page.getByRole('button', { name: 'Keep control' });
      if (await keep.isVisible()) await keep.click();
      await expect.poll(commanded, { timeout: within }).toBe(0);
    });
  }
  async function commanded(): Promise<number> {
    return (await rest.feedback<{ commanded: number }>('mover')).commanded;
  }
  async function ask(): Promise<void> {
    await second.page.getByRole('button', { name: 'Ask for control' }).click();
    await first.page.getByRole('group', { name: 'Request for control' }).waitFor();
  }

  it('is handed over with consent, and what was held ends', async () => {
    await hold(async () => {
      await ask();
      expect(await commanded()).toBe(1); // asking takes nothing
    });
    // The hand stays on the button that moves: the answer comes by the keyboard.
    await first.page.getByRole('group', { name: 'Request for control' }).getByRole('button', { name: 'Hand over' }).focus();
    await first.page.keyboard.press('Enter');
    await second.page.getByText('You have control').waitFor();
    await expect.poll(commanded, { timeout: within }).toBe(0);
    await first.page.getByText('otto at').waitFor();
    await first.page.mouse.up();
  });

  it('stays when its holder refuses', async () => {
    await ask();
    await screenshot(first.page, 'consent');
    await first.page.getByRole('button', { name: 'Keep control' }).click();
    await second.page.getByRole('button', { name: 'Ask for control' }).and(second.page.locator(':enabled')).waitFor();
    await first.page.getByText('You have control').waitFor();
    expect(await second.page.getByText('You have control').count()).toBe(0);
    await second.page.getByText(/You did not get control: anna at .* keeps control\./).waitFor();
  });

  it('is not asked about while no answer would arrive', async () => {
    const question = first.page.getByRole('group', { name: 'Request for control' });
    await first.go('units', 'mover');
    const before = await first.page.getByRole('heading', { name: 'mover' }).boundingBox();
    await ask();
    expect(await question.getByRole('button', { name: 'Keep control' }).isEnabled()).toBe(true);
    expect(await first.page.getByRole('heading', { name: 'mover' }).boundingBox()).toEqual(before); // it moves nothing
    first.allow(/WebSocket/);
    second.allow(/WebSocket/);
    running.process.kill('SIGSTOP');
    await expect.poll(() => question.getByRole('button', { name: 'Keep control' }).isDisabled(), { timeout: within }).toBe(true);
    expect(await question.getByRole('button', { name: 'Hand over' }).isDisabled()).toBe(true);
    await question.getByText('no answer reaches the application').waitFor();
    await screenshot(first.page, 'consent-without-link');
    running.process.kill('SIGCONT');
    await first.page.getByText(/^Round trip/).waitFor();
    await second.page.getByText(/^Round trip/).waitFor();
  });

  it('goes over after 10 s without an answer, and what was held ends', async () => {
    await hold(ask);
    expect(await violations(first.page)).toEqual([]); // may take longer than there is time for an answer
    await second.page.getByText('You have control').waitFor();
    await expect.poll(commanded, { timeout: within }).toBe(0);
    await first.page.mouse.up();
  });

  it('is given back, and can be taken at once', async () => {
    await first.page.getByRole('button', { name: 'Release' }).click();
    await second.takeControl();
  });
});

describe('a session whose time is over', () => {
  it('is asked for in place, and Stop motion stays alive', async () => {
    await start({ users: [anna] }, 'brief_session');
    const viewer = await open(anna);
    const { page } = viewer;
    await viewer.takeControl();
    await viewer.go('units', 'robot');
    const heading = await page.getByRole('heading', { name: 'robot', level: 2 }).elementHandle();

    const question = page.getByRole('dialog', { name: 'Log in' });
    await question.waitFor(); // by itself
    await page.getByText('anna: log in again').waitFor();
    await page.getByText(/^Round trip/).waitFor(); // the link is alive
    await page.getByText('Nobody has control').waitFor();
    await page.locator('flexrf-control').getByText('log in again').waitFor();
    expect(await page.getByRole('button', { name: 'Take control' }).isDisabled()).toBe(true);
    await screenshot(page, 'session-over');
    expect(await violations(page)).toEqual([]);
    expect((await running.rest().ask('state')).status).toBe(401);
    const script = await viewer.script();
    expect((await script.ask('control/take', { method: 'POST' })).status).toBe(403);
    await page.getByText('Motion enabled').waitFor();
    await page.getByRole('button', { name: 'Stop motion' }).click();
    await page.getByText('Motion stopped').first().waitFor();
    await page.getByText(/^by anna \(127\.0\.0\.1\) at/).first().waitFor();
    await screenshot(page, 'session-over-stopped');

    expect(await page.locator('flexrf-login').getByLabel('User').inputValue()).toBe(anna.name); // whose it was
    await viewer.logIn(anna);
    await question.waitFor({ state: 'hidden' });
    expect(await heading!.isVisible()).toBe(true); // the view that was open, and no other made like it
    await viewer.takeControl();
    await page.getByRole('button', { name: 'Clear stop' }).click();
    await page.getByText('Motion inhibited').first().waitFor();
  });
});

describe('a session at the machine', () => {
  const outer = outerAddress();

  it.skipIf(outer === undefined)('cannot be displaced from afar', async () => {
    await start({ listen: '0.0.0.0:0', users: [anna, otto], arguments: ['--insecure-http'] });
    const { port } = new URL(running.base);
    const near = await running.rest();
    const local = Object.assign(near, { base: `http://127.0.0.1:${port}` });
    await local.do('login', { body: { user: anna.name, password: anna.password } });
    await local.do('control/take', { method: 'POST' });
    const far = Object.assign(running.rest(), { base: `http://${outer}:${port}` });
    await far.do('login', { body: { user: otto.name, password: otto.password } });
    const refused = await far.ask('control/take', { method: 'POST' });
    expect(refused.status).toBeGreaterThanOrEqual(400);
    expect(refused.body.detail).toMatch(/machine|local/);
    expect((await local.do('state')).body.control.holder).toMatchObject({ user: 'anna', you: true });
    // The other way round it can, at once.
    await local.do('control/release', { method: 'POST' });
    await far.do('control/take', { method: 'POST' });
    expect((await local.do('control/take', { method: 'POST' })).body).toEqual({ taken: true });
    expect((await far.do('state')).body.control.holder).toMatchObject({ user: 'anna', you: false });
  });
});

describe('other addresses than loopback', () => {
  it('need passwords, and TLS or a word for going without', async () => {
    await expect(Application.start('panel_cell', { listen: '0.0.0.0:0' })).rejects.toThrow(/password/);
    await expect(Application.start('panel_cell', { listen: '0.0.0.0:0', users: [anna] })).rejects.toThrow(/TLS|insecure-http/);
    await start();
    await running.rest().do('session');
  });
});

describe('by TLS', () => {
  it('logs in at an address of the network, with a cookie that never goes without TLS', async () => {
    const address = outerAddress() ?? '127.0.0.1';
    await start({ listen: '0.0.0.0:0', users: [anna], certificateFor: address });
    expect(running.base).toMatch(/^https:/);
    const viewer = await open(anna, `https://${address}:${running.port}`);
    expect((await viewer.context.cookies()).map((one) => ({ name: one.name, httpOnly: one.httpOnly, sameSite: one.sameSite, secure: one.secure })))
      .toEqual([{ name: `__Host-flexrf_session_${running.port}`, httpOnly: true, sameSite: 'Strict', secure: true }]);
    // What it does then comes by the encrypted socket.
    await viewer.takeControl();
    await viewer.go('units', 'gadget');
    await expect.poll(() => viewer.page.getByRole('slider', { name: 'Level of it' }).isEnabled(), { timeout: within }).toBe(true);
  });

  it('tells who comes otherwise how to come, and the log why somebody was not let in', async () => {
    await start({ users: [anna], certificateFor: '127.0.0.1' });
    const plain = await new Rest(`http://127.0.0.1:${running.port}`).ask('session');
    expect(plain).toMatchObject({ status: 400, text: 'The panel speaks TLS here: the address begins https://\n' });
    await expect.poll(() => running.text, { timeout: within }).toContain('was not let in by TLS: it asked without TLS');
    const tls = (options: ConnectionOptions): Promise<string> => new Promise((resolve) => {
      const socket = connect({ host: '127.0.0.1', port: running.port, rejectUnauthorized: false, ...options }, () => {
        resolve(socket.getProtocol() ?? '');
        socket.destroy();
      });
      socket.on('error', (error) => resolve(error.message));
    });
    expect(await tls({ maxVersion: 'TLSv1.2' })).toBe('TLSv1.2');
    const old = { minVersion: 'TLSv1', maxVersion: 'TLSv1.1', ciphers: 'DEFAULT:@SECLEVEL=0' } as const;
    expect(await tls(old)).toMatch(/alert protocol version/);
    // The log says such things once in a second.
    await expect.poll(async () => (await tls(old), running.text), { timeout: within })
      .toContain('it knows no version of TLS that is allowed here (1.2 and 1.3)');
    expect(await tls({ maxVersion: 'TLSv1.2', ciphers: 'ECDHE-ECDSA-AES128-SHA256' })).toMatch(/alert handshake failure/);
  });

  it('refuses a file that is no certificate, and names it', async () => {
    await expect(Application.start('panel_cell', {
      users: [anna], arguments: ['--tls-certificate', '/etc/hostname', '--tls-key', '/etc/hostname'],
    })).rejects.toThrow(/--tls-certificate \/etc\/hostname: .*PEM/);
  });
});

describe('the address that is printed', () => {
  it('lets in once, and loses its token', async () => {
    await start();
    const first = await open(undefined, running.address);
    await first.page.getByText(/: admin/).waitFor();
    expect(first.page.url()).not.toContain('token');
    const again = await running.rest().ask(new URL(running.address).pathname + new URL(running.address).search);
    expect(again.status).toBe(403);
    expect(again.body.detail).toContain('used already');
    // Whoever runs the application has the next one.
    const file = /Once that was opened, the next address is in (\S+)/.exec(running.text)?.[1];
    const next = readFileSync(file!, 'utf8').trim();
    expect(next).not.toBe(running.address);
    expect(statSync(file!).mode & 0o777).toBe(0o600);
    const other = await open(undefined, next);
    await other.page.getByText(/: admin/).waitFor();
    const second = await open();
    await second.page.getByText(/: viewer/).waitFor();
    await expect.poll(() => second.page.getByRole('button', { name: 'Take control' }).isDisabled(), { timeout: within }).toBe(true);
  });

  it('is not lost to what the same page had asked before it', async () => {
    await start();
    const viewer = await open(undefined, `${running.base}/#/log`); // is left while it still loads and connects
    await viewer.page.goto(running.address);
    await viewer.page.getByText(/: admin/).waitFor();
    await viewer.takeControl();
    await viewer.again();
    await viewer.page.getByText(/: admin/).waitFor();
  });
});
