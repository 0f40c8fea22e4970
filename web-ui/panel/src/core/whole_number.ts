// 64-bit whole numbers. A page counts exactly up to 2^53; beyond, a value is the nearest number that it has.
import type { Value } from '../contract';

/** "12", or "≈ 72057319193579520" of one that is rounded. */
export function wholeText(value: number): string {
  const whole = Math.round(value);
  return `${Number.isSafeInteger(whole) ? '' : '≈ '}${whole}`;
}

/** Sent back, it would be another value. Of whole numbers only. */
export function isRounded(value: Value | null): boolean {
  if (Array.isArray(value)) return value.some(isRounded);
  return typeof value === 'number' && Number.isFinite(value) && !Number.isSafeInteger(Math.round(value));
}
