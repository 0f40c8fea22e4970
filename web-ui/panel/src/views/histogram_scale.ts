// From the runtime's histogram of durations to what is drawn of it: columns on a logarithmic axis.

/** A histogram as topic "threads" sends it. */
export interface DurationHistogram {
  readonly count: number;
  readonly p50_ns: number;
  readonly p99_ns: number;
  readonly 'p99.9_ns': number;
  readonly max_ns: number;
  /** bucket, count, bucket, count, ... of those that are not empty. */
  readonly buckets: readonly number[];
}

/** A column: durations from `low` up to, but without, `high`, ns. */
export interface Column {
  readonly low: number;
  readonly high: number;
  readonly count: number;
}

const per_octave = 16;
const columns_per_octave = 4;

/** Durations of a bucket, ns: from the first up to, but without, the second. The inverse of Histogram::bucket_of. */
export function bucketBounds(bucket: number): readonly [number, number] {
  if (bucket < per_octave) return [bucket, bucket + 1];
  const octave = Math.floor(bucket / per_octave) - 1;
  const mantissa = bucket - per_octave * octave;
  return [mantissa * 2 ** octave, (mantissa + 1) * 2 ** octave];
}

/** Four columns to an octave: as fine as can be seen, and of equal width on the axis. Below 16 ns one column. */
export function columnsOf(buckets: readonly number[]): Column[] {
  const counts = new Map<number, number>();
  for (let i = 0; i + 1 < buckets.length; i += 2) {
    const bucket = buckets[i]!;
    const column = bucket < per_octave ? -1 : Math.floor(bucket / (per_octave / columns_per_octave));
    counts.set(column, (counts.get(column) ?? 0) + buckets[i + 1]!);
  }
  return [...counts]
    .sort(([a], [b]) => a - b)
    .map(([column, count]) => {
      if (column < 0) return { low: 0, high: per_octave, count };
      const first = column * (per_octave / columns_per_octave);
      const last = first + per_octave / columns_per_octave - 1;
      return { low: bucketBounds(first)[0], high: bucketBounds(last)[1], count };
    });
}

/** A logarithmic axis over whole decades, ns on 0...1. */
export class LogAxis {
  private constructor(
    readonly from: number,
    readonly to: number,
  ) {}

  /** The decades that hold all of these; zero and below count as the first. At least two decades, from 10 ns on. */
  static over(durations: Iterable<number>): LogAxis {
    let low = Number.POSITIVE_INFINITY;
    let high = 0;
    for (const duration of durations) {
      if (!(duration >= 0)) continue;
      low = Math.min(low, Math.max(duration, 10));
      high = Math.max(high, duration);
    }
    if (!Number.isFinite(low)) [low, high] = [1e3, 1e5];
    const from = Math.floor(Math.log10(low) + 1e-9);
    const to = Math.max(Math.ceil(Math.log10(Math.max(high, 10)) - 1e-9), from + 2);
    return new LogAxis(from, to);
  }

  /** Where a duration lies, 0...1; what is beyond an end lies on it. */
  place(duration: number): number {
    if (!(duration > 0)) return 0;
    return Math.min(1, Math.max(0, (Math.log10(duration) - this.from) / (this.to - this.from)));
  }

  /** Whole decades, ns. */
  get ticks(): number[] {
    return Array.from({ length: this.to - this.from + 1 }, (_, i) => 10 ** (this.from + i));
  }
}

/** Height of a column, 0...1, so that one late release among a million is still seen. */
export function height(count: number, largest: number): number {
  if (count <= 0 || largest <= 0) return 0;
  return (1 + Math.log10(count)) / (1 + Math.log10(largest));
}

/** The outline of all columns as an SVG path in a box of this width and height, from its upper left corner. */
export function histogramPath(columns: readonly Column[], axis: LogAxis, width: number, heightOfBox: number): string {
  const largest = columns.reduce((most, column) => Math.max(most, column.count), 0);
  const number = (value: number): string => value.toFixed(1).replace(/\.0$/, '');
  return columns
    .filter((column) => column.count > 0)
    .map((column) => {
      const left = axis.place(column.low) * width;
      // At least a pixel: durations beyond the ends of the axis too.
      const right = Math.max(axis.place(column.high) * width, left + 1);
      const top = heightOfBox * (1 - height(column.count, largest));
      return `M${number(left)} ${number(heightOfBox)}V${number(top)}H${number(right)}V${number(heightOfBox)}Z`;
    })
    .join('');
}

/** How the measured execution stands against the budget. */
export interface BudgetUse {
  /** p99.9 against budget; null without a budget or a measurement. */
  readonly share: number | null;
  readonly over: boolean;
}

export function budgetUse(budget: number, execution: DurationHistogram): BudgetUse {
  if (!(budget > 0) || execution.count === 0) return { share: null, over: false };
  const share = execution['p99.9_ns'] / budget;
  return { share, over: share > 1 };
}
