// Parts of a configuration value that is being edited, by the path that requests use.
import type { Value } from '../contract';
import type { Part } from '../core/value_path';

/** The parameter that a path begins with. */
export function rootOf(path: string): string {
  return /^[^.[]*/.exec(path)![0];
}

/** A copy of the whole with this part replaced; what there is no such part of comes back as it is. */
export function withPart(whole: Value, parts: readonly Part[], value: Value): Value {
  const [part, ...rest] = parts;
  if (part === undefined) return value;
  if (typeof whole !== 'object') return whole;
  if (Array.isArray(whole)) {
    return whole.map((element, i) => (i === part ? withPart(element, rest, value) : element));
  }
  const inner = whole[part];
  return inner === undefined ? whole : { ...whole, [part]: withPart(inner, rest, value) };
}
