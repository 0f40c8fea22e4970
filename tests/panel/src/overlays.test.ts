// What is found in a picture lies over that picture, and around the arm in 3D: on the page of a cell whose pictures and finds are known.
import { beforeEach, expect, it } from 'vitest';
import { Viewer, screenshot, useBrowser, useOperator, violations, within, type Application, type Rest } from './harness';

const browser = useBrowser();

const setStopped = (rest: Rest, member: number, stopped: boolean) =>
  rest.do(`components/${encodeURIComponent(`spotter[${member}]`)}/parameters`, { method: 'PUT', body: { stopped } });

const operator = useOperator(browser, 'sight_cell', ['overview'], async ({ beside }) => {
  for (const member of [0, 1]) await setStopped(beside, member, false);
});
let running: Application;
let viewer: Viewer;
let beside: Rest;
beforeEach(() => { ({ running, viewer, beside } = operator); });

const eye = () => viewer.page.locator('flexrf-widget-image');
const row = (name: string) => eye().locator('flexrf-overlays li').filter({ has: viewer.page.getByRole('checkbox', { name, exact: true }) });
const state = async (name: string): Promise<string> => (await row(name).locator('.state').innerText()).trim();

interface Seen {
  readonly text: string;
  readonly opacity: number;
  /** What the picture shows just within its corners and just outside. */
  readonly inside: string[];
  readonly outside: string[];
}

/** The rectangles and what the picture below them shows, at one moment. */
function seen(): Promise<Seen[]> {
  return eye().evaluate((widget) => {
    const root = widget.shadowRoot!;
    const image = root.querySelector<HTMLImageElement>('img:not([hidden])')!;
    const canvas = new OffscreenCanvas(image.naturalWidth, image.naturalHeight);
    const context = canvas.getContext('2d')!;
    context.drawImage(image, 0, 0);
    const svg = root.querySelector<SVGSVGElement>('.picture svg')!;
    const scale = svg.viewBox.baseVal.width / image.naturalWidth;
    const colours = { ground: [150, 145, 135], box: [40, 80, 200], ball: [230, 120, 30] };
    const at = (x: number, y: number): string => {
      const pixel = context.getImageData(Math.round(x / scale), Math.round(y / scale), 1, 1).data;
      const distance = (colour: number[]): number => Math.hypot(...colour.map((one, i) => one - pixel[i]!));
      return Object.entries(colours).sort(([, one], [, other]) => distance(one) - distance(other))[0]![0];
    };
    return [...svg.querySelectorAll('g')].filter((mark) => mark.getAttribute('visibility') === 'visible').map((mark) => {
      const [, line] = [...mark.querySelectorAll('rect')];
      const [x, y, width, height] = ['x', 'y', 'width', 'height'].map((name) => Number(line!.getAttribute(name))) as [number, number, number, number];
      // JPEGs blur edges.
      const corners = (d: number): string[] =>
        [[x + d, y + d], [x + width - d, y + d], [x + d, y + height - d], [x + width - d, y + height - d]].map(([a, b]) => at(a!, b!));
      return { text: mark.querySelector('text')!.textContent ?? '', opacity: Number(mark.getAttribute('opacity')), inside: corners(6), outside: corners(-6) };
    });
  });
}
const drawn = async (): Promise<string[]> => (await seen()).map((one) => one.text);

const lies = (mark: Seen, on: string): boolean => mark.inside.every((one) => one === on) && mark.outside.every((one) => one === 'ground');

it('each rectangle lies on what it is about, picture after picture', async () => {
  await expect.poll(drawn, { timeout: within }).toEqual(['7', '8?']);
  for (let fresh = 0; fresh < 40;) {
    const [box, ball] = await seen();
    if (ball) expect(lies(ball, 'ball')).toBe(true);
    // What is older than the picture is drawn faintly, and lies beside: the box wanders.
    if (box?.opacity === 1) {
      fresh += 1;
      expect(lies(box, 'box')).toBe(true);
    }
    await viewer.page.waitForTimeout(30);
  }
  await screenshot(viewer.page, 'overlays');
  expect(await violations(viewer.page)).toEqual([]);
});

it('what is not found any more is said to be old, and goes', async () => {
  await expect.poll(() => state('Sights'), { timeout: within }).toBe('2 drawn');
  await setStopped(beside, 0, true);
  // The other still looks, and is now and then a picture late.
  await expect.poll(drawn, { timeout: within }).toEqual(['8?']);
  await expect.poll(() => state('Sights'), { timeout: within }).toBe('1 drawn');
  await setStopped(beside, 1, true);
  await expect.poll(() => state('Sights'), { timeout: within }).toMatch(/^⚠ nothing of this picture; the last is \d+\.\d\d s older$/);
  await expect.poll(drawn, { timeout: within }).toEqual([]);
  await screenshot(viewer.page, 'overlays-old');
  expect(await violations(viewer.page)).toEqual([]);
  for (const member of [0, 1]) await setStopped(beside, member, false);
  await expect.poll(drawn, { timeout: within }).toEqual(['7', '8?']);
});

it('each overlay is switched by mouse or keys, and one that is hidden is not asked for', async () => {
  await expect.poll(drawn, { timeout: within }).toEqual(['7', '8?']);
  expect(await state('Second alone')).toBe('hidden');
  await row('Sights').getByRole('checkbox').click();
  await expect.poll(drawn, { timeout: within }).toEqual([]);
  const second = row('Second alone').getByRole('checkbox');
  await second.focus();
  await viewer.page.keyboard.press('Space');
  await expect.poll(() => state('Second alone'), { timeout: within }).toBe('1 drawn');
  await expect.poll(drawn, { timeout: within }).toEqual(['']);
});

it('the same stands in a table', async () => {
  const { page } = viewer;
  await page.getByText('What is drawn, as a table').click();
  const table = page.getByRole('table', { name: /^Eye: 2 drawn/ });
  await expect.poll(() => table.getByRole('row').count(), { timeout: within }).toBe(3);
  await expect.poll(() => table.innerText(), { timeout: within }).toMatch(/Sights\s+ball\s+8\s+200\s+160\s+50\s+50\s+1\s+no/);
  expect(await violations(page)).toEqual([]);
});

it('the same stands around the arm', async () => {
  const { page } = viewer;
  const canvas = page.getByRole('img', { name: /in 3D/ });
  await canvas.waitFor();
  const cell = page.locator('flexrf-widget-robot');
  const words = () => cell.locator('.labels > span:visible').allInnerTexts();
  await expect.poll(async () => (await words()).sort(), { timeout: within }).toEqual(expect.arrayContaining(['7', '8?', 'Camera', 'Tool']));
  await page.mouse.move(0, 0);
  await cell.getByText('Joints as a table').scrollIntoViewIfNeeded();
  await screenshot(page, 'surroundings');
  const before = (await canvas.screenshot()).toString('base64');
  await cell.getByRole('checkbox', { name: 'Sights' }).click();
  await expect.poll(async () => (await canvas.screenshot()).toString('base64') === before, { timeout: within }).toBe(false);
  await expect.poll(words, { timeout: within }).not.toContain('7');
  await cell.getByRole('checkbox', { name: 'Sights' }).click();
  await page.getByText('Bodies as a table').click();
  await expect.poll(() => cell.getByRole('table', { name: /2 bodies/ }).innerText(), { timeout: within })
    .toMatch(/Sights\s+box\s+7\s+400\.0 mm\s+−300\.0 mm\s+0 mm\s+28\.65 °\s+yes/);
  expect(await violations(page)).toEqual([]);
});

it('fits onto a phone, with its tables open', async () => {
  const other = await Viewer.open(browser(), `${running.base}/#/overview`, { size: 'phone', touch: true, dark: true });
  const { page } = other;
  await page.getByText('What is drawn, as a table').click();
  await page.getByRole('table', { name: /^Eye/ }).waitFor();
  await page.getByText('Bodies as a table').click();
  await page.getByRole('table', { name: /2 bodies/ }).waitFor();
  for (const name of ['flexrf-overlays', 'flexrf-surroundings']) {
    const lists = page.locator(name);
    const card = await page.locator('main').evaluate((main) => main.getBoundingClientRect().right);
    const edges = await lists.evaluate((list) =>
      ['.state', '.scroll'].map((one) => list.shadowRoot!.querySelector(one)!.getBoundingClientRect().right));
    expect(Math.max(...edges), name).toBeLessThanOrEqual(card);
    await lists.locator('summary').scrollIntoViewIfNeeded();
    await screenshot(page, name);
  }
  expect(await violations(page)).toEqual([]);
  await other.close();
});
