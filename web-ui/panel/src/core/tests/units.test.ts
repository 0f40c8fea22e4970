import { describe, expect, it, vi } from 'vitest';
import { formatNumber } from '../format_number';
import { DisplayUnits } from '../units';

describe('display units', () => {
  it('are those of a workshop unless SI is chosen', () => {
    const units = new DisplayUnits();
    expect(units.toDisplay(0.25, 'm')).toBe(250);
    expect(units.fromDisplay(250, 'm')).toBe(0.25);
    expect(units.toDisplay(Math.PI, 'rad')).toBeCloseTo(180, 12);
    expect(units.fromDisplay(180, 'rad')).toBeCloseTo(Math.PI, 12);
    expect(units.of('rad/s').text).toBe('°/s');
    expect([units.of('1').text, units.of('N*m').text, units.of('kg').text, units.of('').text]).toEqual(['', 'N·m', 'kg', '']);
    const told = vi.fn();
    const end = units.watch(told);
    units.si = true;
    units.si = true;
    expect(told).toHaveBeenCalledOnce();
    expect(units.of('m')).toEqual({ text: 'm', factor: 1 });
    expect(units.of('m/s^2').text).toBe('m/s²');
    end();
    units.si = false;
    expect(told).toHaveBeenCalledOnce();
  });
  it('are kept', () => {
    localStorage.clear();
    new DisplayUnits(localStorage).si = true;
    expect(new DisplayUnits(localStorage).si).toBe(true);
    localStorage.clear();
  });
});

describe('formatNumber', () => {
  it.each([
    [0, {}, '0'], [1.23456, {}, '1.235'], [-1.5, {}, '−1.500'], [12345.6, {}, '12346'], [0.00001234, {}, '1.234e−5'],
    [3e12, {}, '3.000e+12'], [NaN, {}, 'not a number'], [-Infinity, {}, '−∞'], [5, { integer: true }, '5'], [2 ** 53 - 1, { integer: true }, '9007199254740991'],
    [2 ** 53, { integer: true }, '≈ 9007199254740992'], [-72057319193579525, { integer: true }, '≈ −72057319193579530'],
    [-5, { integer: true }, '−5'], [0.5, { range: [0, 100] }, '0.5'], [100, { range: [0, 100] }, '100.0'],
    [-0.001, { range: [0, 100] }, '0.0'], [1.5, { digits: 2 }, '1.5'],
  ] as const)('%d with %o is %s', (value, options, expected) => {
    expect(formatNumber(value, options)).toBe(expected);
  });
});
