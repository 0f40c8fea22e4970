// The link: what is old looks old, what comes back is whole, and another start is told from a short break.
import type { Page } from 'playwright-core';
import { afterEach, beforeEach, expect, it } from 'vitest';
import { Application, Cable, Viewer, itemOf, useBrowser, screenshot, tidyUp, violations, within } from './harness';

const browser = useBrowser();

let running: Application;
let viewer: Viewer;
beforeEach(async () => { running = await Application.start('panel_cell'); });
afterEach(async () => {
  await tidyUp(() => viewer?.close(), () => running.end());
});

const oldValues = () => viewer.page.getByText('Values are old, controls are dead');
const level = () => itemOf(viewer.page, 'Level of it').first();

async function open(address: string): Promise<void> {
  viewer = await Viewer.open(browser(), address);
  viewer.allow(/WebSocket|Failed to load resource|ERR_/);
  await viewer.takeControl();
  await viewer.go('units', 'gadget');
  await expect.poll(() => level().getByRole('slider').isEnabled(), { timeout: within }).toBe(true);
}

it('an application that is stopped: grey values, dead controls, and back again', async () => {
  await open(running.address);
  const { page } = viewer;
  running.process.kill('SIGSTOP');
  await oldValues().waitFor();
  await expect.poll(() => level().getByRole('slider').isEnabled(), { timeout: within }).toBe(false);
  expect(await page.locator('[stale]').count()).toBeGreaterThan(0);
  expect(await page.getByRole('button', { name: 'Stop motion' }).getAttribute('aria-disabled')).toBe('true');
  await page.getByText('use the emergency stop at the machine').waitFor();
  await screenshot(page, 'stale');
  expect(await violations(page)).toEqual([]);
  running.process.kill('SIGCONT');
  await oldValues().waitFor({ state: 'hidden' });
  await expect.poll(() => page.locator('[stale]').count(), { timeout: within }).toBe(0);
  expect(await page.getByRole('button', { name: 'Stop motion' }).getAttribute('aria-disabled')).toBe('false');
});

/** Each view, and what of it shows values. */
const values: readonly (readonly [string, string])[] = [
  ['overview', 'flexrf-overview :is(dd, [role=alert] h3, [role=alert] p:not(.muted))'],
  ['units', 'flexrf-component-list :is(td .state, .box .alarm)'],
  ['units/fragile', 'flexrf-component-page :is(strong, [role=alert] dd, dl:not([role] *) > dd)'],
  ['units/worker%5B0%5D', 'flexrf-component-page #members + table td'],
  ['devices', 'flexrf-component-list td .state'],
  ['threads', 'flexrf-threads td.number'],
  ['blackboard', 'flexrf-blackboard td.number'],
];

/** Colours of what a selector finds, as they differ from that of old values. */
function colours(page: Page, selector: string): Promise<string[]> {
  return page.locator(selector).evaluateAll((found) => {
    const probe = document.body.appendChild(document.createElement('i'));
    probe.style.color = 'var(--flexrf-stale)';
    const old = getComputedStyle(probe).color;
    probe.remove();
    return found.map((one) => getComputedStyle(one).color).map((colour) => (colour === old ? 'old' : colour));
  });
}

it('an application that is stopped: no view shows its values as new', async () => {
  const broken = await Application.start('panel_cell');
  let how: unknown;
  try {
    await open(broken.address);
    await viewer.go('units', 'fragile');
    await viewer.page.getByRole('button', { name: 'Drop it' }).click();
    await viewer.page.getByText('it was dropped').first().waitFor();
    const pages: (readonly [string, string, Page])[] = [];
    for (const [view, selector] of values) {
      const page = await viewer.context.newPage();
      await page.goto(`${broken.base}/#/${view}`);
      await page.locator(selector).first().waitFor();
      pages.push([view, selector, page]);
    }
    const seen = (): Promise<(readonly [string, string[]])[]> => Promise.all(
      pages.map(async ([view, selector, page]) => [view, [...new Set(await colours(page, selector))]] as const));
    const old = values.map(([view]) => [view, ['old']]);
    await expect.poll(async () => (await seen()).filter(([, all]) => all.length === 0 || all.includes('old')), { timeout: within }).toEqual([]);
    broken.process.kill('SIGSTOP');
    await expect.poll(seen, { timeout: within }).toEqual(old);
    broken.process.kill('SIGCONT');
    await expect.poll(async () => (await seen()).filter(([, all]) => all.includes('old')), { timeout: within }).toEqual([]);
  } finally {
    how = await broken.stop();
  }
  expect(how).toBe(2); // a fault that was survived is told
});

it('a robot that says nothing: its joints are grey, too', async () => {
  await running.rest().do('session'); // the address is printed a little before a signal ends it as an application ends
  await running.end();
  running = await Application.start('keyboard');
  viewer = await Viewer.open(browser(), running.address);
  viewer.allow(/WebSocket|Failed to load resource|ERR_/);
  await viewer.page.getByText('Joints as a table').click();
  const cells = 'flexrf-widget-robot td.number';
  await expect.poll(() => viewer.page.locator(cells).count(), { timeout: within }).toBe(6);
  await expect.poll(() => colours(viewer.page, cells), { timeout: within }).not.toContain('old');
  running.process.kill('SIGSTOP');
  await expect.poll(async () => new Set(await colours(viewer.page, cells)), { timeout: within }).toEqual(new Set(['old']));
});

it('a cable that is cut and mended: everything is as it is now', async () => {
  const cable = await Cable.to(running.port);
  await open(running.address.replace(running.base, cable.base));
  cable.cut();
  await oldValues().waitFor();
  // Changed meanwhile, beside the cable, by the same session.
  const rest = running.rest();
  rest.cookie = (await viewer.context.cookies()).map((one) => `${one.name}=${one.value}`).join('; ');
  const taken = await rest.ask('control/take', { method: 'POST' });
  expect(taken.status).toBeLessThan(300);
  await rest.do('components/gadget/parameters', { method: 'PUT', body: { level: 8 } });
  cable.mend();
  await oldValues().waitFor({ state: 'hidden' });
  await expect.poll(async () => Number(await level().getByRole('spinbutton').inputValue()), { timeout: within }).toBe(8);
  await viewer.page.getByRole('button', { name: 'Knock' }).waitFor();
  await viewer.close();
  await cable.close();
  viewer = await Viewer.open(browser(), running.base);
});

it('the same application started anew under an open page', async () => {
  await open(running.address);
  const { port } = running;
  await viewer.page.getByRole('button', { name: 'Start motion' }).click();
  await viewer.page.locator('flexrf-header').getByText('Motion enabled').waitFor();
  await running.end();
  await viewer.page.getByText('The application ended').or(oldValues()).first().waitFor();
  // What may move no longer is said to be so.
  await viewer.page.locator('flexrf-header').getByText(/Motion (ended|not known)$/).waitFor();
  await expect.poll(() => viewer.page.title(), { timeout: within }).toMatch(/^(Ended|⚠ No connection) · panel_cell/);
  running = await Application.start('panel_cell', { listen: `127.0.0.1:${port}` });
  await oldValues().waitFor({ state: 'hidden' });
  await viewer.page.getByText('The application was started anew.').waitFor();
  // The session of before is nobody's: what one sees is as of a new visitor.
  await viewer.page.getByText(/: viewer/).waitFor();
  await viewer.page.getByText('Nobody has control').waitFor();
  await expect.poll(async () => Number(await level().getByRole('spinbutton').inputValue()), { timeout: within }).toBe(5);
});

it('another application at the same address', async () => {
  await open(running.address);
  const { port } = running;
  await running.end();
  running = await Application.start('keyboard', { listen: `127.0.0.1:${port}` });
  await expect.poll(() => viewer.page.title(), { timeout: within }).toContain('keyboard');
  await viewer.page.getByText('There is no unit of this name').waitFor();
  await viewer.go('overview');
  await viewer.page.getByText('Jog step').first().waitFor();
});
