// For every test file: what failed while this machine stood still is done once more, from its beforeEach on; what failed
// without that has failed. Pages go dead after a second of silence, holds end after a quarter: as they should.
import { afterEach, beforeEach } from 'vitest';

const interval = 10;
/** In ms: longer than a loaded machine lets a process wait that has something to do every 10 ms. */
const standstill = 100;

let last = performance.now();
let longest = 0;
setInterval(() => {
  const now = performance.now();
  longest = Math.max(longest, now - last - interval);
  last = now;
}, interval).unref();

let tried = '';

beforeEach(({ task }) => {
  if (tried === task.id) {
    if (longest < standstill) throw new Error(`it failed, and the machine stood still for ${longest.toFixed()} ms at most`);
    console.log(`"${task.name}" once more: the machine stood still for ${longest.toFixed()} ms`);
  }
  tried = task.id;
  longest = 0;
});

afterEach(() => new Promise<void>((resolve) => { setTimeout(resolve, 2 * interval); })); // so that the last gap is seen
