// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { lastOf, partOf, partsOf, valueAt } from '../value_path';

describe('paths of values', () => {
  it('are taken apart', () => {
    expect(partsOf('gain')).toEqual(['gain']);
    expect(partsOf('gains[2]')).toEqual(['gains', 2]);
    expect(partsOf('axes[1].limits.low')).toEqual(['axes', 1, 'limits', 'low']);
    expect(lastOf('axes[1].limits.low')).toBe('low');
    expect(lastOf('gain')).toBe('gain');
  });

  const whole = { limits: { low: 1, high: 2 }, map: [[1, 2], [3, 4]] };

  it('lead to parts', () => {
    expect(partOf(whole, ['limits', 'low'])).toBe(1);
    expect(partOf(whole, ['map', 1, 0])).toBe(3);
    expect(partOf(whole, ['map', 7, 0])).toBeUndefined();
    expect(partOf(whole, ['limits', 'low', 'x'])).toBeUndefined();
    expect(partOf(undefined, [])).toBeUndefined();
  });
});

describe('valueAt', () => {
  it('finds members and elements of what the answer has whole', () => {
    const values = { gain: 1, gains: [1, 2, 3], limits: { low: [[4, 5], [6, 7]] } };
    expect(valueAt(values, 'gain')).toBe(1);
    expect(valueAt(values, 'gains[2]')).toBe(3);
    expect(valueAt(values, 'limits.low[1][0]')).toBe(6);
    expect(valueAt(values, 'limits.high')).toBeUndefined();
    expect(valueAt(values, 'other[1]')).toBeUndefined();
    expect(valueAt(undefined, 'gain')).toBeUndefined();
    expect(valueAt({ 'gains[1]': 7, gains: [1, 2] }, 'gains[1]')).toBe(7);
    expect(valueAt(values, undefined)).toBeUndefined();
  });
});
