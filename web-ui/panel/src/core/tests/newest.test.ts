// @vitest-environment node
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { SetOptions } from '../../contract';
import { Newest } from '../newest';

describe('Newest', () => {
  let begun: number[];
  let ends: (() => void)[];
  let newest: Newest<number | undefined>;
  const run = (value: number, options?: SetOptions): Promise<number | undefined> => newest.run(() => {
    begun.push(value);
    return new Promise((resolve) => ends.push(() => resolve(10 * value)));
  }, options);
  const end = async (index: number): Promise<void> => {
    ends[index]!();
    await vi.advanceTimersByTimeAsync(0);
  };

  beforeEach(() => {
    vi.useFakeTimers();
    begun = [];
    ends = [];
    newest = new Newest<number | undefined>(undefined);
  });
  afterEach(() => void vi.useRealTimers());

  it('begins the first at once, and of those that come meanwhile only the newest, at its end', async () => {
    const results = [1, 2, 3].map((value) => run(value));
    expect(begun).toEqual([1]);
    await end(0);
    expect(await results[0]).toBe(10);
    expect(begun).toEqual([1, 3]);
    await end(1);
    expect(await Promise.all(results.slice(1))).toEqual([30, 30]);
    void run(4);
    expect(begun).toEqual([1, 3, 4]);
  });

  it('keeps beginnings apart, and begins the last though nothing follows', async () => {
    const spaced = { spacing: 100 };
    void run(1, spaced);
    await end(0);
    void run(2, spaced);
    await vi.advanceTimersByTimeAsync(60);
    void run(3, spaced);
    expect(begun).toEqual([1]);
    await vi.advanceTimersByTimeAsync(39);
    expect(begun).toEqual([1]);
    await vi.advanceTimersByTimeAsync(1);
    expect(begun).toEqual([1, 3]);
  });

  it('does not begin one before the end of the other, however long that lasts', async () => {
    void run(1);
    void run(2, { spacing: 100 });
    await vi.advanceTimersByTimeAsync(500);
    expect(begun).toEqual([1]);
    await end(0);
    expect(begun).toEqual([1, 2]);
  });

  it('goes by the spacing of the one that is to begin', async () => {
    void run(1, { spacing: 100 });
    await end(0);
    void run(2);
    expect(begun).toEqual([1, 2]);
  });

  it('leaves out what was withdrawn while it waited, for an end or for its time', async () => {
    const first = new AbortController();
    void run(1, first);
    const withdrawn = run(2, first);
    first.abort();
    await end(0);
    expect(await withdrawn).toBeUndefined();
    expect(begun).toEqual([1]);

    const second = new AbortController();
    void run(3, { spacing: 100, signal: second.signal });
    second.abort();
    await vi.advanceTimersByTimeAsync(1000);
    expect(begun).toEqual([1]);
    expect(vi.getTimerCount()).toBe(0);
    void run(4);
    expect(begun).toEqual([1, 4]);
  });

  it('begins what was asked for anew after a withdrawal', async () => {
    const given = new AbortController();
    void run(1, given);
    void run(2, given);
    given.abort();
    void run(3);
    await end(0);
    expect(begun).toEqual([1, 3]);
  });

  it('goes on after one that failed', async () => {
    const failed = newest.run(() => Promise.reject(new Error('no')));
    void run(2);
    await expect(failed).rejects.toThrow('no');
    await vi.advanceTimersByTimeAsync(0);
    expect(begun).toEqual([2]);
  });
});
