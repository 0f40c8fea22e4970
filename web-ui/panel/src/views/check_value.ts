// Whether a value may be in force, as far as the descriptor tells; the server has the last word.
import type { ItemInfo, Value } from '../contract';

/** Why not, with the item's label; empty when it may. */
export function checkValue(item: ItemInfo, value: Value): string {
  const fault = faultOf(item, value);
  return fault === '' ? '' : `${item.label}: ${fault}`;
}

function faultOf(item: ItemInfo, value: Value): string {
  if (Array.isArray(value)) {
    for (const element of value) {
      const fault = faultOf(item, element);
      if (fault !== '') return fault;
    }
    return '';
  }
  if (typeof value === 'object') {
    for (const member of item.members ?? []) {
      const name = member.path?.split('.').at(-1) ?? member.label;
      const inner = value[name];
      const fault = inner === undefined ? '' : faultOf(member, inner);
      if (fault !== '') return `${member.label}: ${fault}`;
    }
    return '';
  }
  if (typeof value === 'number') {
    if (!Number.isFinite(value)) return 'is not a number';
    if (item.scalar !== 'f32' && item.scalar !== 'f64' && !Number.isInteger(value)) return 'must be a whole number';
    const [low, high] = item.range ?? [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
    if (value < low || value > high) return `must lie from ${low} to ${high}${item.unit === '' || item.unit === '1' ? '' : ` ${item.unit}`}`;
  }
  if (typeof value === 'string' && item.scalar === 'enumeration' && item.values && !item.values.includes(value)) {
    return `must be one of ${item.values.join(', ')}`;
  }
  return '';
}
