// Thirty seconds of the page while the arm picks, as a picture that moves: a code hosting page shows it as any other picture.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import type { Scene } from './make';

const size = { width: 1280, height: 800 };
/** What the film's pictures are made smaller to. */
const shown = { width: 960, height: 600 };
/** ms: pictures that follow sooner are left out. */
const least = 120;
const mostBytes = 3_000_000;

interface Frame {
  readonly file: string;
  /** ms */
  readonly at: number;
}

/** Whatever the browser draws of the page, and when, until what is done is over. */
async function record(page: Page, folder: string, act: () => Promise<void>): Promise<Frame[]> {
  const session = await page.context().newCDPSession(page);
  const frames: Frame[] = [];
  session.on('Page.screencastFrame', ({ data, sessionId, metadata }) => {
    void session.send('Page.screencastFrameAck', { sessionId });
    const at = 1000 * (metadata.timestamp ?? 0);
    const last = frames.at(-1);
    if (last && at - last.at < least) return;
    const file = join(folder, `${String(frames.length).padStart(4, '0')}.png`);
    const png = Buffer.from(data, 'base64');
    // The first may be of the window as it was before.
    if (png.readUInt32BE(16) !== shown.width || png.readUInt32BE(20) !== shown.height) return;
    writeFileSync(file, png);
    frames.push({ file, at });
  });
  await session.send('Page.startScreencast', { format: 'png', maxWidth: shown.width, maxHeight: shown.height });
  await act();
  await session.send('Page.stopScreencast');
  await session.detach();
  return frames;
}

/** Throws what the program said. */
function run(program: string, given: readonly string[]): void {
  const { status, stderr, error } = spawnSync(program, given, { encoding: 'utf8' });
  if (status !== 0) throw new Error(`${program}: ${error?.message ?? stderr}`);
}

/** Each is shown until the next one was drawn. */
function put(frames: readonly Frame[], quality: number, path: string): void {
  const given = frames.flatMap(({ file, at }, i) => ['-d', Math.round((frames[i + 1]?.at ?? at + 1000) - at).toString(), file]);
  run('img2webp', ['-loop', '0', '-kmin', '12', '-kmax', '24', '-lossy', '-q', quality.toString(), '-m', '4', ...given, '-o', path]);
}

/** As good as fits. */
export async function film({ viewer, beside }: Scene, path: string): Promise<void> {
  const { page } = viewer;
  const picker = () => beside.feedback<{ state: string; binned: number }>('picker');
  const cover = (covered: boolean) => beside.do('components/table/parameters', { method: 'PUT', body: { cover_lens: covered } });
  await page.setViewportSize(size);
  const view = page.getByRole('img', { name: /in 3D/ });
  await view.waitFor();
  while ((await picker()).binned < 1) await page.waitForTimeout(100);
  while ((await picker()).state !== 'approaching') await page.waitForTimeout(20);
  const folder = mkdtempSync(join(tmpdir(), 'flexrf-film-'));
  try {
    const frames = await record(page, folder, async () => {
      const begin = Date.now();
      const until = (seconds: number) => page.waitForTimeout(Math.max(0, begin + 1000 * seconds - Date.now()));
      await until(9);
      // A click would bring it into the middle first.
      await page.getByRole('checkbox', { name: 'Attention', exact: true }).evaluate((box) => (box as HTMLInputElement).click());
      await until(13);
      await cover(true);
      await until(17);
      await cover(false);
      await until(24);
      await viewer.go('units', 'evolution');
      await page.getByRole('heading', { name: 'Attention', exact: true }).evaluate((heading) => heading.scrollIntoView());
      await until(30);
    });
    for (let quality = 60; ; quality -= 10) {
      put(frames, quality, path);
      const { size: bytes } = statSync(path);
      const seconds = ((frames.at(-1)?.at ?? 0) - (frames[0]?.at ?? 0)) / 1000;
      console.log(`${path}: ${frames.length} pictures in ${seconds.toFixed(1)} s, ${bytes} bytes at quality ${quality}`);
      if (bytes <= mostBytes) return;
      if (quality <= 20) throw new Error(`the film is larger than ${mostBytes} bytes, however bad`);
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}
