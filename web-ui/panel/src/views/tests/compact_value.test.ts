// @vitest-environment node
import { describe, expect, it } from 'vitest';
import type { ItemInfo, Value } from '../../contract';
import { DisplayUnits } from '../../core/units';
import { compactText } from '../compact_value';

const field = (name: string, more: Partial<ItemInfo> = {}): ItemInfo => ({
  key: `slot:pose.${name}`, label: name, summary: '', scalar: 'f64', shape: [], unit: '', kind: 'slot', ...more,
});
const pose: ItemInfo = {
  ...field('', { key: 'slot:pose', scalar: 'structure' }),
  members: [field('position', { unit: 'm', shape: [2] }), field('count', { scalar: 'u64' }), field('ready', { scalar: 'bool' })],
};

describe('compactText', () => {
  it('names the fields and converts to the units on display', () => {
    const value: Value = { position: [0.42, -1.5], count: 12, ready: true };
    expect(compactText(pose, value, new DisplayUnits())).toBe('position 420.0 −1500 mm · count 12 · ready on');
  });

  it('parts the rows of a matrix', () => {
    expect(compactText(field('m', { scalar: 'i32', shape: [2, 2] }), [[1, 2], [3, 4]], new DisplayUnits())).toBe('1 2; 3 4');
  });

  it('shows structures that it knows nothing of', () => {
    expect(compactText({ ...pose, members: [] }, { inner: { a: false, b: 'text' } }, new DisplayUnits())).toBe('inner {a off · b text}');
  });

  it('is short', () => {
    const many = Array.from({ length: 500 }, () => 1234);
    const text = compactText(field('many', { scalar: 'i32', shape: [500] }), many, new DisplayUnits());
    expect(text.length).toBe(96);
    expect(text.endsWith('…')).toBe(true);
  });

  it('shows that a text is empty', () => {
    expect(compactText(field('t', { scalar: 'text' }), '', new DisplayUnits())).toBe('“”');
  });
});
