// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { budgetUse, bucketBounds, columnsOf, height, histogramPath, LogAxis } from '../histogram_scale';

// As Histogram::bucket_of of the runtime.
function bucketOf(value: number): number {
  if (value < 16) return value;
  const octave = Math.floor(Math.log2(value)) - 4;
  return 16 * octave + Math.floor(value / 2 ** octave);
}

describe('bucketBounds', () => {
  it('is the inverse of the runtime\'s bucketing', () => {
    for (const value of [0, 1, 15, 16, 31, 32, 33, 1000, 4095, 4096, 1e6, 123456789, 2 ** 39 + 5]) {
      const [low, high] = bucketBounds(bucketOf(value));
      expect(low).toBeLessThanOrEqual(value);
      expect(high).toBeGreaterThan(value);
    }
  });

  it('leaves no gap', () => {
    for (let bucket = 0; bucket + 1 < 16 * 38; ++bucket) expect(bucketBounds(bucket)[1]).toBe(bucketBounds(bucket + 1)[0]);
  });
});

describe('columnsOf', () => {
  it('adds four buckets up and keeps their bounds', () => {
    const columns = columnsOf([64, 5, 65, 1, 67, 2, 68, 9]);
    expect(columns).toEqual([
      { low: bucketBounds(64)[0], high: bucketBounds(67)[1], count: 8 },
      { low: bucketBounds(68)[0], high: bucketBounds(71)[1], count: 9 },
    ]);
  });

  it('puts everything below 16 ns in one', () => {
    expect(columnsOf([0, 1, 3, 2, 15, 3])).toEqual([{ low: 0, high: 16, count: 6 }]);
  });

  it('loses nothing', () => {
    const buckets = Array.from({ length: 300 }, (_, i) => [i * 2, i + 1]).flat();
    const sum = columnsOf(buckets).reduce((all, column) => all + column.count, 0);
    expect(sum).toBe((300 * 301) / 2);
  });
});

describe('LogAxis', () => {
  it('spans whole decades', () => {
    const axis = LogAxis.over([12_000, 340_000]);
    expect(axis.ticks).toEqual([10_000, 100_000, 1_000_000]);
    expect(axis.place(10_000)).toBe(0);
    expect(axis.place(100_000)).toBeCloseTo(0.5);
    expect(axis.place(1_000_000)).toBe(1);
  });

  it('holds what lies beyond at its ends', () => {
    const axis = LogAxis.over([1000, 2000]);
    expect(axis.place(0)).toBe(0);
    expect(axis.place(1)).toBe(0);
    expect(axis.place(1e12)).toBe(1);
  });

  it('has two decades at least, also of nothing', () => {
    expect(LogAxis.over([1000]).ticks).toEqual([1e3, 1e4, 1e5]);
    expect(LogAxis.over([]).ticks).toEqual([1e3, 1e4, 1e5]);
    expect(LogAxis.over([0]).ticks).toEqual([10, 100, 1000]);
    expect(LogAxis.over([Number.NaN, -5]).ticks).toEqual([1e3, 1e4, 1e5]);
  });
});

describe('height and path', () => {
  it('shows one among a million', () => {
    expect(height(0, 1e6)).toBe(0);
    expect(height(1, 1e6)).toBeGreaterThan(0.1);
    expect(height(1e6, 1e6)).toBe(1);
  });

  it('draws each column that is not empty, from the ground', () => {
    const axis = LogAxis.over([1000, 100_000]);
    const path = histogramPath([{ low: 1000, high: 10_000, count: 10 }, { low: 10_000, high: 20_000, count: 0 }], axis, 200, 50);
    expect(path).toBe('M0 50V0H100V50Z');
  });

  it('draws nothing of nothing', () => {
    expect(histogramPath([], LogAxis.over([]), 200, 50)).toBe('');
  });
});

describe('budgetUse', () => {
  const histogram = { count: 9, p50_ns: 1, p99_ns: 2, 'p99.9_ns': 150, max_ns: 400, buckets: [] };
  it('compares p99.9 with the budget', () => {
    expect(budgetUse(300, histogram)).toEqual({ share: 0.5, over: false });
    expect(budgetUse(100, histogram)).toEqual({ share: 1.5, over: true });
  });
  it('knows nothing without a budget or a measurement', () => {
    expect(budgetUse(0, histogram).share).toBeNull();
    expect(budgetUse(300, { ...histogram, count: 0 }).share).toBeNull();
  });
});
