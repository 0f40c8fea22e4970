// Rates from counters that only rise and are sampled now and then.

interface Sample {
  readonly count: number;
  readonly time: number;
}

/** Events per second over the last few seconds of samples. */
export class RateMeter {
  private readonly samples: Sample[] = [];

  /** `window`: seconds of samples that are kept; two are kept in any case. */
  constructor(private readonly window = 3) {}

  /** `time` in seconds, by any clock that only rises. A counter that falls is another application's: all begins anew. */
  add(count: number, time: number): void {
    const last = this.samples.at(-1);
    if (last !== undefined && (count < last.count || time < last.time)) this.samples.length = 0;
    if (last !== undefined && time === last.time) this.samples.pop();
    this.samples.push({ count, time });
    while (this.samples.length > 2 && this.samples[1]!.time <= time - this.window) this.samples.shift();
  }

  /** null until two samples lie apart. */
  get rate(): number | null {
    const first = this.samples[0];
    const last = this.samples.at(-1);
    if (first === undefined || last === undefined || last.time <= first.time) return null;
    return (last.count - first.count) / (last.time - first.time);
  }
}

/** The meters of a table, by name; those that are no longer fed are forgotten with forget(). */
export class RateMeters {
  private readonly meters = new Map<string, RateMeter>();

  add(name: string, count: number, time: number): number | null {
    let meter = this.meters.get(name);
    if (meter === undefined) this.meters.set(name, (meter = new RateMeter()));
    meter.add(count, time);
    return meter.rate;
  }

  forget(): void {
    this.meters.clear();
  }
}
