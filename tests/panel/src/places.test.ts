// Places for browsers: many pages at once, and no room for more.
import { connect, type Socket } from 'node:net';
import { it, onTestFinished } from 'vitest';
import { Viewer, useApplication, useBrowser } from './harness';

const browser = useBrowser();
const application = useApplication('panel_cell');

/** Says the beginning of a request, or nothing. */
function silent(port: number, text: string): Promise<Socket> {
  return new Promise((resolve, reject) => {
    const socket = connect(port, '127.0.0.1', () => { socket.write(text); resolve(socket); });
    socket.on('error', reject);
    socket.on('connect', () => socket.removeAllListeners('error').on('error', () => undefined));
  });
}

async function expectLive(viewer: Viewer): Promise<void> {
  await viewer.page.getByText(/Round trip/).waitFor();
  await viewer.page.locator('main h2').first().waitFor();
}

it('eight pages of eight browsers opened at once all live, and go on to live', async () => {
  const running = application();
  const viewers = await Promise.all(Array.from({ length: 8 }, () => Viewer.open(browser(), running.base)));
  onTestFinished(async () => { for (const viewer of viewers) await viewer.close(); });
  await Promise.all(viewers.map(expectLive));
  await Promise.all(viewers.map((viewer) => viewer.go('units', 'gadget')));
  await Promise.all(viewers.map(expectLive));
});

it('200 half-open connections keep nobody out', async () => {
  const running = application();
  const silents = await Promise.all(Array.from({ length: 200 }, (_, i) => silent(running.port, i % 2 ? 'GET / HT' : '')));
  onTestFinished(() => silents.forEach((socket) => socket.destroy()));
  const viewer = await Viewer.open(browser(), running.base);
  onTestFinished(() => viewer.close());
  await expectLive(viewer);
});
