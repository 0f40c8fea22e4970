// A population whose members compete, and a queue whose jobs wait by score: how they do, who works when, what waits.
import { beforeEach, describe, expect, it } from 'vitest';
import type { Locator } from 'playwright-core';
import { Viewer, screenshot, sizes, useBrowser, useOperator, violations, within, type Rest, type Size } from './harness';

const browser = useBrowser();
const fetchers = ['fetcher[0]', 'fetcher[1]'].map(encodeURIComponent);

const operator = useOperator(browser, 'contest', ['overview'], async ({ beside }) => {
  for (const name of ['judge', ...fetchers]) await beside.do(`components/${name}/actions/reset`, { method: 'POST' });
});
let viewer: Viewer;
let rest: Rest;
let beside: Rest;
beforeEach(() => { ({ viewer, rest, beside } = operator); });

const population = (): Locator => viewer.page.locator('flexrf-widget-population');
const timeline = (): Locator => viewer.page.locator('flexrf-widget-timeline');
const memberRow = (name: string): Locator => population().getByRole('row', { name });

describe('a population', () => {
  it('has a row for each member, with what it is worth and its weights', async () => {
    await expect.poll(() => population().getByRole('row').count(), { timeout: within }).toBe(5); // with the head
    await expect.poll(() => memberRow('runner[2]').innerText(), { timeout: within }).toMatch(/no\. 2, child of 1[^]*trial, fresh[^]*300\.0[^]*1\.50[^]*−0\.50/);
    expect(await memberRow('runner[3]').innerText()).toContain('not active');
    const bars = memberRow('runner[1]').locator('.bar > i');
    expect(await bars.evaluateAll((all) => all.map((bar) => (bar as HTMLElement).style.transform))).toEqual([
      'translateX(0%) scaleX(0.5)', 'translateX(37.5%) scaleX(0.125)',
    ]);
  });

  it('draws how each did over rounds, until they are frozen', async () => {
    const line = (): Promise<string | null> => memberRow('runner[0]').locator('svg path').getAttribute('d');
    await expect.poll(async () => (await line())?.split('L').length, { timeout: within }).toBeGreaterThan(3);
    await population().getByRole('switch', { name: 'Freeze' }).click();
    await expect.poll(async () => (await rest.runtime('judge'))['frozen'], { timeout: within }).toBe(true);
    const round = async (): Promise<number> => (await rest.do('slots/standing')).body.value.round;
    const frozenAt = await round();
    await new Promise((resolve) => setTimeout(resolve, 500));
    expect(await round()).toBe(frozenAt);
  });

  it('has the buttons of whoever judges', async () => {
    const saved = async (): Promise<number> => (await rest.feedback<{ saved: number }>('judge')).saved;
    const before = await saved();
    await population().getByRole('button', { name: 'Save them' }).click();
    await expect.poll(saved, { timeout: within }).toBe(before + 1);
  });

  it('shows who came and who went', async () => {
    const runner = encodeURIComponent('runner[3]');
    await beside.do(`components/${runner}/actions/activate`, { method: 'POST' });
    await expect.poll(() => memberRow('runner[3]').innerText(), { timeout: within }).toContain('fresh');
    await beside.do(`components/${runner}/actions/retire`, { method: 'POST' });
    await expect.poll(() => memberRow('runner[3]').innerText(), { timeout: within }).toContain('not active');
  });

  it('leads to the page of a member', async () => {
    await population().getByRole('link', { name: 'runner[1]' }).click();
    await viewer.page.getByRole('heading', { name: 'runner[1]' }).waitFor();
  });
});

describe('a timeline', () => {
  it('shows who worked when over the last frames, what came of it, and what back-off learned', async () => {
    await timeline().getByText(/Last 10 frames, [\d.]+ ms: each begins with a step of pulse/).waitFor();
    for (const name of ['runner[0]', 'fetcher[0]', 'judge']) {
      const bar = timeline().getByRole('img', { name: new RegExp(`^${name.replace(/[[\]]/g, '\\$&')}: [1-9]\\d* steps, [\\d.]+ [mµ]s per frame$`) });
      await bar.waitFor();
      expect(await bar.locator('.busy').getAttribute('d')).toMatch(/^M/);
    }
    await timeline().getByRole('img', { name: 'runner[3]: 0 steps, 0 ms per frame' }).waitFor();
    const row = timeline().getByRole('row', { name: 'fetcher[0]' });
    await expect.poll(() => row.innerText(), { timeout: within }).toMatch(/\d+\s+fresh\s+[\d.]+ [mµ]s ± [\d.]+ [mµ]s/);
    await screenshot(viewer.page, 'contest-timeline');
  });
});

describe('a queue by score', () => {
  it('shows how many jobs wait, and their scores', async () => {
    for (const name of fetchers) await beside.do(`components/${name}/parameters`, { method: 'PUT', body: { rests: true } });
    await viewer.go('blackboard');
    const row = viewer.page.getByRole('row').filter({ has: viewer.page.getByRole('rowheader', { name: 'errands' }) });
    await expect.poll(() => row.getByRole('cell').first().innerText(), { timeout: within }).toBe('8');
    const bars = row.getByRole('img', { name: /^urgency of what waits: [\d.]+/ });
    await bars.waitFor();
    await bars.scrollIntoViewIfNeeded();
    expect((await bars.locator('path').getAttribute('d'))!.match(/M/g)).toHaveLength(8);
    await screenshot(viewer.page, 'contest-queue');
    for (const name of fetchers) await beside.do(`components/${name}/parameters`, { method: 'PUT', body: { rests: false } });
    await expect.poll(async () => Number(await row.getByRole('cell').first().innerText()), { timeout: within }).toBeLessThan(8);
  });
});

describe('both', () => {
  for (const size of Object.keys(sizes) as Size[]) {
    it(`are accessible, and within the window, at the size of a ${size}`, async () => {
      const other = await Viewer.open(browser(), operator.running.base, { size, touch: size === 'phone' });
      await other.go('overview');
      await other.page.getByText(/Last 10 frames/).waitFor();
      await other.page.getByText('trial, fresh').waitFor();
      await screenshot(other.page, 'contest-overview');
      expect(await other.page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
      const found = await violations(other.page);
      await other.close();
      expect(found).toEqual([]);
    });
  }
});
