import { afterEach, describe, expect, it } from 'vitest';
import type { ItemInfo } from '../../contract';
import { formatNumber } from '../../core/format_number';
import { displayUnits } from '../../core/units';
import { isWide, Quantity } from '../quantity';
import { sameValue } from '../../core/same_value';
import { anyText } from '../value_text';

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
    expect(quantity.parse('+5.')).toEqual({ value: 0.005 });
    expect(quantity.parse(',5')).toEqual({ value: 0.0005 });
  });

  it('refuses what is no number, or out of range, in the shown unit', () => {
    const quantity = new Quantity(step);
    for (const text of ['', 'abc', 'NaN', 'Infinity', '1,2,3', '0x10', '0b11', '0o7', '1_000', '.', 'e3', '--1']) expect(quantity.parse(text)).toHaveProperty('problem');
    expect(quantity.parse('200')).toEqual({ problem: 'only 1 to 100 mm' });
  });

  it('takes the shown end of the range for its exact end', () => {
    const quantity = new Quantity({ scalar: 'f64', unit: 'rad', range: [0.001, 0.5] });
    expect(quantity.parse(quantity.plain(0.5))).toEqual({ value: 0.5 });
    expect(quantity.parse(quantity.plain(0.001))).toEqual({ value: 0.001 });
  });

  it('has fine and coarse steps of 1, 2 or 5 in a range that is not wide', () => {
    const steps = new Quantity(step).steps(0.01);
    expect(steps.fine).toBeCloseTo(0.2);
    expect(steps.coarse).toBeCloseTo(2);
    expect(new Quantity({ scalar: 'u8', unit: '', range: [0, 8] }).steps(4).fine).toBe(1);
    expect(new Quantity(step, { fine: 0.005, coarse: 0.05 }).steps(0.01)).toEqual({ fine: 5, coarse: 50 });
    // Not more than a part of the value: of 2 s in a range of ten minutes not 2 s.
    const patience = new Quantity({ scalar: 'f64', unit: 's', range: [0.5, 600], default: 2 });
    expect(patience.steps(2)).toEqual({ fine: 0.1, coarse: 1 });
    expect(patience.steps(500)).toEqual({ fine: 2, coarse: 20 });
  });

  it('has steps by the value in a wide range, and in none', () => {
    const limit = new Quantity({ scalar: 'f64', unit: '1', range: [-1e6, 1e6], default: 1000 });
    expect(limit.steps(1000)).toEqual({ fine: 10, coarse: 100 });
    expect(limit.steps(-0.65).fine).toBeCloseTo(0.001, 12);
    expect(limit.steps(0)).toEqual({ fine: 10, coarse: 100 }); // of its default
    expect(new Quantity({ scalar: 'u32', unit: '', range: [0, 100_000], default: 0 }).steps(0)).toEqual({ fine: 1, coarse: 10 });
    expect(new Quantity({ scalar: 'u32', unit: '', range: [0, 100_000], default: 0 }).steps(5000)).toEqual({ fine: 10, coarse: 100 });
    expect(new Quantity({ scalar: 'f64', unit: '1' }).steps(0)).toEqual({ fine: 0.01, coarse: 0.1 });
    expect(new Quantity({ scalar: 'f64', unit: '1' }).steps(Number.NaN)).toEqual({ fine: 0.01, coarse: 0.1 });
  });

  it('has the steps of the table', () => {
    const quantity = new Quantity({ scalar: 'f64', unit: 'm', range: [-1, 1], default: 0, step: 0.0005 });
    expect(quantity.steps(0.3)).toEqual({ fine: 0.5, coarse: 5 });
    expect(quantity.stepped(0.1234, 0.5)).toBe(0.1239);
  });

  it('tells a wide range from one in which a slider is of use', () => {
    expect(isWide({ range: [0, 10], default: 5 })).toBe(false);
    expect(isWide({ range: [0, 100_000], default: 0 })).toBe(true);
    expect(isWide({ range: [-1e6, 1e6], default: -0.01 })).toBe(true);
    expect(isWide({ range: [0, 1], default: 0.0005 })).toBe(true);
    expect(isWide({ range: [0, 1], default: 0.0005, step: 0.001 })).toBe(false);
    expect(isWide({ range: [0, 100_000], default: 500, step: 1 })).toBe(true);
    expect(isWide({ default: 5 })).toBe(true);
  });

  it('shows as many digits in a field of its own as its value has need of', () => {
    const limit = new Quantity({ scalar: 'f64', unit: '1', range: [-1e6, 1e6], default: 1000 });
    expect(limit.entry(100_000)).toBe('100000');
    expect(limit.entry(0.651)).toBe('0.6510');
    expect(limit.stepped(0.651, 0.001)).toBe(0.652);
    expect(limit.stepped(999_999.5, 10)).toBe(1e6);
  });

  it('never shows a zero with a sign', () => {
    for (const quantity of [new Quantity({ scalar: 'f64', unit: 'm' }), new Quantity(step), new Quantity({ scalar: 'i16', unit: 'm' })]) {
      for (const value of [-0, -1e-15, -1e-300]) {
        expect([quantity.text(value), quantity.plain(value), quantity.entry(value)].join(' ')).not.toMatch(/[-−]/);
      }
    }
    for (const value of [-0, -1e-300]) expect(anyText(value)).not.toMatch(/[-−]0$/);
    expect(formatNumber(-0.04, { range: [-100, 100] })).toBe('0.0');
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
