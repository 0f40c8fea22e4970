// Values: set and read back from the unit, refused, seen by others, left alone while a hand is on them.
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import type { Locator } from 'playwright-core';
import { Viewer, itemOf, screenshot, useBrowser, useOperator, violations, within, type Rest } from './harness';

const browser = useBrowser();

const operator = useOperator(browser, 'panel_cell', ['units', 'gadget'], async ({ beside }) => {
  await beside.do('components/gadget/actions/reset', { method: 'POST' });
  if ((await beside.do('state')).body.motion.stopped) await beside.do('clear-stop-motion', { method: 'POST' });
});
let viewer: Viewer;
let rest: Rest;
beforeEach(() => { ({ viewer, rest } = operator); });

function item(label: string, of: Viewer = viewer): Locator {
  return itemOf(of.page, label).first();
}
function field(label: string, of: Viewer = viewer): Locator {
  return item(label, of).getByRole('spinbutton');
}
async function expectShown(level: number, of: Viewer = viewer): Promise<void> {
  await expect.poll(async () => Number(await field('Level of it', of).inputValue()), { timeout: within }).toBe(level);
}
async function expectRuntime(path: string, value: unknown): Promise<void> {
  await expect.poll(async () => (await rest.runtime('gadget'))[path], { timeout: within }).toEqual(value);
}
async function knocks(): Promise<number> {
  return (await rest.feedback<{ knocks: number }>('gadget')).knocks;
}
async function expectFeedback(path: string, value: unknown): Promise<void> {
  await expect.poll(async () => (await rest.feedback<{ [path: string]: unknown }>('gadget'))[path], { timeout: within }).toEqual(value);
}

describe('a number with a range', () => {
  it('is set by typing, and what the unit has in force comes back', async () => {
    await field('Level of it').fill('6.25');
    await field('Level of it').press('Enter');
    await expectFeedback('level', 6.25);
    await expectShown(6.25);
  });

  it('is refused outside of its range, and shows what is in force again', async () => {
    await field('Level of it').fill('11');
    await field('Level of it').press('Enter');
    await expect.poll(() => item('Level of it').getByRole('status').innerText(), { timeout: within }).toMatch(/10/);
    await expectShown(5);
    await expectRuntime('level', 5);
  });

  it('is refused by the unit with its reason', async () => {
    await field('Level of it').fill('9.5');
    await field('Level of it').press('Enter');
    await item('Level of it').getByText('a level above 9 needs it to be enabled').waitFor();
    await expectShown(5);
    expect(await violations(viewer.page)).toEqual([]);
  });

  it('is set by steps, and reset to its default', async () => {
    await item('Level of it').getByRole('button', { name: /^Increase/ }).last().click();
    await expect.poll(async () => (await rest.runtime('gadget'))['level'], { timeout: within }).toBeGreaterThan(5);
    await item('Level of it').getByRole('button', { name: /^Reset/ }).click();
    await expectRuntime('level', 5);
  });

  it('is left alone by echoes while a hand drags it', async () => {
    const slider = item('Level of it').getByRole('slider');
    // Widgets that were loaded late replace those that stood in for them.
    await expect.poll(() => slider.scrollIntoViewIfNeeded().then(() => true, () => false), { timeout: within }).toBe(true);
    const box = (await slider.boundingBox())!;
    const at = (part: number): [number, number] => [box.x + box.width * part, box.y + box.height / 2];
    const { mouse } = viewer.page;
    await mouse.move(...at(0.5));
    await mouse.down();
    await mouse.move(...at(0.8), { steps: 4 });
    // All of what the hand did has arrived, also what the page sends at its own rate, rounded to what can be read.
    await expect.poll(async () => Number(await slider.inputValue()), { timeout: within }).toBeGreaterThan(6);
    const held = Number(await slider.inputValue());
    await expect.poll(async () => (await rest.runtime('gadget'))['level'], { timeout: within }).toBeCloseTo(held, 1);
    // Somebody else sets it, by a request beside the page's own socket.
    await operator.beside.do('components/gadget/parameters', { method: 'PUT', body: { level: 1 } });
    await expectFeedback('level', 1);
    expect(Number(await slider.inputValue())).toBe(held);
    await mouse.up();
    // Nothing was sent by letting go: what is in force is shown.
    await expect.poll(async () => Number(await slider.inputValue()), { timeout: within }).toBeCloseTo(1, 6);
  });
});

describe('other kinds', () => {
  it('a number without a range', async () => {
    await field('Offset').fill('-250');
    await field('Offset').press('Enter');
    await expectRuntime('offset', -0.25); // shown in mm
  });

  it('a whole number, which takes no fraction', async () => {
    await field('Count').fill('2.5');
    await field('Count').press('Enter');
    await expect.poll(() => item('Count').getByRole('status').innerText(), { timeout: within }).not.toBe('');
    await expectRuntime('count', 3);
    await field('Count').fill('42');
    await field('Count').press('Enter');
    await expectRuntime('count', 42);
  });

  it('a switch', async () => {
    await viewer.page.getByRole('switch', { name: 'Enabled' }).click();
    await expectFeedback('enabled', true);
  });

  it('an enumeration', async () => {
    await viewer.page.getByRole('combobox', { name: 'Tint' }).selectOption('amber');
    await expectFeedback('tint', 'amber');
  });

  it('a text, which has so much room', async () => {
    const text = viewer.page.getByRole('textbox', { name: /^Title/ });
    await text.fill('Grüße <b>');
    await text.press('Enter');
    await expectFeedback('title', 'Grüße <b>');
    await text.fill('more than twenty-four bytes of text');
    await text.press('Enter');
    await expect.poll(() => item('Title').getByRole('status').innerText(), { timeout: within }).not.toBe('');
    await expectRuntime('title', 'Grüße <b>');
  });

  it('a matrix, row by row', async () => {
    const fields = item('Turns').locator('input');
    await fields.nth(1).fill('9');
    await fields.nth(1).press('Enter');
    await expectFeedback('turns', [[1, 9], [3, 4]]);
  });

  it('a button, once for each press', async () => {
    const button = viewer.page.getByRole('button', { name: 'Knock' });
    const before = await knocks();
    await button.click();
    await expectFeedback('knocks', before + 1);
    await button.click();
    await expectFeedback('knocks', before + 2);
  });
});

describe('what is modified', () => {
  beforeEach(async () => {
    await operator.beside.do('components/gadget/parameters', { method: 'PUT', body: { level: 6.5, count: 42 } });
  });

  it('is set back together, after a question, and that is taken back', async () => {
    const { page } = viewer;
    await page.getByRole('button', { name: 'Reset 2 modified of gadget' }).click();
    const question = page.getByText('Set back to the default: ');
    await question.waitFor();
    const [asked, button] = [(await question.boundingBox())!, (await page.getByRole('button', { name: 'Reset 2 modified' }).boundingBox())!];
    expect(asked.y - (button.y + button.height)).toBeLessThan(24); // at its button
    expect(asked.x + asked.width).toBeLessThanOrEqual(page.viewportSize()!.width);
    await screenshot(page, 'question');
    await expectRuntime('count', 42);
    await page.getByRole('button', { name: 'Yes' }).click();
    await expectRuntime('level', 5);
    await expectRuntime('count', 3);
    await page.getByRole('button', { name: 'Undo: 2 parameters of gadget' }).click();
    await expectRuntime('level', 6.5);
    await expectRuntime('count', 42);
    // Nothing is left to be taken back.
    await expect.poll(() => page.getByRole('button', { name: 'Undo' }).isDisabled(), { timeout: within }).toBe(true);
  });

  it('is found by name and value, set in the list, and taken back there', async () => {
    const { page } = viewer;
    await viewer.go('search');
    await page.getByRole('button', { name: 'Modified', exact: true }).click();
    await page.getByText('2 found', { exact: true }).waitFor();
    await page.getByRole('searchbox').fill('level 6.5');
    await page.getByText('1 found', { exact: true }).waitFor();
    await page.getByRole('button', { name: 'Favourite: Level of it of gadget' }).click();
    await field('Level of it').fill('7.5');
    await field('Level of it').press('Enter');
    await expectRuntime('level', 7.5);
    await page.getByRole('button', { name: /^Undo: Level of it of gadget from 7\.5.* back to 6\.5/ }).click();
    await expectRuntime('level', 6.5);
    await page.getByRole('searchbox').fill('');
    await page.getByRole('button', { name: 'Favourites', exact: true }).click();
    await page.getByText('1 found', { exact: true }).waitFor();
    await screenshot(page, 'search-favourites');
    expect(await violations(page)).toEqual([]);
  });
});

describe('what is searched for', () => {
  it('is found by its name in the tables, and again after a reload', async () => {
    const { page } = viewer;
    await viewer.go('search');
    await page.getByRole('searchbox').fill('mover.ratio');
    await page.getByText('1 found', { exact: true }).waitFor();
    await page.reload();
    await page.getByText('1 found', { exact: true }).waitFor();
    expect(await page.getByRole('searchbox').inputValue()).toBe('mover.ratio');
  });
});

describe('a keypad for fingers', () => {
  it('comes into sight below the last field of a page', async () => {
    const phone = await Viewer.open(browser(), operator.running.base, { size: 'phone', touch: true, session: operator.beside.cookie });
    onTestFinished(() => phone.close());
    await phone.page.evaluate(() => { document.documentElement.dataset['touch'] = 'large'; });
    await phone.go('units', 'gadget');
    const typed = phone.page.getByRole('spinbutton', { name: 'Level of it' }).first();
    await expect.poll(() => typed.isEnabled(), { timeout: within }).toBe(true);
    // At the lower edge of what is seen.
    await typed.evaluate((one) => one.scrollIntoView({ block: 'end' }));
    await typed.focus();
    const keypad = phone.page.getByRole('group', { name: 'Keypad' });
    await keypad.waitFor();
    const [keys, main] = [(await keypad.boundingBox())!, (await phone.page.locator('main').boundingBox())!];
    expect(keys.y + keys.height).toBeLessThanOrEqual(main.y + main.height + 1);
    await screenshot(phone.page, 'keypad');
  });
});

describe('two browsers', () => {
  it('see each other\'s change, and who may not change is told why', async () => {
    const other = await Viewer.open(browser(), operator.running.base);
    onTestFinished(() => other.close());
    await other.go('units', 'gadget');
    await expect.poll(() => field('Level of it', other).isDisabled(), { timeout: within }).toBe(true);
    await field('Level of it').fill('7');
    await field('Level of it').press('Enter');
    await expectShown(7, other);
    await other.page.getByText('needs operator').first().waitFor({ state: 'attached' });
  });

  it('a viewer is refused by the server, too', async () => {
    const answer = await rest.ask('components/gadget/parameters', { method: 'PUT', body: { level: 1 } });
    expect(answer.status).toBe(403);
    expect(answer.headers['content-type']).toContain('application/problem+json');
    await expectRuntime('level', 5);
  });
});

describe('by the keyboard alone', () => {
  it('control is taken, a value set, a button pressed, motion stopped', async () => {
    const { page } = viewer;
    const { keyboard } = page;
    /** Goes on with Tab until this has the focus. */
    const tabTo = async (target: Locator): Promise<void> => {
      for (let step = 0; step < 300; step += 1) {
        if (await target.evaluate((element) => (element.getRootNode() as Document | ShadowRoot).activeElement === element)) return;
        await keyboard.press('Tab');
      }
      throw new Error(`Tab does not lead to ${String(target)}`);
    };
    await tabTo(page.getByRole('button', { name: 'Release' }));
    await keyboard.press('Enter');
    await page.getByText('Nobody has control').waitFor();
    await tabTo(page.getByRole('button', { name: 'Take control' }));
    await keyboard.press('Enter');
    await page.getByText('You have control').waitFor();
    await tabTo(page.getByRole('link', { name: 'Units', exact: true }));
    await keyboard.press('Enter');
    await tabTo(page.getByRole('link', { name: 'gadget', exact: true }));
    await keyboard.press('Enter');
    await tabTo(field('Level of it'));
    await keyboard.press('ArrowUp');
    await expect.poll(async () => (await rest.runtime('gadget'))['level'], { timeout: within }).toBeGreaterThan(5);
    await tabTo(page.getByRole('button', { name: 'Knock' }));
    const before = await knocks();
    await keyboard.press('Space');
    await expectFeedback('knocks', before + 1);
    await tabTo(page.getByRole('button', { name: 'Stop motion' }));
    await keyboard.press('Enter');
    await page.getByText('Motion stopped', { exact: false }).first().waitFor();
  });
});
