// On a loaded machine a hold ends by itself, as it should: it lives on what comes in time. Who was kept waiting is measured.
import type { Page } from 'playwright-core';
import type { Rest } from './rest';

const interval = 10;
/** A lease is refreshed every 100 ms and lasts for 250: who of three was late by less did not end it. */
const tolerable = 50;

/** How long one attempt waits for what a hold does. An attempt that a busy machine cut short is repeated. */
export const heldWithin = 10_000;

/** How much later than it asked for the page, this process, the server's and a cell's thread were woken at worst, in ms. */
class Pauses {
  private own = 0;
  private readonly timer: NodeJS.Timeout;

  private constructor(private readonly page: Page, private readonly rest: Rest, private readonly before: Delays) {
    let last = performance.now();
    this.timer = setInterval(() => {
      const now = performance.now();
      this.own = Math.max(this.own, now - last - interval);
      last = now;
    }, interval);
  }

  static async from(page: Page, rest: Rest): Promise<Pauses> {
    await page.evaluate((every) => {
      const watched = window as unknown as { longestPause: number; pauseTimer?: number };
      window.clearInterval(watched.pauseTimer);
      watched.longestPause = 0;
      let last = performance.now();
      watched.pauseTimer = window.setInterval(() => {
        const now = performance.now();
        watched.longestPause = Math.max(watched.longestPause, now - last - every);
        last = now;
      }, every);
    }, interval);
    return new Pauses(page, rest, await delays(rest));
  }

  async end(): Promise<{ page: number; test: number } & Delays> {
    clearInterval(this.timer);
    const page = await this.page.evaluate(() => (window as unknown as { longestPause: number }).longestPause);
    const { server, cell } = await delays(this.rest);
    // The application tells the longest since its start.
    return {
      page, test: this.own, server: server > this.before.server ? server : 0, cell: cell > this.before.cell ? cell : 0,
    };
  }
}

interface Delays {
  readonly server: number;
  readonly cell: number;
}

async function delays(rest: Rest): Promise<Delays> {
  const threads = (await rest.do('threads')).body as { lateness: { max_ns: number } }[];
  return {
    server: (await rest.do('state')).body.server.loop_delay_us.max / 1000,
    cell: Math.max(...threads.map((thread) => thread.lateness.max_ns)) / 1e6,
  };
}

/**
 * Does what needs a hold to live on. A hold that ends by itself is right only where one of its four parties was kept waiting:
 * then `restore` lets go of everything, and it is done again, until the test's own limit. It fails where nobody was kept waiting.
 */
export async function unlessKeptWaiting(
  page: Page, rest: Rest, act: () => Promise<void>, restore: () => Promise<void>,
): Promise<void> {
  for (;;) {
    const pauses = await Pauses.from(page, rest);
    try {
      await act();
      await pauses.end();
      return;
    } catch (failure) {
      const longest = await pauses.end();
      if (Math.max(...Object.values(longest)) < tolerable) throw failure;
      console.log(`once more, as this machine kept somebody waiting (ms): ${JSON.stringify(longest)}`);
      await restore();
    }
  }
}
