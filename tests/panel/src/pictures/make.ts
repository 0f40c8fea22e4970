// make.ts FOLDER [NAME]: the pictures of the documents and the film, or one of them, made of the real applications before a real
// browser, into FOLDER. `./flexrf pictures` calls it. Nothing is retouched, and nothing drawn that the page does not show.
import { join } from 'node:path';
import type { Browser } from 'playwright-core';
import { Application } from '../harness/application';
import { Viewer, launch } from '../harness/browser';
import type { ApplicationName } from '../harness/environment';
import type { Rest } from '../harness/rest';
import { film } from './film';

export interface Scene {
  readonly viewer: Viewer;
  readonly running: Application;
  /** A script of the viewer's own session. */
  readonly beside: Rest;
}

const until = async (what: string, condition: () => Promise<boolean>): Promise<void> => {
  const end = Date.now() + 180_000;
  while (!(await condition())) {
    if (Date.now() > end) throw new Error(`it waits in vain: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
};

/** With control, as whoever works there. */
async function before(browser: Browser, name: ApplicationName, act: (scene: Scene) => Promise<void>): Promise<void> {
  const running = await Application.start(name);
  try {
    const viewer = await Viewer.open(browser, running.address);
    await viewer.go('log'); // where nothing is drawn
    await viewer.takeControl();
    await viewer.go('overview');
    await act({ viewer, running, beside: await viewer.script() });
    await viewer.close();
  } finally {
    await running.end();
  }
}

async function keyboard({ viewer, running }: Scene, folder: string): Promise<void> {
  const { page } = viewer;
  await page.setViewportSize({ width: 1200, height: 800 });
  await page.getByRole('img', { name: /in 3D/ }).waitFor();
  running.press('aaadddd');
  await page.waitForTimeout(4000);
  await page.screenshot({ path: join(folder, 'panel-overview.png') });
  await viewer.go('units', 'jog');
  await page.setViewportSize({ width: 1200, height: 1400 });
  await page.waitForTimeout(1000);
  await page.screenshot({ path: join(folder, 'panel-unit.png') });
}

async function pickStation({ viewer, beside }: Scene, folder: string): Promise<void> {
  const state = async (): Promise<string> => (await beside.feedback<{ state: string }>('pick')).state;
  const press = (parameter: string) => beside.do('components/pick/actions/press', { method: 'POST', body: { parameter, count: 1 } });
  await beside.do('start-motion', { method: 'POST' });
  await until('it is not homed', async () => (await state()) === 'not_homed');
  await press('home');
  await until('it is ready', async () => (await state()) === 'ready');
  await press('start');
  await until('two parts', async () => (await beside.feedback<{ parts: number }>('pick')).parts >= 2);
  await viewer.page.setViewportSize({ width: 1280, height: 1250 });
  await viewer.page.waitForTimeout(500);
  await viewer.page.screenshot({ path: join(folder, 'pick-station.png') });
}

async function visualServoing({ viewer, beside }: Scene, folder: string): Promise<void> {
  const { page } = viewer;
  const picker = () => beside.feedback<{ state: string; binned: number }>('picker');
  const size = (width: number, height: number) => page.setViewportSize({ width, height });
  await size(1400, 1000);
  await page.getByRole('img', { name: /in 3D/ }).waitFor();
  // When a part was brought away, there are all values.
  await until('two parts are in their bins', async () => (await picker()).binned >= 2);
  // A picture over which lies what was found in it.
  const drawn = page.locator('flexrf-widget-image li .state').first();
  await until('it is near a part', async () =>
    ['looking', 'descending'].includes((await picker()).state) && /^[4-9] drawn$|^1\d drawn$/.test(await drawn.innerText()));
  await page.screenshot({ path: join(folder, 'visual-servoing.png') });
  await viewer.go('menu', 'Table');
  await size(1200, 1250);
  const box = page.getByRole('textbox', { name: 'Place on the table 0' });
  await until('there are values', async () => (await box.inputValue()) === '450');
  await page.waitForTimeout(1000);
  await page.screenshot({ path: join(folder, 'visual-servoing-table.png') });
  await viewer.go('units', 'evolution');
  await size(1400, 1100);
  await page.waitForTimeout(12_000); // lines over generations
  await page.getByRole('heading', { name: 'Attention', exact: true }).evaluate((heading) => heading.scrollIntoView());
  await page.waitForTimeout(500);
  await page.screenshot({ path: join(folder, 'visual-servoing-evolution.png') });
}

const subjects: { readonly [name: string]: readonly [ApplicationName, (scene: Scene, folder: string) => Promise<void>] } = {
  keyboard: ['keyboard', keyboard],
  'pick-station': ['pick-station', pickStation],
  'visual-servoing': ['visual-servoing', visualServoing],
  film: ['visual-servoing', (scene, folder) => film(scene, join(folder, 'visual-servoing.webp'))],
};
const [, , folder, name] = process.argv;
if (folder === undefined) throw new Error('make.ts takes the folder that the pictures go to');
const browser = await launch();
try {
  for (const [subject, [application, act]] of Object.entries(subjects)) {
    if (name === undefined || name === subject) await before(browser, application, (scene) => act(scene, folder));
  }
} finally {
  await browser.close();
}
