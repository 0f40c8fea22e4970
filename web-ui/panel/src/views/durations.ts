// Durations in words short enough for a table.

const steps: readonly (readonly [number, string])[] = [
  [1e9, 's'],
  [1e6, 'ms'],
  [1e3, 'µs'],
  [1, 'ns'],
];

/** "850 ns", "12.3 µs", "1.20 ms", "75.0 s": three digits, the unit of measure that suits. */
export function durationText(nanoseconds: number): string {
  if (!Number.isFinite(nanoseconds)) return '–';
  const size = Math.abs(nanoseconds);
  if (size === 0) return '0';
  for (const [scale, unit] of steps) {
    // Rounding must not give "1000 µs".
    if (size >= 0.9995 * scale || scale === 1) {
      const value = nanoseconds / scale;
      return `${threeDigits(value, scale === 1)} ${unit}`;
    }
  }
  return '–';
}

function threeDigits(value: number, whole: boolean): string {
  const size = Math.abs(value);
  if (whole || size >= 99.95) return Math.round(value).toString();
  return value.toFixed(size >= 9.995 ? 1 : 2);
}

/** Age of a value: "now" below a tenth of a second, then "0.4 s", "12 s", "3 min", "2 h". */
export function ageText(seconds: number): string {
  if (!Number.isFinite(seconds)) return '–';
  if (seconds < 0.1) return 'now';
  if (seconds < 9.95) return `${seconds.toFixed(1)} s`;
  if (seconds < 120) return `${Math.round(seconds)} s`;
  if (seconds < 7200) return `${Math.floor(seconds / 60)} min`;
  return `${Math.floor(seconds / 3600)} h`;
}

/** "4:07" of a countdown. */
export function countdownText(seconds: number): string {
  const whole = Math.max(0, Math.ceil(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}

/** "143 /s", "0.50 /s"; "–" while it is not known. */
export function rateText(rate: number | null): string {
  if (rate === null) return '–';
  if (rate === 0) return '0 /s';
  return rate >= 99.5 ? `${Math.round(rate)} /s` : `${rate.toPrecision(2)} /s`;
}

/** Thousands apart by a narrow space that does not break. */
export function countText(count: number): string {
  return Math.round(count).toString().replace(/\B(?=(\d{3})+$)/g, '\u202f');
}
