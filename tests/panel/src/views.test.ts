// Each view: there, without a problem, accessible, and within its window at every size.
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import type { Page } from 'playwright-core';
import {
  Application, Viewer, screenshot, sizes, useApplication, useBrowser, violations, within, type ApplicationName, type Size,
} from './harness';

interface Place {
  readonly name: string;
  readonly path: readonly [string, ...string[]];
  /** Seen when it is complete. */
  readonly shows: string | RegExp;
}

const keyboardPlaces: readonly Place[] = [
  { name: 'overview', path: ['overview'], shows: 'Jog step' },
  { name: 'units', path: ['units'], shows: 'robot_control' },
  { name: 'unit-jog', path: ['units', 'jog'], shows: 'Running' },
  { name: 'unit-robot', path: ['units', 'robot'], shows: 'Running' },
  { name: 'devices', path: ['devices'], shows: 'RobotArm' },
  { name: 'device-arm', path: ['devices', 'arm'], shows: 'Running' },
  { name: 'blackboard', path: ['blackboard'], shows: 'tool_pose' },
  { name: 'threads', path: ['threads'], shows: 'p99.9' },
  { name: 'log', path: ['log'], shows: 'Follow' },
];

const cellPlaces: readonly Place[] = [
  { name: 'overview', path: ['overview'], shows: 'Camera' },
  { name: 'units', path: ['units'], shows: 'worker[2]' },
  { name: 'unit-gadget', path: ['units', 'gadget'], shows: 'Where it is' },
  { name: 'unit-mover', path: ['units', 'mover'], shows: 'Turn by hand' },
  { name: 'unit-worker', path: ['units', 'worker[0]'], shows: 'Population worker' },
  { name: 'blackboard', path: ['blackboard'], shows: 'picture' },
  { name: 'search', path: ['search'], shows: /^\d+ found$/ },
  { name: 'menu', path: ['menu', 'Tuning'], shows: 'Count' },
];

const browser = useBrowser();

/** Nothing beside the window, and Stop motion within it with nothing above. */
async function expectFitting(page: Page): Promise<void> {
  const seen = await page.evaluate(() => {
    const stop = document.querySelector('flexrf-panel')!.shadowRoot!.querySelector('flexrf-stop-motion')!;
    const box = stop.shadowRoot!.querySelector('button')!.getBoundingClientRect();
    let top = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
    while (top?.shadowRoot) {
      const inner: Element | null = top.shadowRoot.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
      if (!inner || inner === top) break;
      top = inner;
    }
    return {
      tooWide: document.documentElement.scrollWidth - innerWidth,
      within: box.left >= 0 && box.top >= 0 && box.right <= innerWidth && box.bottom <= innerHeight,
      top: top?.textContent?.trim() ?? '',
    };
  });
  expect(seen.tooWide).toBeLessThanOrEqual(0);
  expect(seen.within).toBe(true);
  expect(seen.top).toContain('Stop motion');
}

function describeViews(application: ApplicationName, places: readonly Place[]): void {
  describe(`${application}'s views`, () => {
    const running = useApplication(application);

    for (const size of Object.keys(sizes) as Size[]) {
      it(`at the size of a ${size}`, async () => {
        // The token in the address works once; the others see the page as viewers.
        const address = size === 'phone' ? running().address : running().base;
        const viewer = await Viewer.open(browser(), address, { size, touch: size === 'phone' });
        const found: string[] = [];
        for (const place of places) {
          await viewer.go(...place.path);
          await viewer.page.getByText(place.shows, { exact: false }).first().waitFor();
          await viewer.page.locator('main').evaluate((main) => main.scrollTo(0, 0));
          await expectFitting(viewer.page);
          await screenshot(viewer.page, `${application}-${place.name}`);
          found.push(...(await violations(viewer.page)).map((one) => `${place.name}: ${one}`));
        }
        await viewer.close();
        expect(found).toEqual([]);
      });
    }
  });
}

describeViews('keyboard', keyboardPlaces);
describeViews('panel_cell', cellPlaces);

describe('dialogs, themes, and what the views show', () => {
  const application = useApplication('panel_cell');
  let running: Application;
  let viewer: Viewer;
  beforeAll(async () => {
    running = application();
    viewer = await Viewer.open(browser(), running.address);
  });
  afterAll(async () => { await viewer?.close(); });

  it('are accessible, and leave Stop motion free', async () => {
    const viewer = await Viewer.open(browser(), running.base, { size: 'phone' });
    const found: string[] = [];
    for (const name of ['Log in', 'Settings']) {
      await viewer.page.getByRole('button', { name }).click();
      await viewer.page.getByRole('dialog').waitFor();
      await expectFitting(viewer.page);
      await screenshot(viewer.page, `dialog-${name.replaceAll(' ', '-').toLowerCase()}`);
      found.push(...(await violations(viewer.page)));
      await viewer.page.keyboard.press('Escape');
      await viewer.page.getByRole('dialog').waitFor({ state: 'hidden' });
    }
    await viewer.close();
    expect(found).toEqual([]);
  });

  it('in the dark too', async () => {
    const viewer = await Viewer.open(browser(), running.base, { size: 'panel', dark: true });
    const found: string[] = [];
    for (const place of cellPlaces) {
      await viewer.go(...place.path);
      await viewer.page.getByText(place.shows).first().waitFor();
      await screenshot(viewer.page, `dark-${place.name}`);
      found.push(...(await violations(viewer.page)).map((one) => `${place.name}: ${one}`));
    }
    await viewer.close();
    expect(found).toEqual([]);
  });

  it('an unknown view is said to be unknown', async () => {
    const viewer = await Viewer.open(browser(), `${running.base}/#/nowhere`);
    await viewer.page.getByText('There is no view "nowhere"').waitFor();
    await viewer.go('units', 'nobody');
    await viewer.page.getByText('There is no unit of this name').waitFor();
    await viewer.close();
  });

  it('the header: mode, motion, round trip, age of data, session', async () => {
    const header = viewer.page.locator('flexrf-header');
    await header.getByRole('heading', { name: 'panel_cell' }).waitFor();
    for (const text of ['Running', 'Motion inhibited', /Round trip [\d.]+ ms/, /data [\d.]+ s old/, /: admin/]) {
      await header.getByText(text).first().waitFor();
    }
    expect(await viewer.page.title()).toContain('panel_cell');
  });

  it('a population with its members', async () => {
    await viewer.go('units', 'worker[2]');
    const members = viewer.page.getByRole('table', { name: 'Members of the population' });
    await expect.poll(() => members.getByRole('row').count(), { timeout: within }).toBe(4);
  });

  it('a slot with all its fields, a queue with its counters', async () => {
    await viewer.go('blackboard');
    await viewer.page.getByRole('button', { name: 'sample' }).click();
    await viewer.page.getByText('Goes up and down').first().waitFor({ state: 'attached' });
    const rate = viewer.page.getByRole('row').filter({ has: viewer.page.getByRole('button', { name: 'sample' }) });
    await expect.poll(() => rate.innerText(), { timeout: within }).toMatch(/\d+(\.\d+)?\s*\/s/);
    await viewer.page.getByRole('row', { name: /tasks/ }).first().waitFor();
  });

  it('an opened slot within the window, however wide its table is', async () => {
    await viewer.page.setViewportSize({ width: 1366, height: 768 });
    await viewer.go('blackboard');
    const inside = viewer.page.locator('flexrf-blackboard .inside');
    if (await inside.count() === 0) await viewer.page.getByRole('button', { name: 'sample' }).click();
    await viewer.page.getByText('Goes up and down').first().waitFor({ state: 'attached' });
    const widths = await inside.locator('*').evaluateAll((all) => all.map((one) => one.getBoundingClientRect().right));
    expect(widths.length).toBeGreaterThan(3);
    expect(Math.max(...widths)).toBeLessThanOrEqual(1366);
    await screenshot(viewer.page, 'opened-slot');
    await viewer.page.setViewportSize(sizes.desktop);
  });

  it('NULL with its reason', async () => {
    await viewer.go('blackboard');
    const row = viewer.page.getByRole('row').filter({ has: viewer.page.getByRole('button', { name: 'spots[2]' }) });
    await expect.poll(() => row.innerText(), { timeout: within }).toMatch(/NULL: \w+/);
  });

  it('threads with their histograms', async () => {
    await viewer.go('threads');
    const thread = viewer.page.getByRole('region', { name: 'Thread motion' });
    await expect.poll(() => thread.getByRole('img').count(), { timeout: within }).toBe(2);
    await expect.poll(() => thread.innerText(), { timeout: within }).toMatch(/Releases\s+[1-9]/);
  });

  it('the log, narrowed by a filter', async () => {
    await viewer.takeControl();
    await viewer.go('units', 'fragile');
    await viewer.page.getByRole('button', { name: 'Initialise' }).click();
    await viewer.go('log');
    const lines = viewer.page.getByRole('log').getByRole('listitem');
    await expect.poll(() => lines.count(), { timeout: within }).toBeGreaterThan(0);
    await viewer.page.getByLabel('Filter').fill('surely not in any line');
    await viewer.page.getByText('No line is like this.').waitFor();
  });

  it('an image slot as it is made', async () => {
    await viewer.go('overview');
    const image = viewer.page.getByRole('img', { name: /^Camera/ });
    // The eighth bar is white, the first is black: read from what the browser decoded.
    await expect.poll(() => image.evaluate((one: HTMLImageElement) => {
      if (!one.complete || one.naturalWidth === 0) return [];
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [one.naturalWidth, one.naturalHeight];
      const context = canvas.getContext('2d')!;
      context.drawImage(one, 0, 0);
      const row = canvas.height / 2;
      const at = (part: number): number => context.getImageData(Math.floor(canvas.width * part), row, 1, 1).data[0]!;
      return [at(1 / 16) < 90, at(15 / 16) > 160];
    }), { timeout: within }).toEqual([true, true]);
  });
});

describe('a fault', () => {
  it('is shown with its cause and what to do, and can be put right', async () => {
    const running = await Application.start('panel_cell');
    const viewer = await Viewer.open(browser(), running.address);
    await viewer.takeControl();
    await viewer.go('units', 'fragile');
    await viewer.page.getByRole('button', { name: 'Drop it' }).click();
    await viewer.page.getByText('it was dropped').first().waitFor();
    await viewer.go('overview');
    await viewer.page.getByText('it was dropped').first().waitFor();
    await viewer.page.getByText(/What to do: /).waitFor();
    await screenshot(viewer.page, 'fault');
    expect(await violations(viewer.page)).toEqual([]);
    // Told in every view, and in the browser's tab.
    const strip = viewer.page.getByRole('link', { name: /1 fault, since \d\d:\d\d:\d\d: fragile: it was dropped/ });
    for (const view of ['devices', 'blackboard', 'search', 'threads', 'log']) {
      await viewer.go(view);
      await strip.waitFor();
    }
    await expect.poll(() => viewer.page.title(), { timeout: within }).toBe('✕ 1 fault · panel_cell – FlexRF panel');
    await strip.click();
    await viewer.page.getByRole('heading', { name: 'fragile' }).waitFor();
    await viewer.page.getByRole('button', { name: 'Initialise' }).click();
    const rest = running.rest();
    await expect.poll(async () => (await rest.do('components/fragile')).body.life, { timeout: within }).toBe('running');
    await viewer.page.getByText('No faults').waitFor();
    await expect.poll(() => viewer.page.title(), { timeout: within }).toBe('panel_cell – FlexRF panel');
    await viewer.close();
    expect(await running.stop()).toBe(2); // a fault that was survived is told
  });
});
