// What comes and goes by itself moves nothing that a finger may be on its way to.
import { expect, describe, it } from 'vitest';
import type { Page } from 'playwright-core';
import {
  Application, Viewer, screenshot, sizes, tidyUp, useApplication, useBrowser, violations, within, type Rest, type Size,
} from './harness';

const browser = useBrowser();

/** Where each thing of these is, by its name. */
function places(page: Page, selector: string): Promise<{ [name: string]: string }> {
  return page.locator(selector).evaluateAll((all) => Object.fromEntries(all.map((one, index) => {
    const box = one.getBoundingClientRect();
    const name = one.getAttribute('aria-label') ?? one.querySelector('h3')?.textContent ?? one.textContent ?? '';
    return [`${index} ${one.localName} ${name.replace(/\d[^]*/, '').trim()}`, `${Math.round(box.y)} + ${Math.round(box.height)}`];
  })));
}

describe('the header, whatever it says', () => {
  const application = useApplication('panel_cell');
  let admin: Rest | undefined; // the token serves once

  for (const size of Object.keys(sizes) as Size[]) {
    it(`at the size of a ${size}`, async () => {
      const running = application();
      admin ??= await running.admin();
      const script = admin;
      const viewers: Viewer[] = [];
      try {
        for (const session of [script.cookie, undefined]) {
          viewers.push(await Viewer.open(browser(), running.base, { size, ...(session && { session }) }));
        }
        const seen: { [state: string]: number[] } = {};
        const note = async (state: string, text: string | RegExp): Promise<void> => {
          for (const { page } of viewers) await page.locator('flexrf-header').getByText(text).first().waitFor();
          await Promise.all(viewers.map((viewer) => screenshot(viewer.page, `header-${state}-${viewers.indexOf(viewer)}`)));
          seen[state] = await Promise.all(viewers.map(({ page }) => page.locator('main').evaluate((main) => main.getBoundingClientRect().y)));
        };
        const act = (op: string): Promise<unknown> => script.do(op, { method: 'POST' });
        await note('nobody', 'Nobody has control');
        await act('control/take');
        await note('taken', / has control|You have control/);
        await act('start-motion');
        await note('enabled', 'Motion enabled');
        await act('stop-motion');
        await note('stopped', 'Motion stopped');
        await act('clear-stop-motion');
        await note('inhibited', 'Motion inhibited');
        await act('control/release');
        await note('released', 'Nobody has control');
        const first = seen['nobody'];
        expect(seen).toEqual(Object.fromEntries(Object.keys(seen).map((state) => [state, first])));
      } finally {
        await tidyUp(...viewers.map((viewer) => () => viewer.close()));
      }
    });
  }
});

it('a fault on the Overview', async () => {
  const broken = await Application.start('panel_cell');
  let viewer: Viewer | undefined;
  let how: unknown;
  try {
    const script = await broken.admin();
    viewer = await Viewer.open(browser(), broken.base, { session: script.cookie });
    const { page } = viewer;
    const cards = (): Promise<{ [name: string]: string }> => places(page, 'flexrf-overview section');
    await script.do('control/take', { method: 'POST' });
    await page.getByText('You have control').waitFor();
    await page.locator('flexrf-overview flexrf-widget-slider').waitFor();
    const picture = page.locator('flexrf-widget-image img');
    await expect.poll(() => picture.evaluate((image: HTMLImageElement) => image.complete && image.naturalWidth > 0), { timeout: within }).toBe(true);
    const before = await cards();
    await script.do('components/fragile/actions/press', { body: { parameter: 'drop' } });
    await page.locator('flexrf-overview').getByRole('alert').getByText('it was dropped').waitFor();
    await screenshot(page, 'overview-fault');
    expect(await cards()).toMatchObject(before);
    expect(await violations(page)).toEqual([]);
  } finally {
    await tidyUp(() => viewer?.close(), async () => { how = await broken.stop(); });
  }
  expect(how).toBe(2); // a fault that was survived is told
});

describe('values that are no more', () => {
  const application = useApplication('panel_cell');
  let admin: Rest | undefined;

  const views: readonly (readonly [Size, string, string])[] = (Object.keys(sizes) as Size[]).flatMap((size) => [
    [size, 'units/gadget', 'flexrf-component-page :is(h3, flexrf-item, flexrf-placement)'],
    [size, 'blackboard/sample', 'flexrf-blackboard :is(.detail p, .inside > div > *)'],
  ] as const);
  it.each(views)('at the size of a %s: %s', async (size, view, things) => {
    const running = application();
    admin ??= await running.admin();
    const script = admin;
    const viewer = await Viewer.open(browser(), `${running.base}/#/${view}`, { size, session: script.cookie });
    const { page } = viewer;
    try {
      await script.do('control/take', { method: 'POST' });
      await page.getByText('You have control').waitFor();
      const absent = page.locator('#absence').filter({ hasText: /./ });
      const main = page.locator('main');
      await page.locator('flexrf-widget-slider, flexrf-widget-number').first().waitFor();
      await expect.poll(() => absent.count(), { timeout: within }).toBe(0);
      // What is scrolled away has its size once it was seen.
      await main.evaluate(async (view) => {
        for (let top = 0; top < view.scrollHeight; top += view.clientHeight / 2) {
          view.scrollTop = top;
          await new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); });
        }
        view.scrollTop = 0;
      });
      const before = await places(page, things);
      expect(Object.keys(before).length).toBeGreaterThan(4);
      await script.do('components/gadget/actions/stop', { method: 'POST' });
      await expect.poll(() => absent.count(), { timeout: within }).toBeGreaterThan(0);
      await screenshot(page, `absent-${view.replace('/', '-')}`);
      expect(await places(page, things)).toEqual(before);
      expect(await violations(page)).toEqual([]);
    } finally {
      await tidyUp(
        () => script.do('components/gadget/actions/start', { method: 'POST' }),
        () => script.do('control/release', { method: 'POST' }), () => viewer.close());
    }
  });
});
