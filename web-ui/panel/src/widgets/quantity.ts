// How one number is shown and typed in: SI inside, the person's unit outside, a fixed number of decimals.
import type { ItemInfo, Scalar, Value } from '../contract';
import { wholeText } from '../core/format_number';
import { displayUnits, significantText } from '../core/units';

const integers: ReadonlySet<Scalar> = new Set<Scalar>(['i8', 'u8', 'i16', 'u16', 'i32', 'u32', 'i64', 'u64']);

export function isNumeric(scalar: Scalar): boolean {
  return scalar === 'f32' || scalar === 'f64' || integers.has(scalar);
}

const most_decimals = 9;

/** Decimals that show four significant digits of a magnitude. */
function decimalsFor(magnitude: number): number {
  if (!(magnitude > 0) || !Number.isFinite(magnitude)) return 3;
  return Math.min(most_decimals, Math.max(0, 3 - Math.floor(Math.log10(magnitude))));
}

/** Decimals without which a step would not be seen. */
function decimalsOf(step: number): number {
  return Math.min(most_decimals, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

/** The next of 1, 2, 5, 10, 20, ... at or below. */
function roundStep(step: number): number {
  const decade = 10 ** Math.floor(Math.log10(step));
  const digit = step / decade;
  return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * decade;
}

/** The decade below a part of a hundred: 1000 → 10, 42 → 0.1. */
function percentDecade(magnitude: number): number {
  return 10 ** (Math.floor(Math.log10(magnitude) + 1e-9) - 2);
}

type Measured = Pick<ItemInfo, 'scalar' | 'unit' | 'range' | 'default' | 'step'>;

/** How large a value is that nothing is known of but its table, SI. */
function usualMagnitude(item: Pick<ItemInfo, 'default'>): number {
  return typeof item.default === 'number' && item.default !== 0 ? Math.abs(item.default) : 1;
}

/**
 * Whether the range says what may be, and not what is usual: a slider over it, or a step that is a part of it, would be of
 * no use. More than a thousand times the default, or ten thousand of the table's steps; also what has no range at all.
 */
export function isWide(item: Pick<ItemInfo, 'range' | 'default' | 'step'>): boolean {
  const span = item.range ? item.range[1] - item.range[0] : Number.POSITIVE_INFINITY;
  if (!(span > 0) || !Number.isFinite(span)) return true;
  return item.step === undefined ? span > 1000 * usualMagnitude(item) : span > 10_000 * item.step;
}

/** Steps by buttons and keys, in the shown unit. */
export interface Steps {
  readonly fine: number;
  readonly coarse: number;
}

export type Parsed = { readonly value: number } | { readonly problem: string };

/** Digits with a point or a comma and an exponent; none of the other ways in which JavaScript writes a number. */
const decimal = /^[+-]?(\d+([.,]\d*)?|[.,]\d+)(e[+-]?\d+)?$/i;

/** Made anew when the person chooses other units. */
export class Quantity {
  /** As shown: "mm". */
  readonly unit: string;
  /** In the shown unit. */
  readonly range: readonly [number, number] | undefined;
  private readonly factor: number;
  private readonly integer: boolean;
  private readonly wide: boolean;
  /** As the widget's row or the parameter's table has them, in the shown unit. */
  private readonly given: { readonly fine: number | undefined; readonly coarse: number | undefined };
  private decimals: number;
  /** Decimals do not follow the values. */
  private readonly fixed: boolean;
  private largest = 0;

  constructor(private readonly item: Measured, options: { readonly [name: string]: Value } = {}) {
    const shown = displayUnits.of(item.unit);
    this.unit = shown.text;
    this.factor = shown.factor;
    this.integer = integers.has(item.scalar);
    this.wide = isWide(item);
    if (item.range) this.range = [item.range[0] * this.factor, item.range[1] * this.factor];
    const given = (step: Value | undefined): number | undefined =>
      typeof step === 'number' && step > 0 ? step * this.factor : undefined;
    this.given = { fine: given(options['fine']) ?? given(item.step), coarse: given(options['coarse']) };
    const digits = options['decimals'];
    this.fixed = this.integer || !this.wide || typeof digits === 'number';
    this.decimals = this.integer ? 0 : this.wide ? 3 : this.rangeDecimals();
    if (!this.integer) this.decimals = Math.max(this.decimals, decimalsOf(this.given.fine ?? (this.wide ? 1 : this.partOfRange(200))));
    if (typeof digits === 'number') this.decimals = Math.min(most_decimals, Math.max(0, Math.round(digits)));
  }

  private rangeDecimals(): number {
    const [low, high] = this.range!;
    const fallback = this.item.default;
    const small = typeof fallback === 'number' && fallback !== 0 ? decimalsFor(Math.abs(fallback * this.factor)) - 2 : 0;
    return Math.max(decimalsFor(Math.max(Math.abs(low), Math.abs(high))), Math.min(small, most_decimals));
  }

  private partOfRange(part: number): number {
    const [low, high] = this.range!;
    return roundStep((high - low) / part);
  }

  /**
   * From a value of this size, SI: as the tables say, or else about a hundredth and a tenth of the value; within a range
   * that is not wide at most a two hundredth and a twentieth of that.
   */
  steps(si: number): Steps {
    const least = this.integer ? this.factor : 10 ** -most_decimals;
    const { given } = this;
    const own = Number.isFinite(si) ? Math.abs(si * this.factor) : 0;
    if (this.wide) {
      const fallback = typeof this.item.default === 'number' ? Math.abs(this.item.default * this.factor) : 0;
      const fine = given.fine ?? Math.max(least, percentDecade(own || fallback || 1));
      return { fine, coarse: Math.max(fine, given.coarse ?? 10 * fine) };
    }
    const usual = Math.max(own, typeof this.item.default === 'number' ? Math.abs(this.item.default * this.factor) : 0);
    const bounded = (range: number, size: number): number =>
      usual > 0 ? Math.min(this.partOfRange(range), roundStep(usual / size)) : this.partOfRange(range);
    const fine = given.fine ?? Math.max(least, bounded(200, 20));
    return { fine, coarse: Math.max(fine, given.coarse ?? (given.fine === undefined ? bounded(20, 2) : 10 * fine)) };
  }

  /** For people: "−12.50". Without a range the decimals follow the largest value seen, so they only ever become fewer. */
  text(si: number): string {
    return this.plain(si).replaceAll('-', '−');
  }

  /** As text(), for one of several fields that are typed into. */
  plain(si: number): string {
    if (Number.isFinite(si)) this.see(Math.abs(si * this.factor));
    return this.digits(si, this.decimals);
  }

  /** For a field of its own: decimals by this value, as only a hand changes it. */
  entry(si: number): string {
    return this.digits(si, this.entryDecimals(si * this.factor));
  }

  /** As entry(), for people. */
  entryText(si: number): string {
    return this.entry(si).replaceAll('-', '−');
  }

  private entryDecimals(shown: number): number {
    return this.fixed ? this.decimals : Math.max(decimalsFor(Math.abs(shown)), this.given.fine === undefined ? 0 : decimalsOf(this.given.fine));
  }

  private digits(si: number, decimals: number): string {
    if (!Number.isFinite(si)) return Number.isNaN(si) ? 'NaN' : si > 0 ? '∞' : '-∞';
    const shown = si * this.factor;
    if (this.integer && this.factor === 1) return wholeText(shown);
    if (Math.abs(shown) >= 1e12) return shown.toExponential(3);
    const text = shown.toFixed(decimals);
    return text.startsWith('-') && Number(text) === 0 ? text.slice(1) : text;
  }

  /** Of several numbers that are shown together, all go through this before text(): they get the same decimals. */
  seeAll(values: readonly Value[]): void {
    if (this.fixed) return;
    for (const value of values) {
      if (Array.isArray(value)) this.seeAll(value);
      else if (typeof value === 'number') this.see(Math.abs(value * this.factor));
    }
  }

  private see(magnitude: number): void {
    if (this.fixed || !(magnitude > this.largest) || magnitude === Number.POSITIVE_INFINITY) return;
    this.largest = magnitude;
    this.decimals = decimalsFor(magnitude);
  }

  toShown(si: number): number {
    return si * this.factor;
  }

  /** The exact end of the range where it is within half a digit of it. */
  toSi(shown: number): number {
    if (this.range && this.item.range) {
      const half = 0.5 * 10 ** -this.entryDecimals(shown);
      if (Math.abs(shown - this.range[0]) <= half) return this.item.range[0];
      if (Math.abs(shown - this.range[1]) <= half) return this.item.range[1];
    }
    const si = shown / this.factor;
    return this.integer ? Math.round(si) : Number(si.toPrecision(15));
  }

  /** Where a slider stands: no more decimals than are shown. */
  rounded(shown: number): number {
    return Number(shown.toFixed(this.entryDecimals(shown)));
  }

  /** A whole number, or one of several, beyond 2^53: sent back, it would be another value. */
  isRounded(value: Value | null): boolean {
    if (Array.isArray(value)) return value.some((element) => this.isRounded(element));
    return this.integer && typeof value === 'number' && Number.isFinite(value) && !Number.isSafeInteger(Math.round(value));
  }

  /** A step on from a value, SI, within the range; without the digits that neither value nor step has. */
  stepped(si: number, step: number): number {
    const shown = si * this.factor;
    const decimals = Math.min(most_decimals, Math.max(this.entryDecimals(shown), decimalsOf(Math.abs(step))));
    return this.toSi(this.clamped(Number((shown + step).toFixed(decimals))));
  }

  /** Where a value lies in its range, 0 to 1; undefined without one. */
  fraction(si: number): number | undefined {
    if (!this.range || !Number.isFinite(si)) return undefined;
    const [low, high] = this.range;
    return high > low ? Math.min(1, Math.max(0, (si * this.factor - low) / (high - low))) : undefined;
  }

  clamped(shown: number): number {
    return this.range ? Math.min(this.range[1], Math.max(this.range[0], shown)) : shown;
  }

  /** SI from what a person typed; a comma is a decimal point. */
  parse(text: string): Parsed {
    let plain = text.trim().replaceAll('−', '-');
    if (this.unit !== '' && plain.endsWith(this.unit)) plain = plain.slice(0, -this.unit.length).trim();
    const shown = decimal.test(plain) ? Number(plain.replace(',', '.')) : Number.NaN;
    if (!Number.isFinite(shown)) return { problem: plain === '' ? 'a number is missing' : `“${text.trim()}” is not a number` };
    const value = this.toSi(shown) + 0; // a zero with a sign is a zero
    if (this.integer && Math.abs(value * this.factor - shown) > 1e-9 * Math.max(1, Math.abs(shown))) {
      return { problem: 'only whole numbers' };
    }
    if (this.item.range && (value < this.item.range[0] || value > this.item.range[1])) {
      return { problem: `only ${this.rangeText()}` };
    }
    return { value };
  }

  /** "0.001 to 0.1 m"; empty without a range. */
  rangeText(): string {
    if (!this.range) return '';
    return `${significantText(this.range[0], 6)} to ${significantText(this.range[1], 6)}${this.unit === '' ? '' : ` ${this.unit}`}`;
  }

  stepText(step: number): string {
    return `${Number(step.toPrecision(6))}${this.unit === '' ? '' : ` ${this.unit}`}`;
  }
}
