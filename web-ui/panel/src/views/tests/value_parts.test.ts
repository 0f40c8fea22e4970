// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { rootOf, withPart } from '../value_parts';

describe('parts of an edited value', () => {
  const whole = { limits: { low: 1, high: 2 }, map: [[1, 2], [3, 4]] };

  it('are of a parameter', () => {
    expect(rootOf('axes[1].limits.low')).toBe('axes');
    expect(rootOf('gain')).toBe('gain');
  });

  it('replace parts in a copy', () => {
    expect(withPart(whole, ['map', 1, 0], 9)).toEqual({ limits: { low: 1, high: 2 }, map: [[1, 2], [9, 4]] });
    expect(whole.map[1]![0]).toBe(3);
    expect(withPart(whole, ['limits', 'low'], 0)).toMatchObject({ limits: { low: 0, high: 2 } });
    expect(withPart(5, [], 6)).toBe(6);
    expect(withPart(whole, ['nothing', 'low'], 0)).toBe(whole);
  });
});
