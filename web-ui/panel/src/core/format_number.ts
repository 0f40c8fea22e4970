// Numbers for people, where nothing else decides on their digits. The first view has none of these.

/** A whole number: "12"; beyond 2^53, where a page has the nearest number only, "≈ 72057319193579520". */
export function wholeText(value: number): string {
  const whole = Math.round(value);
  return `${Number.isSafeInteger(whole) ? '' : '≈ '}${whole}`;
}

/**
 * A number for people: `digits` significant ones, no exponent between 1e-4 and 1e9, integers whole.
 * With the same number of decimals for all values of one range, so that a live number does not jump about.
 */
export function formatNumber(value: number, options: { digits?: number; range?: readonly [number, number]; integer?: boolean } = {}): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? 'not a number' : value > 0 ? '∞' : '−∞';
  if (options.integer) return wholeText(value).replace('-', '−');
  const digits = options.digits ?? 4;
  const largest = options.range ? Math.max(Math.abs(options.range[0]), Math.abs(options.range[1])) : Math.abs(value);
  if (largest !== 0 && (largest >= 1e9 || largest < 1e-4)) return value.toExponential(digits - 1).replaceAll('-', '−');
  const decimals = largest === 0 ? 0 : Math.max(0, digits - 1 - Math.floor(Math.log10(largest)));
  const text = value.toFixed(Math.min(decimals, 9));
  return (Number(text) === 0 ? text.replace('-', '') : text).replace('-', '−');
}
