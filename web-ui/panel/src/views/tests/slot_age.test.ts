import { expect, it } from 'vitest';
import { ageNow } from '../slot_age';
import { reading } from '../../core/tests/fake_core';

it('grows only when no other value followed', () => {
  const value = reading(1, { age: 0.02 });
  expect(ageNow(value, 1000, 1300)).toBe(0.02);
  expect(ageNow(value, 1000, 3000)).toBeCloseTo(2.02);
});
