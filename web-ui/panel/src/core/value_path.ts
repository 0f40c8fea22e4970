// Parts of a value by the path that requests use: "gains[2]", "limits.low", "map[1][0]".
import type { Value } from '../contract';
import type { Values } from './protocol';

export type Part = string | number;

/** "limits.low" → ["limits", "low"]; "gains[2]" → ["gains", 2]. */
export function partsOf(path: string): Part[] {
  return [...path.matchAll(/([^.[\]]+)|\[(\d+)\]/g)].map((match) => (match[2] === undefined ? match[1]! : Number(match[2])));
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

/** Of values that have it so, or have the whole of "limits" or "gains". */
export function valueAt(values: Values | undefined, path: string | undefined): Value | undefined {
  return path === undefined ? undefined : (values?.[path] ?? partOf(values, partsOf(path)));
}

/** "axis.limits.low" → "low". */
export function lastOf(key: string): string {
  return key.slice(key.lastIndexOf('.') + 1);
}
