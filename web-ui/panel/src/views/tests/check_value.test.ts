// @vitest-environment node
import { expect, it } from 'vitest';
import type { ItemInfo, Value } from '../../contract';
import { checkValue } from '../check_value';

const number: ItemInfo = {
  key: 'a.configuration.gain', label: 'Gain', summary: '', scalar: 'f64', shape: [], unit: 'm', range: [0, 2],
  kind: 'configuration', component: 'a', path: 'gain',
};

it.each<[Partial<ItemInfo>, Value, string]>([
  [{}, 1, ''],
  [{}, 3, 'Gain: must lie from 0 to 2 m'],
  [{}, Number.NaN, 'Gain: is not a number'],
  [{ scalar: 'u8', unit: '' }, 1.5, 'Gain: must be a whole number'],
  [{ shape: [3] }, [1, 2, 5], 'Gain: must lie from 0 to 2 m'],
  [{ scalar: 'enumeration', values: ['on', 'off'] }, 'half', 'Gain: must be one of on, off'],
  [{ scalar: 'enumeration', values: ['on', 'off'] }, 'off', ''],
  [{ scalar: 'structure', members: [{ ...number, label: 'Low', path: 'gain.low' }] }, { low: 4 }, 'Gain: Low: must lie from 0 to 2 m'],
])('%o with %o: %s', (change, value, fault) => {
  expect(checkValue({ ...number, ...change }, value)).toBe(fault);
});
