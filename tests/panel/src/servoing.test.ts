// The arm that picks what it sees: what a person reads of it, and does to it.
import { beforeEach, describe, expect, it } from 'vitest';
import type { Locator } from 'playwright-core';
import { Viewer, heldWithin, itemOf, screenshot, sizes, unlessKeptWaiting, useBrowser, useOperator, violations, within, type Rest, type Size } from './harness';

/** For what takes the arm a few ways. */
const forWays = 3 * within;

const browser = useBrowser();
const operator = useOperator(browser, 'visual-servoing', ['overview'], async ({ beside }) => {
  await beside.do('components/table/actions/press', { method: 'POST', body: { parameter: 'remove_obstacles', count: 1 } });
  await beside.do('components/table/parameters', { method: 'PUT', body: { cover_lens: false } });
});
let viewer: Viewer;
let rest: Rest;
beforeEach(() => { ({ viewer, rest } = operator); });

interface Picker {
  readonly state: string;
  readonly message: string;
  readonly remedy: string;
  readonly approaches: number;
}
const picker = (): Promise<Picker> => rest.feedback<Picker>('picker');
const read = async (label: string): Promise<string> => (await itemOf(viewer.page, label).first().locator('.value').innerText()).trim();
/** What is drawn of a row over the picture or around the arm: "3 drawn". */
const drawn = (widget: Locator, row: string): Promise<string> =>
  widget.locator('li').filter({ has: viewer.page.getByRole('checkbox', { name: row, exact: true }) }).locator('.state').innerText();

async function untilItSetsOut(): Promise<void> {
  const { approaches } = await picker();
  await expect.poll(async () => (await picker()).approaches, { timeout: forWays }).toBeGreaterThan(approaches);
}

describe('the overview', () => {
  it('tells what the picker does', async () => {
    await expect.poll(() => read('What it does'), { timeout: within }).toMatch(/^[A-Z].+\.$/);
    // As the unit says it, in each of its states.
    const states = new Set<string>();
    await expect.poll(async () => {
      const before = await picker();
      const [state, message] = [await read('Picker'), await read('What it does')];
      const after = await picker();
      if (before.state === after.state && before.message === after.message && state === before.state.replaceAll('_', ' ') && message === before.message) states.add(state);
      return states.size;
    }, { timeout: forWays }).toBeGreaterThanOrEqual(3);
  });

  it('shows the picture with what is followed, and the arm among it', async () => {
    const eye = viewer.page.locator('flexrf-widget-image');
    await expect.poll(() => drawn(eye, 'Followed'), { timeout: forWays }).toMatch(/[1-9]\d* drawn/);
    await expect.poll(() => eye.locator('.picture svg g[visibility="visible"]').count(), { timeout: forWays }).toBeGreaterThan(0);
    const cell = viewer.page.locator('flexrf-widget-robot');
    await cell.getByRole('img', { name: /in 3D/ }).waitFor();
    await expect.poll(() => drawn(cell, 'Seen'), { timeout: within }).toMatch(/^[1-9]\d* drawn/);
    await cell.getByText('Bodies as a table').click();
    // Of the twelve parts and four obstacles that lie there.
    await expect.poll(() => cell.getByRole('table', { name: /bodies/ }).getByRole('row').count(), { timeout: within }).toBeGreaterThan(4);
  });

  // The picker waits as long as a hand leads the arm.
  it('has a jog pad, which goes before the picker', async () => {
    const { page } = viewer;
    const arrow = page.locator('flexrf-widget-jog-pad').getByRole('button', { name: '+z', exact: true });
    await arrow.scrollIntoViewIfNeeded();
    await unlessKeptWaiting(page, rest, async () => {
      const box = (await arrow.boundingBox())!;
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
      await page.mouse.down();
      await expect.poll(async () => (await picker()).state, { timeout: heldWithin }).toBe('led_by_others');
      await expect.poll(() => read('What it does'), { timeout: heldWithin }).toContain('The arm is led by hand');
    }, () => page.mouse.up());
    await page.mouse.up();
    await untilItSetsOut();
  });

  for (const size of Object.keys(sizes) as Size[]) {
    it(`is accessible, and within the window, at the size of a ${size}`, async () => {
      const other = await Viewer.open(browser(), `${operator.running.base}/#/overview`, { size, touch: size === 'phone' });
      await other.page.getByRole('img', { name: /in 3D/ }).waitFor();
      await screenshot(other.page, 'servoing-overview');
      expect(await other.page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
      const found = await violations(other.page);
      await other.close();
      expect(found).toEqual([]);
    });
  }
});

describe('the table', () => {
  const toggle = () => viewer.page.getByRole('switch', { name: 'Cover the lens' });

  it('has a lens that is covered: the arm holds, and goes on by itself', async () => {
    await untilItSetsOut();
    await viewer.go('menu', 'Table');
    await toggle().click();
    await expect.poll(async () => (await picker()).state, { timeout: forWays }).toBe('no_sight');
    await viewer.go('overview');
    await expect.poll(() => read('What it does'), { timeout: within }).toContain('The camera tells nothing, the arm holds');
    expect(await read('What to do')).toContain('See to the camera');
    await screenshot(viewer.page, 'servoing-covered');
    // It brakes at first.
    await expect.poll(async () => (await rest.feedback<{ moving: boolean }>('robot')).moving, { timeout: within }).toBe(false);
    const place = async (): Promise<number[]> => (await rest.feedback<{ set_point: number[] }>('robot')).set_point;
    const before = await place();
    await new Promise((resolve) => setTimeout(resolve, 1000));
    expect(await place()).toEqual(before);
    await viewer.go('menu', 'Table');
    await toggle().click();
    await untilItSetsOut();
    await viewer.go('overview');
    await expect.poll(() => read('What it does'), { timeout: within }).not.toContain('The camera tells nothing');
  });

  it('tells who only looks on why a switch does nothing', async () => {
    const other = await Viewer.open(browser(), `${operator.running.base}/#/menu/Table`);
    const dead = other.page.getByRole('switch', { name: 'Cover the lens' });
    await dead.click({ force: true });
    await other.page.getByText('Locked: needs operator').waitFor();
    expect(await dead.isChecked()).toBe(false);
    await other.close();
  });

  it('says why a button did nothing', async () => {
    await viewer.go('menu', 'Table');
    const { page } = viewer;
    const obstacles = async (): Promise<number> => (await rest.feedback<{ obstacles: number }>('table')).obstacles;
    const remove = page.getByRole('button', { name: 'Remove added obstacles' });
    await remove.click();
    await expect.poll(() => read('Why the button did nothing'), { timeout: within }).toBe('none was added');
    await screenshot(page, 'servoing-table');
    expect(await violations(page)).toEqual([]);
    const before = await obstacles();
    const x = page.getByRole('textbox', { name: 'Place on the table 0' }); // behind the arm, where nothing stands
    await x.fill('-900');
    await x.press('Enter');
    await expect.poll(async () => ((await rest.runtime('table'))['place'] as number[])[0], { timeout: within }).toBeCloseTo(-0.9, 9);
    await page.getByRole('button', { name: 'Add an obstacle' }).click();
    await expect.poll(obstacles, { timeout: within }).toBe(before + 1);
    await expect.poll(() => read('Why the button did nothing'), { timeout: within }).toBe('');
    await remove.click();
    await expect.poll(obstacles, { timeout: within }).toBe(before);
  });
});

describe("evolution's page", () => {
  it('shows how the members of attention do, and who works when', async () => {
    await viewer.go('units', 'evolution');
    const { page } = viewer;
    const members = page.locator('flexrf-widget-population');
    await expect.poll(() => members.getByRole('row').count(), { timeout: within }).toBe(17); // with the head
    const first = members.getByRole('row', { name: /attention\[0\]/ });
    await expect.poll(() => first.innerText(), { timeout: within }).toMatch(/no\. \d+[^]*\d+\.\d\d/);
    expect(await first.locator('.bar > i').count()).toBe(10);
    const work = page.locator('flexrf-widget-timeline');
    await work.getByText(/Last 10 frames, [\d.]+ m?s: each begins with a step of features/).waitFor();
    for (const name of ['attention\\[0\\]', 'recognition\\[0\\]'])
      await work.getByRole('img', { name: new RegExp(`^${name}: [1-9]\\d* steps`) }).waitFor();
    await screenshot(page, 'servoing-evolution');
    await work.scrollIntoViewIfNeeded();
    await screenshot(page, 'servoing-timeline');
    expect(await violations(page)).toEqual([]);
  });

  it('freezes them', async () => {
    await viewer.go('units', 'evolution');
    const freeze = viewer.page.locator('flexrf-widget-population').getByRole('switch', { name: 'Freeze' });
    await freeze.click();
    await expect.poll(async () => (await rest.runtime('evolution'))['frozen'], { timeout: within }).toBe(true);
    await freeze.click();
    await expect.poll(async () => (await rest.runtime('evolution'))['frozen'], { timeout: within }).toBe(false);
  });
});
