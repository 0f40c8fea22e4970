// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { partOf, partsOf, rootOf, withPart } from '../value_path';

describe('paths of values', () => {
  it('are taken apart', () => {
    expect(partsOf('gain')).toEqual(['gain']);
    expect(partsOf('gains[2]')).toEqual(['gains', 2]);
    expect(partsOf('axes[1].limits.low')).toEqual(['axes', 1, 'limits', 'low']);
    expect(rootOf('axes[1].limits.low')).toBe('axes');
    expect(rootOf('gain')).toBe('gain');
  });

  const whole = { limits: { low: 1, high: 2 }, map: [[1, 2], [3, 4]] };

  it('lead to parts', () => {
    expect(partOf(whole, ['limits', 'low'])).toBe(1);
    expect(partOf(whole, ['map', 1, 0])).toBe(3);
    expect(partOf(whole, ['map', 7, 0])).toBeUndefined();
    expect(partOf(whole, ['limits', 'low', 'x'])).toBeUndefined();
    expect(partOf(undefined, [])).toBeUndefined();
  });

  it('replace parts in a copy', () => {
    expect(withPart(whole, ['map', 1, 0], 9)).toEqual({ limits: { low: 1, high: 2 }, map: [[1, 2], [9, 4]] });
    expect(whole.map[1]![0]).toBe(3);
    expect(withPart(whole, ['limits', 'low'], 0)).toMatchObject({ limits: { low: 0, high: 2 } });
    expect(withPart(5, [], 6)).toBe(6);
    expect(withPart(whole, ['nothing', 'low'], 0)).toBe(whole);
  });
});
