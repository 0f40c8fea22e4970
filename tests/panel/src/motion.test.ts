// Holds, and everything that ends one; Stop motion, clearing it, and Start.
import { spawn } from 'node:child_process';
import { renameSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { afterEach, beforeAll, beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { Browser } from 'playwright-core';
import {
  Application, Cable, Viewer, familyOf, freezer, heldWithin, launchProcess, screenshot, signal, tidyUp, unlessKeptWaiting, useApplication, useBrowser,
  violations, within, type Rest,
} from './harness';

interface Feedback {
  readonly commanded: number;
  readonly begun: number;
  readonly ended_at: number;
}

const browser = useBrowser();

const application = useApplication('panel_cell');

let running: Application;
let rest: Rest;
let admin: Rest;
let viewer: Viewer;

beforeAll(async () => {
  running = application();
  rest = running.rest();
  admin = await running.admin();
});
/** At rest, as after the start, and without anybody in control. */
afterEach(async () => {
  const act = (path: string) => () => admin.do(path, { method: 'POST' });
  await tidyUp(
    act('control/take'), act('stop-motion'), act('components/mover/actions/reset'), act('clear-stop-motion'), act('control/release'),
    expectAtRest);
});

async function begin(at: Browser, address: string): Promise<void> {
  viewer = await Viewer.open(at, address, { session: admin.cookie });
  await viewer.takeControl();
  await viewer.page.getByRole('button', { name: 'Start motion' }).click();
  await viewer.page.getByText('Motion enabled').first().waitFor();
  await viewer.go('units', 'mover');
}

async function feedback(): Promise<Feedback> {
  return rest.feedback<Feedback>('mover');
}
async function expectMoving(timeout = within): Promise<void> {
  await expect.poll(async () => (await feedback()).commanded, { timeout }).not.toBe(0);
}
const expectMovingWhileHeld = (): Promise<void> => expectMoving(heldWithin);
async function expectAtRest(): Promise<void> {
  await expect.poll(async () => (await feedback()).commanded, { timeout: within }).toBe(0);
}
/** Nothing begins again by itself. */
async function expectStayingAtRest(): Promise<void> {
  await expectAtRest();
  const { begun } = await feedback();
  await new Promise((resolve) => setTimeout(resolve, 500));
  expect(await feedback()).toMatchObject({ commanded: 0, begun });
}

const forward = () => viewer.page.locator('flexrf-item').getByRole('button', { name: 'Forward' });

/** Begins, and is let go of if it has to begin once more. */
async function whileHeld(begin: () => Promise<void>, then: () => Promise<void> = expectMovingWhileHeld): Promise<void> {
  const { page } = viewer;
  await unlessKeptWaiting(page, rest, async () => {
    await begin();
    await then();
  }, async () => {
    await page.mouse.up();
    await page.keyboard.up('Space');
    await expectAtRest();
  });
}

/** Puts the mouse down on the button, and leaves it there; it moves, and does what comes `then`. */
async function hold(button = forward(), then?: () => Promise<void>): Promise<void> {
  await whileHeld(async () => {
    await button.scrollIntoViewIfNeeded();
    const box = (await button.boundingBox())!;
    await viewer.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await viewer.page.mouse.down();
  }, then);
}

describe('a hold', () => {
  beforeEach(async () => { await begin(browser(), running.base); });
  afterEach(async () => {
    await viewer.close();
  });

  it('lives as long as the button is pressed, and ends with the release', async () => {
    await hold(forward(), async () => {
      await expectMovingWhileHeld();
      const { begun } = await feedback();
      await new Promise((resolve) => setTimeout(resolve, 1500)); // many times a lease
      expect(await feedback()).toMatchObject({ commanded: 1, begun });
    });
    await viewer.page.mouse.up();
    await expectStayingAtRest();
  });

  it('by a key ends when the key comes up', async () => {
    await whileHeld(async () => {
      await forward().focus();
      await viewer.page.keyboard.down('Space');
    });
    await viewer.page.keyboard.up('Space');
    await expectStayingAtRest();
  });

  it('by the jog pad, too', async () => {
    await hold(viewer.page.locator('flexrf-placement').getByRole('button', { name: 'Backward' }), async () => {
      await expect.poll(async () => (await feedback()).commanded, { timeout: heldWithin }).toBe(-1);
    });
    await viewer.page.mouse.up();
    await expectStayingAtRest();
  });

  it('ends when the finger slides off, and stays so when it comes back', async () => {
    await hold();
    const box = (await forward().boundingBox())!;
    await viewer.page.mouse.move(box.x + box.width / 2, box.y + box.height + 40, { steps: 4 });
    await expectStayingAtRest();
    await viewer.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 4 });
    await expectStayingAtRest();
    await viewer.page.mouse.up();
  });

  it('whose end is told moves nothing under the finger', async () => {
    const { page } = viewer;
    const where = () => Promise.all([forward(), page.locator('flexrf-item').getByRole('button', { name: 'Backward' }),
      page.getByRole('heading', { name: 'Feedback' })].map((one) => one.boundingBox()));
    await forward().scrollIntoViewIfNeeded();
    const before = await where();
    await hold();
    await page.evaluate(() => window.dispatchEvent(new Event('blur')));
    await expectAtRest();
    await page.mouse.up();
    const said = page.locator('flexrf-item').getByRole('status').filter({ hasText: /./ });
    await expect.poll(() => where(), { timeout: within }).toEqual(before);
    await admin.do('control/release', { method: 'POST' });
    await page.getByText('Dead: take control first').first().waitFor();
    // A touch on what is dead tells why, over the page.
    const box = before[0]!;
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await said.first().waitFor();
    expect(await said.first().innerText()).toBe('Locked: take control first');
    await screenshot(page, 'said');
    expect(await violations(page)).toEqual([]);
    expect(await where()).toEqual(before);
  });

  it('ends when the window loses the focus', async () => {
    await hold();
    await viewer.page.evaluate(() => window.dispatchEvent(new Event('blur')));
    await expectStayingAtRest();
  });

  it('ends when the touch is cancelled', async () => {
    await hold();
    await viewer.page.evaluate(() => window.dispatchEvent(new PointerEvent('pointercancel', { pointerId: 1, bubbles: true })));
    await expectStayingAtRest();
  });

  it('ends when the page is hidden', async () => {
    await hold();
    await viewer.page.evaluate(() => {
      Object.defineProperty(document, 'visibilityState', { value: 'hidden', configurable: true });
      Object.defineProperty(document, 'hidden', { value: true, configurable: true });
      document.dispatchEvent(new Event('visibilitychange'));
    });
    await expectStayingAtRest();
  });

  it('ends when the page is left', async () => {
    await hold();
    await viewer.page.goto('about:blank');
    await expectStayingAtRest();
  });

  it('ends when its page is closed', async () => {
    await hold();
    await viewer.page.close();
    await expectStayingAtRest();
  });

  it('ends with the control token', async () => {
    await hold();
    await admin.do('control/release', { method: 'POST' });
    await expectStayingAtRest();
    await viewer.page.getByText('Nobody has control').waitFor();
  });

  // [stop-10]
  it('ends with Stop motion by somebody who only looks', async () => {
    const other = await Viewer.open(browser(), running.base);
    await hold();
    await other.page.getByRole('button', { name: 'Stop motion' }).click();
    await expectStayingAtRest();
    await viewer.page.getByText('Motion stopped').first().waitFor();
    await other.close();
  });

  it('ends while the server\'s thread is held still', async (context) => {
    await hold();
    const frozen = spawn(freezer, [String(running.id), 'panel'], { stdio: ['pipe', 'pipe', 'pipe'] });
    const said = await new Promise<string>((resolve) => {
      frozen.stdout.once('data', (part: Buffer) => resolve(part.toString()));
      frozen.once('close', () => resolve(''));
    });
    if (!said.startsWith('frozen')) {
      await viewer.page.mouse.up();
      context.skip('this user may not hold another process\'s thread');
    }
    // As who froze it says: until that is read here, the hold may be over already.
    const at = BigInt(said.split(/\s/)[1]!);
    // Nobody answers meanwhile: when it ended is read afterwards, from the unit's own clock.
    await new Promise((resolve) => setTimeout(resolve, 1500));
    const thawed = process.hrtime.bigint();
    frozen.stdin.end();
    await new Promise((resolve) => frozen.once('close', resolve));
    await expectAtRest();
    const { ended_at: ended } = await feedback();
    expect(BigInt(Math.round(ended))).toBeGreaterThan(at);
    expect(BigInt(Math.round(ended))).toBeLessThan(thawed);
    await viewer.page.mouse.up();
    await expectStayingAtRest();
    viewer.allow(/WebSocket/);
  });

  it('is not begun by a second finger, or a right button', async () => {
    const box = (await forward().boundingBox())!;
    const { begun } = await feedback();
    await viewer.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await viewer.page.mouse.down({ button: 'right' });
    await expectStayingAtRest();
    expect((await feedback()).begun).toBe(begun);
    await viewer.page.mouse.up({ button: 'right' });
  });
});

describe('a hold over a cable', () => {
  let cable: Cable;
  beforeEach(async () => {
    cable = await Cable.to(running.port);
    await begin(browser(), cable.base);
  });
  afterEach(async () => {
    viewer.allow(/WebSocket|Failed to load resource|ERR_/);
    await tidyUp(() => viewer.close(), () => cable.close());
  });

  it('ends when it is cut, and does not begin again when it is mended', async () => {
    await hold();
    cable.cut();
    await expectStayingAtRest();
    await viewer.page.getByText('Values are old, controls are dead').waitFor();
    cable.mend();
    await viewer.page.getByText('Values are old, controls are dead').waitFor({ state: 'hidden' });
    await expectStayingAtRest();
  });

  it('ends when the connection is reset', async () => {
    await hold();
    cable.drop();
    await expectStayingAtRest();
    await viewer.page.getByText(/^Round trip/).waitFor();
    await expectStayingAtRest();
  });
});

describe('a hold and the browser\'s process', () => {
  for (const name of ['SIGSTOP', 'SIGKILL'] as const) {
    it(`ends with ${name}`, async () => {
      const { server, browser: own } = await launchProcess();
      const family = familyOf(server.process().pid!);
      try {
        await begin(own, running.base);
        await hold();
        family.splice(0, family.length, ...familyOf(server.process().pid!));
        signal(family, name);
        await expectStayingAtRest();
        if (name === 'SIGSTOP') {
          signal(family, 'SIGCONT');
          await viewer.page.getByText(/^Round trip/).waitFor();
          await expectStayingAtRest();
        }
      } finally {
        signal(family, 'SIGCONT');
        signal(family, 'SIGKILL');
        await server.close().catch(() => undefined);
      }
    });
  }
});

describe('Stop motion', () => {
  beforeEach(async () => { await begin(browser(), running.base); });
  afterEach(async () => {
    await viewer.close();
  });

  // [stop-11]
  it('stops, and after it come Clear and Start, one after the other', async () => {
    const { page } = viewer;
    await page.getByRole('switch', { name: 'Run' }).click();
    await expectMoving();
    await page.getByRole('button', { name: 'Stop motion' }).click();
    await expectAtRest();
    await page.getByRole('button', { name: 'Motion is stopped' }).waitFor();
    expect(await violations(page)).toEqual([]);
    expect(await page.getByRole('button', { name: 'Start motion' }).count()).toBe(0);
    // Start motion takes the place of Clear stop: the second of two quick presses is not for it.
    await page.locator('flexrf-header').evaluate((header) => {
      const root = header.shadowRoot as ShadowRoot;
      const observer = new MutationObserver(() => {
        const start = [...root.querySelectorAll('button')].find((button) => button.textContent === 'Start motion');
        if (start === undefined) return;
        observer.disconnect();
        start.click();
        header.setAttribute('data-pressed', 'twice');
      });
      observer.observe(root, { subtree: true, childList: true, characterData: true });
    });
    await page.getByRole('button', { name: 'Clear stop' }).click();
    await page.locator('flexrf-header[data-pressed=twice]').waitFor();
    await page.getByText('Motion inhibited').first().waitFor();
    await expectAtRest(); // cleared is not started
    // What cannot act says so before anybody presses it.
    await page.getByText('Dead: motion is inhibited: give Start motion').first().waitFor();
    expect(await forward().isDisabled()).toBe(true);
    await page.getByRole('button', { name: 'Start motion' }).click();
    await page.getByText('Motion enabled').first().waitFor();
    await expectMoving();
    await page.getByRole('switch', { name: 'Run' }).click();
    await expectAtRest();
  });

  it('works from every view, and while a dialog is open', async () => {
    const { page } = viewer;
    await page.getByRole('button', { name: 'Settings' }).click();
    await page.getByRole('dialog').waitFor();
    await page.getByRole('button', { name: 'Stop motion' }).click();
    await page.getByText('Motion stopped').first().waitFor();
    // The focus is on Stop motion now: Escape closes the dialog all the same.
    await page.keyboard.press('Escape');
    await page.getByRole('dialog').waitFor({ state: 'hidden' });
  });

  it('may be given, and neither cleared nor started, by who only looks', async () => {
    const other = await Viewer.open(browser(), running.base);
    await other.page.getByRole('button', { name: 'Stop motion' }).click();
    await other.page.getByText('Motion stopped').first().waitFor();
    await expect.poll(() => other.page.getByRole('button', { name: 'Clear stop' }).isDisabled(), { timeout: within }).toBe(true);
    for (const path of ['clear-stop-motion', 'start-motion']) {
      expect((await rest.ask(path, { method: 'POST' })).status).toBe(403);
    }
    expect((await rest.ask('stop-motion', { method: 'POST' })).status).toBeLessThan(300);
    await other.close();
  });
});

// [stop-92] [stop-93]
it('whoever else permits motion on the machine is asked before Start, and what he says is read', async () => {
  const word = join(running.folder, 'motion');
  const say = (text: string): void => {
    writeFileSync(`${word}.new`, text);
    renameSync(`${word}.new`, word);
  };
  const asking = await Application.start('panel_cell', { arguments: ['--motion-permit', word] });
  onTestFinished(() => tidyUp(() => watcher.close(), () => asking.end()));
  const script = await asking.admin();
  const watcher = await Viewer.open(browser(), asking.base, { session: script.cookie });
  const { page } = watcher;
  await watcher.takeControl();
  const start = page.getByRole('button', { name: 'Start motion' });
  const says = (text: string) => page.getByText(text).first().waitFor();
  await says(`this machine has not permitted motion: ${word}: No such file or directory`);
  expect(await start.isDisabled()).toBe(true);
  say('it is being updated\n');
  await says('this machine does not permit motion: it is being updated');
  expect(await start.isDisabled()).toBe(true);
  await screenshot(page, 'motion-not-permitted');
  expect(await violations(page)).toEqual([]);
  // By no other way either.
  const refused = await script.ask('start-motion', { method: 'POST' });
  expect(refused.status).toBeGreaterThanOrEqual(400);
  expect(refused.text).toContain('it is being updated');
  say('permitted\n');
  await start.click();
  await says('Motion enabled');
  say('it is being updated\n');
  await says('Motion inhibited');
  say('permitted\n');
  await expect.poll(() => start.isDisabled(), { timeout: within }).toBe(false);
  expect((await script.ask('state')).body.motion).toMatchObject({ may_move: false, start_refused: '' });
});
