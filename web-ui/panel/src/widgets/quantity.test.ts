import { afterEach, describe, expect, it } from 'vitest';
import type { ItemInfo } from '../contract';
import { displayUnits } from '../core/units';
import { Quantity } from './quantity';
import { sameValue } from './same_value';

type Measured = Pick<ItemInfo, 'scalar' | 'unit' | 'range' | 'default'>;
const step: Measured = { scalar: 'f64', unit: 'm', range: [0.001, 0.1], default: 0.01 };

afterEach(() => void (displayUnits.si = false));

describe('Quantity', () => {
  it('shows the unit of the person, with decimals by the range', () => {
    const quantity = new Quantity(step);
    expect(quantity.unit).toBe('mm');
    expect(quantity.text(0.0123456)).toBe('12.3');
    displayUnits.si = true;
    expect(new Quantity(step).text(0.0123456)).toBe('0.0123');
  });

  it('keeps a small default visible', () => {
    expect(new Quantity({ scalar: 'f64', unit: 's', range: [0, 10], default: 0.00002 }).text(0.00002)).not.toBe('0.000');
  });

  it('has fewer decimals once a larger value was seen, and keeps them', () => {
    const quantity = new Quantity({ scalar: 'f64', unit: '1' });
    expect(quantity.text(0)).toBe('0.000');
    expect(quantity.text(123.456)).toBe('123.5');
    expect(quantity.text(0.5)).toBe('0.5');
  });

  it('shows whole numbers whole', () => {
    const quantity = new Quantity({ scalar: 'u64', unit: '' });
    expect(quantity.text(9007199254740991)).toBe('9007199254740991');
    expect(quantity.parse('1.5')).toEqual({ problem: 'only whole numbers' });
    expect(quantity.parse('7')).toEqual({ value: 7 });
  });

  it('reads commas, signs, exponents and its own unit', () => {
    const quantity = new Quantity({ scalar: 'f64', unit: 'm' });
    expect(quantity.parse('12,5')).toEqual({ value: 0.0125 });
    expect(quantity.parse('−3 mm')).toEqual({ value: -0.003 });
    expect(quantity.parse('1e3')).toEqual({ value: 1 });
  });

  it('refuses what is no number, or out of range, in the shown unit', () => {
    const quantity = new Quantity(step);
    for (const text of ['', 'abc', 'NaN', 'Infinity', '1,2,3']) expect(quantity.parse(text)).toHaveProperty('problem');
    expect(quantity.parse('200')).toEqual({ problem: 'only 1 to 100 mm' });
  });

  it('takes the shown end of the range for its exact end', () => {
    const quantity = new Quantity({ scalar: 'f64', unit: 'rad', range: [0.001, 0.5] });
    expect(quantity.parse(quantity.plain(0.5))).toEqual({ value: 0.5 });
    expect(quantity.parse(quantity.plain(0.001))).toEqual({ value: 0.001 });
  });

  it('has fine and coarse steps of 1, 2 or 5', () => {
    const quantity = new Quantity(step);
    expect(quantity.fine).toBeCloseTo(0.2);
    expect(quantity.coarse).toBeCloseTo(2);
    expect(new Quantity({ scalar: 'u8', unit: '', range: [0, 8] }).fine).toBe(1);
    expect(new Quantity(step, { fine: 0.005, coarse: 0.05 }).fine).toBeCloseTo(5);
  });

  it('tells where a value lies in its range', () => {
    const quantity = new Quantity({ scalar: 'f64', unit: '1', range: [-1, 1] });
    expect(quantity.fraction(0)).toBe(0.5);
    expect(quantity.fraction(5)).toBe(1);
    expect(quantity.fraction(Number.NaN)).toBeUndefined();
    expect(new Quantity({ scalar: 'f64', unit: '1' }).fraction(0)).toBeUndefined();
  });
});

describe('sameValue', () => {
  it('compares as the unit keeps it', () => {
    expect(sameValue(Math.fround(0.1), 0.1, 'f32')).toBe(true);
    expect(sameValue(Math.fround(0.1), 0.1, 'f64')).toBe(false);
    expect(sameValue([[1, 2]], [[1, 2]], 'f64')).toBe(true);
    expect(sameValue([1, 2], [1, 3], 'f64')).toBe(false);
    expect(sameValue({ low: 1 }, { low: 1 }, 'structure')).toBe(true);
    expect(sameValue({ low: 1 }, { high: 1 }, 'structure')).toBe(false);
    expect(sameValue('red', 'green', 'enumeration')).toBe(false);
  });
});
