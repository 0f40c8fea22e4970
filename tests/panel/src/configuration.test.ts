// The flow of changing configuration: locked, edited, checked together, applied or rolled back, never half.
import { beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { Application, Viewer, frames, itemOf, useBrowser, screenshot, tidyUp, useOperator, violations, within, type Operator, type Rest } from './harness';

const browser = useBrowser();

let viewer: Viewer;
let rest: Rest;

const asBuilt = { size: 0.5, finish: 'grey' };

/** Whatever moves is at rest, may move no more, and is configured as it was built. */
async function restore({ beside }: Operator): Promise<void> {
  await beside.do('stop-motion', { method: 'POST' });
  await beside.do('components/mover/actions/reset', { method: 'POST' });
  const { size, finish } = await beside.configuration('gadget');
  if (size !== asBuilt.size || finish !== asBuilt.finish) {
    const body = { changes: [{ component: 'gadget', values: asBuilt }] };
    await expect.poll(async () => (await beside.ask('reconfigure', { body })).status, { timeout: within }).toBe(200);
  }
  await beside.do('clear-stop-motion', { method: 'POST' });
}

const size = () => itemOf(viewer.page, 'Size').first().getByRole('spinbutton');
const edit = () => viewer.page.getByRole('button', { name: 'Edit', exact: true });
const apply = () => viewer.page.getByRole('button', { name: 'Apply' });

const opened = () => viewer.page.getByRole('group', { name: 'Editing configuration' });
const lost = () => viewer.page.getByText('The link to the application is lost', { exact: false });

async function openEdit(): Promise<void> {
  try {
    await edit().click();
    await opened().or(lost()).first().waitFor();
    // A browser that gets no processor for a second has lost its link; a person would try again, too.
    if (await lost().isVisible()) await viewer.page.getByRole('button', { name: 'Try again' }).click();
    await opened().waitFor();
  } catch (failure) {
    const page = await viewer.page.locator('body').ariaSnapshot();
    throw new Error(`No edit was opened: ${(failure as Error).message}\nThe page, ${await frames(viewer.page)}, says:\n${page}`);
  }
}
/** mm, as it is shown. */
async function type(text: string): Promise<void> {
  await size().fill(text);
  await size().press('Enter');
}
async function expectSize(metres: number): Promise<void> {
  await expect.poll(async () => (await rest.feedback<{ size: number }>('gadget')).size, { timeout: within }).toBe(metres);
  expect((await rest.configuration('gadget'))['size']).toBe(metres);
}

describe('a configuration', () => {
  const operator = useOperator(browser, 'panel_cell', ['units', 'gadget'], restore, { size: 'panel' });
  beforeEach(() => { ({ viewer, rest } = operator); });

  it('is locked while initialised, edited, applied, and ends inhibited', async () => {
    await expect.poll(() => size().isDisabled(), { timeout: within }).toBe(true);
    await openEdit();
    await viewer.page.getByText('initialises again').waitFor();
    await screenshot(viewer.page, 'edit');
    expect(await violations(viewer.page)).toEqual([]);
    await expect.poll(() => apply().isDisabled(), { timeout: within }).toBe(true);
    await type('750');
    await viewer.page.getByText('1 value changed').waitFor();
    await viewer.page.getByRole('combobox', { name: 'Finish' }).selectOption('amber');
    await viewer.page.getByText('2 values changed').waitFor();
    await expectSize(0.5); // nothing before Apply
    await apply().click();
    await viewer.page.getByText('Applied. Everything was initialised again').waitFor();
    await expectSize(0.75);
    expect((await rest.configuration('gadget'))['finish']).toBe('amber');
    expect((await rest.do('state')).body.motion.may_move).toBe(false);
    await viewer.page.getByRole('button', { name: 'Close' }).click();
    await edit().waitFor();
  });

  it('is denied while something moves or may move, which it names', async () => {
    await viewer.page.getByRole('button', { name: 'Start motion' }).click();
    await viewer.page.getByText('Motion enabled').first().waitFor();
    await viewer.go('units', 'mover');
    await viewer.page.getByRole('switch', { name: 'Run' }).click();
    await expect.poll(async () => (await rest.feedback<{ commanded: number }>('mover')).commanded, { timeout: within }).not.toBe(0);
    await edit().click();
    await viewer.page.getByText('Edit is not possible now.').waitFor();
    await viewer.page.getByRole('alert').getByRole('link', { name: 'mover' }).waitFor();
    expect(await violations(viewer.page)).toEqual([]);
    await viewer.page.getByRole('button', { name: 'Stop motion' }).click();
    await viewer.page.getByRole('button', { name: 'Try again' }).click();
    await viewer.page.getByRole('group', { name: 'Editing configuration' }).waitFor();
  });

  it('says when a press was lost with the link, and can be tried again', async () => {
    // The page stands still for longer than the server waits for a sign of it, and is pressed before it knows that.
    await edit().evaluate((button: HTMLElement) => {
      for (const end = performance.now() + 5000; performance.now() < end; );
      button.click();
    });
    await lost().waitFor();
    expect((await rest.do('state')).body.edit).toBeNull();
    expect(await violations(viewer.page)).toEqual([]);
    await viewer.page.getByRole('button', { name: 'Try again' }).click();
    await opened().waitFor();
  });

  it('is not applied with a value outside of its range', async () => {
    await openEdit();
    await type('5000');
    await expect.poll(() => apply().isDisabled(), { timeout: within }).toBe(true);
    await expectSize(0.5);
  });

  it('is rolled back when a unit cannot be initialised, with the cause', async () => {
    await openEdit();
    await type('1300');
    await apply().click();
    await viewer.page.getByText('a size of 1.3 m does not fit in').first().waitFor();
    await screenshot(viewer.page, 'rolled-back');
    expect(await violations(viewer.page)).toEqual([]);
    await expectSize(0.5);
    await expect.poll(async () => (await rest.do('components/gadget')).body.life, { timeout: within }).toBe('running');
  });

  it('is discarded by hand', async () => {
    await openEdit();
    await type('600');
    await viewer.page.getByText('1 value changed').waitFor();
    await viewer.page.getByRole('button', { name: 'Discard' }).click();
    await edit().waitFor();
    await expect.poll(async () => Number(await size().inputValue()), { timeout: within }).toBe(500);
    await expectSize(0.5);
    expect((await rest.do('state')).body.edit).toBeNull();
  });

  it('is discarded with the control token, and another may edit then', async () => {
    await openEdit();
    await type('600');
    await viewer.page.getByRole('button', { name: 'Release' }).click();
    await viewer.page.getByText('The edit was discarded.', { exact: false }).waitFor();
    await expect.poll(async () => (await rest.do('state')).body.edit, { timeout: within }).toBeNull();
    await expectSize(0.5);
  });

  it('another page of the same session sees who edits', async () => {
    await openEdit();
    const other = await Viewer.open(browser(), operator.running.base);
    await other.go('overview');
    await other.page.getByText('Being edited').waitFor();
    await other.go('units', 'gadget');
    await expect.poll(() => other.page.getByRole('button', { name: 'Edit', exact: true }).isDisabled(), { timeout: within }).toBe(true);
    await other.close();
  });

  it('needs an engineer, and the token', async () => {
    for (const [path, body] of [['reconfigure', { changes: [{ component: 'gadget', values: { size: 0.9 } }] }]] as const) {
      expect((await rest.ask(path, { body })).status).toBe(403);
    }
    await expectSize(0.5);
  });
});

it('is discarded when it is left open too long', async () => {
  const running = await Application.start('panel_cell', { arguments: ['--panel-edit-timeout', '12s'] });
  onTestFinished(() => tidyUp(() => viewer.close(), () => running.end()));
  rest = running.rest();
  viewer = await Viewer.open(browser(), running.address, { size: 'panel' });
  await viewer.takeControl();
  await viewer.go('units', 'gadget');
  await openEdit();
  await type('600');
  await viewer.page.getByText(/The edit was (left open too long and was )?discarded/).waitFor();
  await expect.poll(async () => (await rest.do('state')).body.edit, { timeout: within }).toBeNull();
  await expectSize(0.5);
  await viewer.page.getByRole('button', { name: 'Close' }).click();
  await openEdit();
});
