import { describe, expect, it } from 'vitest';
import type { UnitInfo } from '../units_of';
import { workPath, WorkTrace } from '../work_trace';

const unit = (index: number, thread = 'work'): UnitInfo => ({ name: `u${index}`, index, thread, outputs: {} });
const told = (begin_ns: number, steps: number[], cut = false, thread = 'work'): object => ({ thread, begin_ns, cut, steps });

describe('the account of steps', () => {
  it('puts lists together that tell of the same steps', () => {
    const trace = new WorkTrace();
    trace.add([told(100, [0, 0, 5, 1, 10, 5]), told(50, [2, 0, 1], false, 'other')]);
    trace.add([told(110, [1, 0, 5, 0, 20, 4])]);
    expect(trace.work(unit(0), 0, 1000)).toMatchObject([{ begin: 100, end: 105 }, { begin: 130, end: 134 }]);
    expect(trace.work(unit(1), 0, 1000)).toMatchObject([{ begin: 110, end: 115 }]);
    expect(trace.work(unit(2, 'other'), 0, 1000)).toHaveLength(1);
    expect(trace.work(unit(0), 105, 130)).toEqual([]);
    expect(trace.isMissing('work', 0, 1000)).toBe(false);
  });

  it('knows when frames began', () => {
    const trace = new WorkTrace();
    trace.add([told(100, [0, 0, 5, 0, 10, 5, 1, 12, 1, 0, 30, 5])]);
    expect(trace.frames(unit(0), 1)).toEqual([110, 130]);
    expect(trace.frames(unit(0), 10)).toEqual([100, 110, 130]);
    expect(trace.frames(unit(7), 10)).toEqual([]);
  });

  it('knows where steps are missing, as far as they could have been told', () => {
    const trace = new WorkTrace();
    trace.add([told(100, [0, 0, 5])]);
    trace.add([told(200, [0, 0, 5])]); // there were none in between
    expect(trace.isMissing('work', 0, 1000)).toBe(false);
    trace.add([told(300, [0, 0, 5], true)]);
    expect(trace.isMissing('work', 0, 1000)).toBe(true);
    expect(trace.isMissing('work', 301, 1000)).toBe(false);
    trace.keepFrom(301);
    expect(trace.isMissing('work', 0, 1000)).toBe(false);
    expect(trace.work(unit(0), 0, 1000)).toHaveLength(1);
  });

  it('begins anew with another clock, and bears whatever is no list', () => {
    const trace = new WorkTrace();
    trace.add([told(1000, [0, 0, 5, 0, 50, 5])]);
    trace.add([told(10, [0, 0, 5])]);
    expect(trace.work(unit(0), 0, 5000)).toMatchObject([{ begin: 10, end: 15 }]);
    trace.add(undefined);
    trace.add([told(0, [])]);
    expect(trace.work(unit(0), 0, 5000)).toHaveLength(1);
    for (let i = 0; i < 50; ++i) trace.add([told(100 + i, [0, 0, 1])]);
    trace.keepLast(3);
    expect(trace.work(unit(0), 0, 5000)).toHaveLength(3);
  });
});

describe('bars of work', () => {
  it('lie where the work was, and within the box', () => {
    const work = [{ begin: 90, end: 110 }, { begin: 150, end: 160 }, { begin: 195, end: 300 }];
    expect(workPath(work, 100, 200, 1000)).toBe('M0.0 0H100.0V10H0.0zM500.0 0H600.0V10H500.0zM950.0 0H1000.0V10H950.0z');
  });

  it('are seen however short it was, and are one where they would touch', () => {
    expect(workPath([{ begin: 10, end: 10 }], 0, 1000, 1000)).toBe('M10.0 0H12.5V10H10.0z');
    expect(workPath([{ begin: 10, end: 11 }, { begin: 12, end: 13 }, { begin: 900, end: 910 }], 0, 1000, 1000))
      .toBe('M10.0 0H13.0V10H10.0zM900.0 0H910.0V10H900.0z');
    expect(workPath([], 0, 1, 1000)).toBe('');
  });
});
