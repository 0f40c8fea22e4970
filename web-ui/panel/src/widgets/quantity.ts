// How one number is shown and typed in: SI inside, the person's unit outside, a fixed number of decimals.
import type { ItemInfo, Scalar, Value } from '../contract';
import { displayUnits } from '../core/units';

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

/** The next of 1, 2, 5, 10, 20, ... at or below. */
function roundStep(step: number): number {
  const decade = 10 ** Math.floor(Math.log10(step));
  const digit = step / decade;
  return (digit >= 5 ? 5 : digit >= 2 ? 2 : 1) * decade;
}

export type Parsed = { readonly value: number } | { readonly problem: string };

/** Made anew when the person chooses other units. */
export class Quantity {
  /** As shown: "mm". */
  readonly unit: string;
  /** Steps by buttons and keys, in the shown unit. */
  readonly fine: number;
  readonly coarse: number;
  /** In the shown unit. */
  readonly range: readonly [number, number] | undefined;
  private readonly factor: number;
  private readonly integer: boolean;
  private decimals: number;
  /** Decimals do not follow the values. */
  private readonly fixed: boolean;
  private largest = 0;

  constructor(
    private readonly item: Pick<ItemInfo, 'scalar' | 'unit' | 'range' | 'default'>,
    options: { readonly [name: string]: Value } = {},
  ) {
    const shown = displayUnits.of(item.unit);
    this.unit = shown.text;
    this.factor = shown.factor;
    this.integer = integers.has(item.scalar);
    if (item.range) this.range = [item.range[0] * this.factor, item.range[1] * this.factor];
    const span = this.range ? this.range[1] - this.range[0] : 0;
    const wide = span > 0 && Number.isFinite(span);
    this.decimals = this.integer ? 0 : wide ? this.rangeDecimals() : 3;

    const least = this.integer ? this.factor : 10 ** -most_decimals;
    const given = (name: string): number | undefined => {
      const step = options[name];
      return typeof step === 'number' && step > 0 ? step * this.factor : undefined;
    };
    this.fine = given('fine') ?? Math.max(least, wide ? roundStep(span / 200) : this.integer ? least : 0.01);
    this.coarse = given('coarse') ?? Math.max(this.fine, wide ? roundStep(span / 20) : 10 * this.fine);
    if (!this.integer) this.decimals = Math.max(this.decimals, Math.min(most_decimals, -Math.floor(Math.log10(this.fine) + 1e-9)));
    const digits = options['decimals'];
    this.fixed = this.integer || this.range !== undefined || typeof digits === 'number';
    if (typeof digits === 'number') this.decimals = Math.min(most_decimals, Math.max(0, Math.round(digits)));
  }

  private rangeDecimals(): number {
    const [low, high] = this.range!;
    const fallback = this.item.default;
    const small = typeof fallback === 'number' && fallback !== 0 ? decimalsFor(Math.abs(fallback * this.factor)) - 2 : 0;
    return Math.max(decimalsFor(Math.max(Math.abs(low), Math.abs(high))), Math.min(small, most_decimals));
  }

  /** For people: "−12.50". Without a range the decimals follow the largest value seen, so they only ever become fewer. */
  text(si: number): string {
    return this.plain(si).replaceAll('-', '−');
  }

  /** As text(), for a field that is typed into. */
  plain(si: number): string {
    if (!Number.isFinite(si)) return Number.isNaN(si) ? 'NaN' : si > 0 ? '∞' : '-∞';
    const shown = si * this.factor;
    if (this.integer && this.factor === 1) return String(Math.round(shown));
    const magnitude = Math.abs(shown);
    if (magnitude >= 1e12) return shown.toExponential(3);
    this.see(magnitude);
    const text = shown.toFixed(this.decimals);
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

  /** Rounded to what is shown; the exact end of the range where it is within half a digit of it. */
  toSi(shown: number): number {
    if (this.range && this.item.range) {
      const half = 0.5 * 10 ** -this.decimals;
      if (Math.abs(shown - this.range[0]) <= half) return this.item.range[0];
      if (Math.abs(shown - this.range[1]) <= half) return this.item.range[1];
    }
    const si = shown / this.factor;
    return this.integer ? Math.round(si) : Number(si.toPrecision(15));
  }

  /** From a slider or a step: no more decimals than are shown. */
  rounded(shown: number): number {
    return Number(shown.toFixed(this.decimals));
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
    const shown = plain === '' ? Number.NaN : Number(plain.replace(',', '.'));
    if (!Number.isFinite(shown)) return { problem: `“${text.trim()}” is not a number` };
    const value = this.toSi(shown);
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
    const bound = (value: number): string => String(Number(value.toPrecision(6))).replaceAll('-', '−');
    return `${bound(this.range[0])} to ${bound(this.range[1])}${this.unit === '' ? '' : ` ${this.unit}`}`;
  }

  stepText(step: number): string {
    return `${Number(step.toPrecision(6))}${this.unit === '' ? '' : ` ${this.unit}`}`;
  }
}
