// Whether two values are the same to the unit that holds them.
import type { Scalar, Value } from '../contract';

export function sameValue(a: Value | null | undefined, b: Value | null | undefined, scalar: Scalar): boolean {
  if (a === b) return true;
  if (typeof a === 'number' && typeof b === 'number') {
    // A default of 0.1 comes back from an f32 as 0.10000000149.
    return (scalar === 'f32' && Math.fround(a) === Math.fround(b)) || (Number.isNaN(a) && Number.isNaN(b));
  }
  if (Array.isArray(a) && Array.isArray(b)) {
    return a.length === b.length && a.every((element, i) => sameValue(element, b[i], scalar));
  }
  if (isRecord(a) && isRecord(b)) {
    const names = Object.keys(a);
    return names.length === Object.keys(b).length && names.every((name) => sameValue(a[name], b[name], 'f32'));
  }
  return false;
}

function isRecord(value: Value | null | undefined): value is { [field: string]: Value } {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
