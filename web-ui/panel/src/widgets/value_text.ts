// Any value in words.
import type { ItemInfo, Reading, Value } from '../contract';
import { significantText } from '../core/units';
import { isNumeric, type Quantity } from './quantity';

/** "no_key" → "no key". */
export function words(name: string): string {
  return name.replaceAll('_', ' ');
}

/** One value of a scalar item, or one element of an array of them. */
export function scalarText(item: Pick<ItemInfo, 'scalar'>, quantity: Quantity, value: Value): string {
  if (typeof value === 'number' && isNumeric(item.scalar)) return quantity.text(value);
  if (typeof value === 'boolean') return value ? 'on' : 'off';
  if (typeof value === 'string') return item.scalar === 'enumeration' ? words(value) : value;
  return anyText(value);
}

/** A structure or list that no widget takes apart. */
export function anyText(value: Value): string {
  if (Array.isArray(value)) return value.map(anyText).join(', ');
  if (typeof value === 'object') {
    return Object.entries(value).map(([name, member]) => `${words(name)} ${anyText(member)}`).join('; ');
  }
  if (typeof value === 'number') return significantText(value, 6);
  return typeof value === 'boolean' ? (value ? 'on' : 'off') : value;
}

/** Why a reading has no value; empty when it has one, or a picture. */
export function absence(reading: Reading): string {
  return reading.value === null && !reading.image ? reading.reason || 'no value' : '';
}

/** Below `low` or above `high` of the widget's options, in words and with a sign; empty between them. */
export function abnormality(value: number, options: { readonly [name: string]: Value }): string {
  const { low, high } = options;
  if (Number.isNaN(value)) return '⚠ not a number';
  if (typeof high === 'number' && value > high) return '▲ high';
  if (typeof low === 'number' && value < low) return '▼ low';
  return '';
}
