// For every test file: of what failed it is told what its applications said, and where this machine stood still meanwhile it
// is done once more, from its beforeEach on; what failed without that has failed. Pages go dead after a second of silence,
// holds end after a quarter: as they should.
import { afterEach, beforeEach } from 'vitest';
import { runningApplications } from './harness/application';

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

afterEach(({ task }) => {
  if (task.result?.state !== 'fail') return;
  for (const application of runningApplications) console.log(`"${task.name}" failed; the application said:\n${application.text.slice(-8000)}`);
});

afterEach(() => new Promise<void>((resolve) => { setTimeout(resolve, 2 * interval); })); // so that the last gap is seen
