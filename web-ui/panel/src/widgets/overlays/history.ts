// What one slot told, by the picture that it belongs to: pictures and what is found in them come apart, and neither waits.
import type { Overlay, Reading, Value } from '../../contract';
import { fieldOf, numberOf, thingsOf } from '../things';

/** Pictures that are remembered: half a second at 60 a second. */
const most = 32;

export interface Found {
  readonly things: readonly Value[];
  /** s, by which the picture that it was found in is older than the one asked for; 0: it is that one. */
  readonly age: number;
}

export class OverlayHistory {
  /** Why there is nothing; empty once there is something. */
  reason = 'nothing yet';
  #byTime = new Map<number, readonly Value[]>();
  #sequence = 0;

  constructor(private readonly overlay: Overlay) {}

  take(reading: Reading): void {
    // The writer began anew, or is gone: what it told was of other pictures.
    if (reading.value === null || reading.sequence < this.#sequence) this.#byTime.clear();
    this.#sequence = reading.sequence;
    this.reason = reading.value === null ? reading.reason || 'no value' : '';
    if (reading.value === null) return;
    const things = thingsOf(this.overlay, reading.value);
    const { time } = this.overlay;
    if (time?.of === 'thing') this.#takeEach(things, time.field);
    else this.#put(time ? numberOf(reading.value, time.field) : reading.sampledAt, things);
  }

  /** Of the picture of this time (ns), or else of the last one before it that is known. */
  of(picture: number): Found | undefined {
    let nearest = Number.NEGATIVE_INFINITY;
    for (const time of this.#byTime.keys()) if (time <= picture && time > nearest) nearest = time;
    const things = this.#byTime.get(nearest);
    return things && { things, age: (picture - nearest) / 1e9 };
  }

  /** A list of the last things holds those of several pictures, and of the oldest no longer all. */
  #takeEach(things: readonly Value[], field: string): void {
    const groups = new Map<number, Value[]>();
    for (const thing of things) {
      const time = fieldOf(thing, field);
      if (typeof time !== 'number') continue;
      const group = groups.get(time);
      if (group) group.push(thing);
      else groups.set(time, [thing]);
    }
    for (const [time, group] of groups) if (group.length >= (this.#byTime.get(time)?.length ?? 0)) this.#put(time, group);
  }

  #put(time: number, things: readonly Value[]): void {
    if (!Number.isFinite(time)) return;
    this.#byTime.set(time, things);
    if (this.#byTime.size > most) this.#byTime.delete(Math.min(...this.#byTime.keys()));
  }
}
