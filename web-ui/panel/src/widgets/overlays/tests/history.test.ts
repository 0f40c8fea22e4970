// @vitest-environment node
import { describe, expect, it } from 'vitest';
import type { Overlay, Reading, Value } from '../../../contract';
import { fieldOf, isCertain, textOf, thingsOf } from '../../things';
import { OverlayHistory } from '../history';

const overlay: Overlay = {
  name: 'regions', shown: true, slots: ['report'], list: 'regions', text: [], rectangle: ['left', 'top', 'width', 'height'],
};
const ms = 1_000_000;

let sequence = 0;
function reading(value: Value | null, sampledAt = 0): Reading {
  sequence += 1;
  return { value, reason: value === null ? 'writer retired' : '', sampledAt, sequence, age: 0 };
}
const report = (...regions: number[]): Value => ({ regions: regions.map((left) => ({ left })) });
const lefts = (history: OverlayHistory, picture: number): unknown[] | undefined =>
  history.of(picture)?.things.map((thing) => fieldOf(thing, 'left'));

describe('things', () => {
  const value = {
    count: 2, seen: [{ name: 'a', in_use: true, at: [1, 2] }, { name: 'none', in_use: false, at: [3, 4] }, { name: 'c', in_use: true, at: [5, 6] }],
  };
  const of = { ...overlay, list: 'seen' };

  it('are those in use', () => {
    const names = (more: object): unknown[] => thingsOf({ ...of, ...more }, value).map((thing) => fieldOf(thing, 'name'));
    expect(names({})).toEqual(['a', 'none', 'c']);
    expect(names({ count: 'count' })).toEqual(['a', 'none']);
    expect(names({ empty: { field: 'name', value: 'none' } })).toEqual(['a', 'c']);
    expect(names({ empty: { field: 'in_use', value: false } })).toEqual(['a', 'c']);
    expect(names({ count: 'count', empty: { field: 'in_use', value: false } })).toEqual(['a']);
    // Of a ring, which counts on; and of what is no list.
    expect(thingsOf({ ...of, count: 'count' }, { ...value, count: 900 })).toHaveLength(3);
    expect(thingsOf({ ...of, list: 'count' }, value)).toEqual([]);
  });

  it('are the value itself where there is no list', () => {
    const { list, ...single } = of;
    expect(list).toBe('seen');
    expect(thingsOf(single, value)).toEqual([value]);
  });

  it('are certain or not, and have words', () => {
    const thing = { id: 7, kind: 'left_hand', ok: true, where: [1.25, 2], big: 0.123456789 };
    expect(isCertain(of, thing)).toBe(true);
    expect(isCertain({ ...of, certain: 'ok' }, thing)).toBe(true);
    expect(isCertain({ ...of, certain: 'id' }, thing)).toBe(false);
    expect(isCertain({ ...of, doubtful: 'ok' }, thing)).toBe(false);
    expect(textOf({ ...of, text: ['id', 'kind', 'ok', 'missing', 'where[1]', 'big'] }, thing)).toBe('7 left hand ok 2 0.123457');
    expect(textOf({ ...of, text: ['ok'] }, { ok: false })).toBe('');
  });
});

describe('history', () => {
  it('gives what was found in that very picture, whatever came since', () => {
    const history = new OverlayHistory(overlay);
    for (const time of [100, 133, 167]) history.take(reading(report(time), time * ms));
    expect(lefts(history, 133 * ms)).toEqual([133]);
    expect(history.of(133 * ms)?.age).toBe(0);
  });

  it('gives what was found before, and says how much older that is', () => {
    const history = new OverlayHistory(overlay);
    history.take(reading(report(100), 100 * ms));
    history.take(reading(report(300), 300 * ms));
    expect(lefts(history, 200 * ms)).toEqual([100]);
    expect(history.of(200 * ms)?.age).toBeCloseTo(0.1, 9);
    expect(history.of(99 * ms)).toBeUndefined(); // never of a later picture
  });

  it('takes the last word on a picture', () => {
    const history = new OverlayHistory(overlay);
    history.take(reading(report(1), 100 * ms));
    history.take(reading(report(1, 2), 100 * ms));
    expect(lefts(history, 100 * ms)).toEqual([1, 2]);
    history.take(reading(report(), 100 * ms));
    expect(lefts(history, 100 * ms)).toEqual([]);
  });

  it('reads the time of the picture where the row says so', () => {
    const history = new OverlayHistory({ ...overlay, time: { of: 'slot', field: 'taken' } });
    history.take(reading({ taken: 70 * ms, regions: [{ left: 7 }] }, 99 * ms));
    expect(history.of(70 * ms)?.age).toBe(0);
    history.take(reading({ regions: [{ left: 8 }] }, 99 * ms)); // no time: of no picture
    expect(lefts(history, 99 * ms)).toEqual([7]);
  });

  it('sorts a ring of the last things by their pictures, and keeps what the ring has lost', () => {
    const history = new OverlayHistory({ ...overlay, time: { of: 'thing', field: 'job.time' } });
    const thing = (left: number, time: number): Value => ({ left, job: { time: time * ms } });
    history.take(reading({ regions: [thing(1, 10), thing(2, 20), thing(3, 10)] }));
    expect(lefts(history, 10 * ms)).toEqual([1, 3]);
    history.take(reading({ regions: [thing(5, 30), thing(2, 20), thing(3, 10)] }));
    expect(lefts(history, 10 * ms)).toEqual([1, 3]);
    expect(lefts(history, 20 * ms)).toEqual([2]);
    expect(lefts(history, 30 * ms)).toEqual([5]);
  });

  it('forgets with its writer, and with one that begins anew', () => {
    const history = new OverlayHistory(overlay);
    expect(history.reason).toBe('nothing yet');
    history.take(reading(report(1), 100 * ms));
    expect(history.reason).toBe('');
    history.take(reading(null));
    expect(history.reason).toBe('writer retired');
    expect(history.of(100 * ms)).toBeUndefined();
    history.take(reading(report(1), 900 * ms));
    history.take({ ...reading(report(2), 100 * ms), sequence: 1 });
    expect(lefts(history, 900 * ms)).toEqual([2]);
    sequence = 1;
  });

  it('remembers no more than it needs', () => {
    const history = new OverlayHistory(overlay);
    for (let time = 1; time <= 100; time += 1) history.take(reading(report(time), time * ms));
    expect(lefts(history, 69 * ms)).toEqual([69]);
    expect(history.of(68 * ms)).toBeUndefined();
  });
});
