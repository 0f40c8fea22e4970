// Whether two values are the same, field by field.
import type { Value } from '../contract';

export function equalValues(one: Value | null | undefined, other: Value | null | undefined): boolean {
  if (one === other) return true;
  if (typeof one !== 'object' || typeof other !== 'object' || one === null || other === null) return false;
  if (Array.isArray(one) || Array.isArray(other)) {
    if (!Array.isArray(one) || !Array.isArray(other) || one.length !== other.length) return false;
    return one.every((value, i) => equalValues(value, other[i]));
  }
  const names = Object.keys(one);
  return names.length === Object.keys(other).length && names.every((name) => equalValues(one[name], other[name]));
}
