// Parts of a value by the path that requests use: "gains[2]", "limits.low", "map[1][0]".
import type { Value } from '../contract';

type Part = string | number;

/** "limits.low" → ["limits", "low"]; "gains[2]" → ["gains", 2]. */
export function partsOf(path: string): Part[] {
  return [...path.matchAll(/([^.[\]]+)|\[(\d+)\]/g)].map((match) => (match[2] === undefined ? match[1]! : Number(match[2])));
}

/** The parameter that a path begins with. */
export function rootOf(path: string): string {
  return /^[^.[]*/.exec(path)![0];
}

/** undefined where there is no such part. */
export function partOf(whole: Value | undefined, parts: readonly Part[]): Value | undefined {
  let value = whole;
  for (const part of parts) {
    if (typeof value !== 'object') return undefined;
    value = Array.isArray(value) ? (typeof part === 'number' ? value[part] : undefined) : value[part];
  }
  return value;
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
