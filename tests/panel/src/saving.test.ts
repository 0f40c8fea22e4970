// Save now: what a person has set survives a loss of power, and the page says how it stands with that.
import { mkdirSync, readFileSync, rmdirSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { expect, it, onTestFinished } from 'vitest';
import { Application, Viewer, newFolder, useBrowser, violations, within } from './harness';

const browser = useBrowser();

it('is saved now, says so, says why not, and is there after the next start', async () => {
  const folder = newFolder();
  onTestFinished(() => rmSync(folder, { recursive: true, force: true }));
  const file = join(folder, 'cell.xml');
  const start = (): Promise<Application> => Application.start('panel_cell', { arguments: ['--config', file] });
  const first = await start();
  const viewer = await Viewer.open(browser(), first.address);
  await viewer.go('overview');
  const card = viewer.page.locator('flexrf-values-saver');
  const button = card.getByRole('button', { name: 'Save now' });
  await card.getByText('Nothing was changed since the start.').waitFor();
  expect(await button.getAttribute('aria-disabled')).toBe('true'); // without control

  await viewer.takeControl();
  const beside = await viewer.script();
  await beside.do('components/gadget/parameters', { method: 'PUT', body: { level: 6.5 } });
  await button.click();
  await card.getByText(/^Saved at /).waitFor();
  expect(readFileSync(file, 'utf8')).toContain('6.5</level>');
  expect(await violations(viewer.page)).toEqual([]);

  mkdirSync(`${file}.new`); // in the way of what is written beside the file
  await beside.do('components/gadget/parameters', { method: 'PUT', body: { level: 7.5 } });
  await button.click();
  await card.getByText(/^✕ Not saved: cannot create/).waitFor();
  rmdirSync(`${file}.new`);
  await button.click();
  await card.getByText(/^Saved at /).waitFor();

  viewer.allow(/./); // the server goes without a word
  expect(await first.stop('SIGKILL')).toBe('SIGKILL');
  await viewer.close();
  const second = await start();
  onTestFinished(() => second.end());
  await expect.poll(async () => (await second.rest().runtime('gadget'))['level'], { timeout: within }).toBe(7.5);
});
