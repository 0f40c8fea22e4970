// @vitest-environment node
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Newest } from '../newest';

interface Value {
  readonly value: number;
}

describe('Newest', () => {
  let begun: number[];
  let ends: (() => boolean)[];
  let spacing: number;
  let newest: Newest<Value>;
  const put = (...values: number[]): void => values.forEach((value) => newest.put({ value }));

  beforeEach(() => {
    vi.useFakeTimers();
    begun = [];
    ends = [];
    spacing = 0;
    newest = new Newest<Value>(({ value }, done) => {
      begun.push(value);
      ends.push(done);
    }, () => spacing);
  });
  afterEach(() => void vi.useRealTimers());

  it('begins the first at once, and of those that come meanwhile only the newest, at its end', () => {
    expect(newest.pending).toBe(false);
    put(1, 2, 3);
    expect(begun).toEqual([1]);
    expect(newest.waiting).toEqual({ value: 3 });
    expect(ends[0]!()).toBe(true);
    expect(begun).toEqual([1, 3]);
    expect(newest.waiting).toBeUndefined();
    expect(newest.pending).toBe(true);
    expect(ends[1]!()).toBe(true);
    expect(newest.pending).toBe(false);
    put(4);
    expect(begun).toEqual([1, 3, 4]);
  });

  it('keeps beginnings apart, and begins the last though nothing follows', async () => {
    spacing = 100;
    put(1);
    ends[0]!();
    put(2);
    await vi.advanceTimersByTimeAsync(60);
    put(3);
    expect(begun).toEqual([1]);
    await vi.advanceTimersByTimeAsync(39);
    expect(begun).toEqual([1]);
    await vi.advanceTimersByTimeAsync(1);
    expect(begun).toEqual([1, 3]);
  });

  it('does not begin one before the end of the other, however long that lasts', async () => {
    spacing = 100;
    put(1, 2);
    await vi.advanceTimersByTimeAsync(500);
    expect(begun).toEqual([1]);
    ends[0]!();
    expect(begun).toEqual([1, 2]);
  });

  it('asks for the spacing when one is to begin', () => {
    spacing = 100;
    put(1);
    ends[0]!();
    spacing = 0;
    put(2);
    expect(begun).toEqual([1, 2]);
  });

  it('forgets all when it is cancelled: what waits, for an end or for its time, and what is under way', async () => {
    put(1, 2);
    newest.cancel();
    expect(newest.pending).toBe(false);
    put(3);
    expect(begun).toEqual([1, 3]);
    put(4);
    expect(ends[0]!()).toBe(false); // of another's that is under way it is not the end
    expect(begun).toEqual([1, 3]);
    spacing = 100;
    ends[1]!();
    newest.cancel();
    expect(vi.getTimerCount()).toBe(0);
    await vi.advanceTimersByTimeAsync(1000);
    expect(begun).toEqual([1, 3]);
  });

  it('takes the end of one once', () => {
    put(1, 2);
    ends[0]!();
    put(3);
    expect(ends[0]!()).toBe(false);
    expect(begun).toEqual([1, 2]);
  });
});
