// Who did what, and what a command needs: as a person reads it.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { beforeAll, expect, it, onTestFinished } from 'vitest';
import {
  Application, Viewer, screenshot, useApplication, useBrowser, violations, within, type Rest, type User,
} from './harness';

const anna: User = { name: 'anna', role: 'engineer', password: 'a long password of anna' };
const adam: User = { name: 'adam', role: 'admin', password: 'a long password of adam' };

const browser = useBrowser();
const application = useApplication('panel_cell');

let admin: Rest; // the printed address is good once
beforeAll(async () => { admin = await application().admin(); });

async function open(address: string, user?: User): Promise<Viewer> {
  const viewer = await Viewer.open(browser(), address);
  onTestFinished(() => viewer.close());
  viewer.allow(/401|WebSocket/); // before the log-in
  if (user) await viewer.logIn(user);
  return viewer;
}

it('an admin reads who did what, others do not', async () => {
  const running = await Application.start('panel_cell', { users: [anna, adam], arguments: ['--audit', 'audit'] });
  onTestFinished(() => running.end());
  const rest = await running.loggedIn(anna);
  await rest.do('control/take', { method: 'POST' });
  await rest.do('components/gadget/parameters', { method: 'PUT', body: { level: 4 } });
  await rest.do('components/gadget/actions/press', { method: 'POST', body: { parameter: 'knock', count: 2 } });
  await rest.do('stop-motion', { method: 'POST' });
  expect((await rest.ask('audit')).status).toBe(403);

  const engineer = await open(running.base, anna);
  await engineer.page.getByText(/by anna \(127\.0\.0\.1\) at \d\d:\d\d:\d\d/).waitFor();
  await expect.poll(() => engineer.page.getByRole('link', { name: 'Log', exact: true }).count(), { timeout: within }).toBe(1);
  expect(await engineer.page.getByRole('link', { name: 'Audit' }).count()).toBe(0);
  await screenshot(engineer.page, 'stopped-by');

  const reader = await open(running.base, adam);
  await reader.page.getByRole('link', { name: 'Audit' }).click();
  const row = (text: string | RegExp) => reader.page.getByRole('row').filter({ hasText: text }).first();
  await row(/anna \(127\.0\.0\.1\)\s*logged in/).waitFor();
  await row('changed gadget.level').waitFor();
  await row('pressed gadget.knock (2 times)').waitFor();
  await row(/anna \(127\.0\.0\.1\)\s*stopped motion/).waitFor();
  await screenshot(reader.page, 'audit');
  expect(await violations(reader.page)).toEqual([]);
  await reader.page.getByLabel('Filter').fill('anna level');
  await expect.poll(() => reader.page.locator('flexrf-audit tbody tr').count(), { timeout: within }).toBe(1);
  const file = readFileSync(join(running.folder, 'audit'), 'utf8');
  expect(file).toMatch(/"who":"anna \(127\.0\.0\.1\)","did":"changed","what":"gadget\.level","before":[\d.]+,"after":4\}/);
  expect(file).not.toContain(anna.password);
});

it('a button that could do nothing is dead and says what it needs, and a script is told the same', async () => {
  const running = application();
  const viewer = await Viewer.open(browser(), running.base, { session: admin.cookie });
  onTestFinished(async () => {
    await viewer.close();
    await admin.do('components/gadget/actions/reset', { method: 'POST' });
    await admin.do('control/release', { method: 'POST' });
    await admin.do('stop-motion', { method: 'POST' });
  });
  await viewer.takeControl();
  await viewer.go('units', 'gadget');
  const { page } = viewer;
  const ring = page.getByRole('button', { name: 'Ring', exact: true });
  const need = page.locator('.need').filter({ hasText: 'needs enabled to be on' });
  await need.waitFor();
  expect(await ring.isDisabled()).toBe(true);
  await ring.scrollIntoViewIfNeeded();
  await screenshot(page, 'needs');
  expect(await violations(page)).toEqual([]);
  const refused = await admin.ask('components/gadget/actions/press', { method: 'POST', body: { parameter: 'ring' } });
  expect(refused.status).toBe(409);
  expect(refused.body).toMatchObject({ type: '/problems/wrong-state', parameter: 'ring', reason: 'needs enabled to be on' });
  await admin.do('components/gadget/parameters', { method: 'PUT', body: { enabled: true } });
  await expect.poll(() => ring.isEnabled(), { timeout: within }).toBe(true);
  await ring.click();
  await admin.do('components/gadget/actions/press', { method: 'POST', body: { parameter: 'ring' } });
  await expect.poll(() => need.count(), { timeout: within }).toBe(0);
  // A hold needs the permission to move.
  await viewer.go('units', 'mover');
  const move = page.locator('flexrf-item').getByRole('button', { name: 'Forward', exact: true });
  await page.getByText('Dead: motion is inhibited: give Start motion').first().waitFor();
  expect(await move.isDisabled()).toBe(true);
  await admin.do('start-motion', { method: 'POST' });
  await expect.poll(() => move.isEnabled(), { timeout: within }).toBe(true);
});
