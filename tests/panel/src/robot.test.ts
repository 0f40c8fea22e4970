// The keyboard application: the arm in 3D, keys that move it, the jog step, the jog arrows.
import { beforeEach, expect, it } from 'vitest';
import { Viewer, heldWithin, itemOf, screenshot, unlessKeptWaiting, useBrowser, useOperator, within, type Application, type Rest } from './harness';

const browser = useBrowser();

const operator = useOperator(browser, 'keyboard', ['overview'], async ({ beside }) => {
  await beside.do('components/jog/actions/reset', { method: 'POST' });
});
let running: Application;
let viewer: Viewer;
let rest: Rest;
beforeEach(() => { ({ running, viewer, rest } = operator); });

const canvas = () => viewer.page.getByRole('img', { name: /in 3D/ });

interface Pose {
  readonly position: number[];
  readonly sequence: number;
}

async function pose(): Promise<Pose> {
  const { value, sequence } = (await rest.do('slots/tool_pose')).body;
  return { position: value.position, sequence };
}
async function position(): Promise<number[]> {
  return (await pose()).position;
}
/** Until it is where it was half a second ago, in which it was told again and again where it is. */
async function atRest(): Promise<number[]> {
  let after = await pose();
  await expect.poll(async () => {
    const before = after;
    while (after.sequence - before.sequence < 50) {
      await new Promise((resolve) => setTimeout(resolve, 500));
      after = await pose();
    }
    return Math.hypot(...after.position.map((one, i) => one - before.position[i]!));
  }, { timeout: within }).toBeLessThan(2e-4);
  return after.position;
}
async function speed(): Promise<number> {
  const { value } = (await rest.do('slots/hand')).body;
  return Math.hypot(...(value?.linear ?? [0]));
}

it('the arm is drawn, and moves when a key is pressed', async () => {
  await canvas().waitFor();
  const picture = async (): Promise<string> => (await canvas().screenshot()).toString('base64');
  // Something is drawn: the picture is not of one colour.
  await expect.poll(async () => (await picture()).length, { timeout: within }).toBeGreaterThan(4000);
  await atRest();
  const before = await picture();
  const from = await position();
  running.press('wwww');
  await expect.poll(async () => (await position())[0]! - from[0]!, { timeout: within }).toBeGreaterThan(0.02);
  await expect.poll(async () => (await picture()) === before, { timeout: within }).toBe(false);
  await screenshot(viewer.page, 'keyboard-moved');
});

it('the joints stand in a table, too', async () => {
  await viewer.page.getByText('Joints as a table').click();
  const table = viewer.page.getByRole('table', { name: /positions of the joints/ });
  await expect.poll(() => table.getByRole('row').count(), { timeout: within }).toBe(7);
  await expect.poll(() => table.innerText(), { timeout: within }).toMatch(/-?\d+(\.\d+)? °/);
});

it('the 3D view is turned by buttons', async () => {
  await canvas().waitFor();
  await atRest();
  await viewer.page.mouse.move(0, 0);
  const before = (await canvas().screenshot()).toString('base64');
  await viewer.page.getByRole('button', { name: 'Turn left' }).click();
  await expect.poll(async () => (await canvas().screenshot()).toString('base64') === before, { timeout: within }).toBe(false);
});

it('changing the jog step changes the next jog', async () => {
  const step = itemOf(viewer.page, 'Jog step').first().getByRole('spinbutton');
  const jog = async (millimetres: string): Promise<number> => {
    await step.fill(millimetres);
    await step.press('Enter');
    await expect.poll(async () => (await rest.runtime('jog'))['step'], { timeout: within }).toBeCloseTo(Number(millimetres) / 1000, 9);
    const from = await atRest();
    running.press('w');
    await expect.poll(async () => Math.abs((await position())[0]! - from[0]!), { timeout: within }).toBeGreaterThan(0.004);
    return Math.abs((await atRest())[0]! - from[0]!);
  };
  expect(await jog('10')).toBeCloseTo(0.01, 3);
  expect(await jog('30')).toBeCloseTo(0.03, 3);
});

it('the arrows move the arm while they are held, and no longer', async () => {
  const { page } = viewer;
  const arrow = page.getByRole('button', { name: /Move \+z/ });
  await arrow.scrollIntoViewIfNeeded();
  const box = (await arrow.boundingBox())!;
  expect(Math.min(box.width, box.height)).toBeGreaterThanOrEqual(72);
  await unlessKeptWaiting(page, rest, async () => {
    const from = await atRest();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await expect.poll(async () => (await position())[2]! - from[2]!, { timeout: heldWithin }).toBeGreaterThan(0.01);
  }, () => page.mouse.up());
  await screenshot(viewer.page, 'arrow-held');
  await viewer.page.mouse.up();
  await expect.poll(speed, { timeout: within }).toBe(0);
  const rested = await atRest();
  await new Promise((resolve) => setTimeout(resolve, 500));
  expect(Math.abs((await position())[2]! - rested[2]!)).toBeLessThan(1e-3);
});

interface RobotFeedback {
  readonly set_point: number[];
  readonly activity: string;
  readonly moving: boolean;
}
const robot = (): Promise<RobotFeedback> => rest.feedback<RobotFeedback>('robot');
const joints = async (): Promise<number[]> => (await rest.do('slots/joints')).body.value.position;
/** The farthest that any joint is from another posture. */
const apart = (one: number[], other: number[]): number => Math.max(...one.map((value, i) => Math.abs(value - other[i]!)));

// As a person sees it who presses an arrow of the robot's own: the parameter is set, the target of its joints moves, the joints
// follow and say so, and another page that only looks draws the arm elsewhere.
it('an arrow of the robot leads from the press to the 3D view', async () => {
  const { page } = viewer;
  const looker = await Viewer.open(browser(), `${running.base}/#/overview`);
  const drawn = looker.page.getByRole('img', { name: /in 3D/ });
  await drawn.waitFor();
  const picture = async (): Promise<string> => (await drawn.screenshot()).toString('base64');
  await viewer.go('units', 'robot');
  const arrow = page.locator('flexrf-item').getByRole('button', { name: '+z', exact: true });
  await arrow.scrollIntoViewIfNeeded();
  await unlessKeptWaiting(page, rest, async () => {
    await atRest();
    const before = await picture();
    const [target, actual] = [(await robot()).set_point, await joints()];
    const box = (await arrow.boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await expect.poll(async () => (await rest.runtime('robot'))['plus_z'], { timeout: heldWithin }).toBe(true);
    await expect.poll(async () => (await robot()).activity, { timeout: heldWithin }).toBe('jog');
    await expect.poll(async () => apart((await robot()).set_point, target), { timeout: heldWithin }).toBeGreaterThan(0.02);
    await expect.poll(async () => apart(await joints(), actual), { timeout: heldWithin }).toBeGreaterThan(0.02);
    await expect.poll(async () => (await picture()) === before, { timeout: heldWithin }).toBe(false);
  }, () => page.mouse.up());
  await page.mouse.up();
  await expect.poll(async () => (await rest.runtime('robot'))['plus_z'], { timeout: within }).toBe(false);
  await expect.poll(async () => (await robot()).moving, { timeout: within }).toBe(false);
  await atRest();
  expect(apart(await joints(), (await robot()).set_point)).toBeLessThan(1e-3);
  await looker.close();
});

it('the 3D library is not loaded where no robot is shown', async () => {
  const other = await Viewer.open(browser(), `${running.base}/#/log`);
  await other.page.getByRole('log').waitFor();
  const loaded = await other.page.evaluate(() =>
    performance.getEntriesByType('resource').map((entry) => [entry.name, (entry as PerformanceResourceTiming).decodedBodySize] as const));
  expect(loaded.filter(([, bytes]) => bytes > 300_000)).toEqual([]);
  await other.close();
});
