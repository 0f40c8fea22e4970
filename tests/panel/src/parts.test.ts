// Parts of the page come in files of their own: one that does not come is told where it belongs, and can be tried again.
import { afterEach, expect, it } from 'vitest';
import { Application, Viewer, screenshot, tidyUp, useBrowser, violations, within, type ApplicationName } from './harness';

const browser = useBrowser();

let running: Application;
let viewers: Viewer[] = [];
afterEach(async () => {
  await tidyUp(...viewers.map((viewer) => () => viewer.close()), () => running.end());
  viewers = [];
});

async function open(address: string): Promise<Viewer> {
  const viewer = await Viewer.open(browser(), address);
  viewer.allow(/Failed to load resource/); // what a test keeps away
  viewers.push(viewer);
  return viewer;
}

async function start(name: ApplicationName, given: readonly string[] = []): Promise<Viewer> {
  running = await Application.start(name, { arguments: given });
  const viewer = await open(running.address);
  await viewer.takeControl();
  return viewer;
}

/** Another build has no such file; the returned function brings it back. */
async function keepAway(viewer: Viewer, ...files: readonly RegExp[]): Promise<() => Promise<void>> {
  for (const file of files) await viewer.page.route(file, (route) => route.fulfill({ status: 404, body: 'no such file' }));
  return async () => { for (const file of files) await viewer.page.unroute(file); };
}

it('a view: what else the page holds stays as it is', async () => {
  const viewer = await start('panel_cell');
  const { page } = viewer;
  await page.evaluate(() => { (window as unknown as { same: boolean }).same = true; });
  const bringBack = await keepAway(viewer, /\/assets\/threads-/);
  await page.getByRole('link', { name: 'Threads' }).click();
  await page.getByText('“Threads” cannot be shown: it could not be loaded.').waitFor();
  await page.getByRole('button', { name: 'Load the page again' }).waitFor();
  await screenshot(page, 'view-missing');
  expect(await violations(page)).toEqual([]);
  await page.getByRole('button', { name: 'Try again' }).click();
  await page.getByText('“Threads” cannot be shown').waitFor(); // still
  await page.getByText('You have control').waitFor();
  await bringBack();
  await page.getByRole('button', { name: 'Try again' }).click();
  await page.getByRole('heading', { name: 'Threads', level: 2 }).waitFor();
  expect(await page.getByText('cannot be shown').count()).toBe(0);
  await page.getByText('You have control').waitFor();
  expect(await page.evaluate(() => (window as unknown as { same?: boolean }).same)).toBe(true); // it was not loaded anew
});

it('a view that is left for another is not missed', async () => {
  const viewer = await start('panel_cell');
  const { page } = viewer;
  await keepAway(viewer, /\/assets\/threads-/);
  await page.getByRole('link', { name: 'Threads' }).click();
  await page.getByText('“Threads” cannot be shown').waitFor();
  await page.getByRole('link', { name: 'Log' }).click();
  await page.getByRole('heading', { name: 'Log', level: 2 }).waitFor();
  expect(await page.getByText('cannot be shown').count()).toBe(0);
});

it('widgets and a button beside fields: all come with one press, and what is typed stays', async () => {
  running = await Application.start('keyboard', { arguments: ['--config', 'values.xml'] });
  const viewer = await open(running.address);
  const bringBack = await keepAway(viewer, /\/assets\/values_saver-/, /\/application\/widgets\/jog_arrows\.js/, /\/assets\/scene-/);
  await viewer.page.reload();
  await viewer.takeControl();
  const { page } = viewer;
  await page.getByText('Jog cannot be shown').waitFor();
  await page.getByText('“Save now” cannot be shown').waitFor();
  await page.getByText('No 3D view: it could not be loaded').waitFor();
  await screenshot(page, 'widgets-missing');
  // The check holds the page up, for 10 s on a busy machine. Then the link is silent, controls are locked, and what is typed is dropped.
  expect(await violations(page)).toEqual([]);
  const field = page.getByRole('spinbutton', { name: 'Jog step' });
  await expect.poll(() => field.isEnabled(), { timeout: within }).toBe(true);
  await field.fill('25');
  await bringBack();
  await page.locator('flexrf-missing').getByRole('button', { name: 'Try again' }).first().click();
  await page.getByRole('button', { name: 'Save now' }).waitFor();
  await page.locator('flexrf-widget-jog-arrows').waitFor();
  await expect.poll(() => page.locator('flexrf-missing').count(), { timeout: within }).toBe(0);
  await expect.poll(() => field.inputValue(), { timeout: within }).toBe('25.0');
  await page.locator('flexrf-widget-robot').getByRole('button', { name: 'Try again' }).click();
  await page.getByRole('img', { name: /in 3D/ }).waitFor();
});

it('all that controls need: a later try brings the controls', async () => {
  running = await Application.start('panel_cell');
  const viewer = await open(`${running.address}#/log`);
  const bringBack = await keepAway(viewer, /\/assets\/further-/);
  await viewer.page.goto(`${running.base}/#/units/gadget`);
  await viewer.page.reload();
  await viewer.takeControl();
  const { page } = viewer;
  await page.getByText('Level of it cannot be shown').first().waitFor();
  await bringBack();
  await page.getByRole('button', { name: 'Try again' }).first().click();
  await page.getByRole('slider', { name: 'Level of it' }).first().waitFor();
  await expect.poll(() => page.locator('flexrf-missing').count(), { timeout: within }).toBe(0);
});

it('a dialog: its button tries again', async () => {
  const viewer = await start('panel_cell');
  const { page } = viewer;
  const bringBack = await keepAway(viewer, /\/assets\/settings-/);
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByText('The dialog cannot be shown').waitFor();
  await bringBack();
  await page.getByRole('button', { name: 'Settings' }).click();
  await page.getByRole('dialog', { name: 'Settings' }).waitFor();
});

it('the question to the holder of control: that it cannot be shown is told, and it is tried by itself', async () => {
  running = await Application.start('panel_cell');
  const viewer = await open(running.address);
  const { page } = viewer;
  const bringBack = await keepAway(viewer, /\/assets\/consent-/);
  await viewer.takeControl();
  await page.getByText('Who asks for control cannot be shown').waitFor();
  await bringBack();
  await page.locator('flexrf-consent').waitFor({ state: 'attached' });
});
