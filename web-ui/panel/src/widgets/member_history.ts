// How the members of a population did: kept by the page while it is open, also while nobody looks at it.
import type { WidgetHost } from '../contract';

/** A member as it is judged now. */
export interface Judged {
  readonly active: boolean;
  /** Another one in the same place begins a line of its own. */
  readonly identity: number;
  readonly value: number;
}

export interface Point {
  /** Generation, or second. */
  readonly at: number;
  readonly value: number;
}

/** Generations, or seconds, that are kept. */
export const longest_line = 120;

export class PopulationHistory {
  /** By place in the population, the oldest first; of places that nobody has: empty. */
  readonly lines: Point[][] = [];
  #identities: number[] = [];
  #at = Number.NEGATIVE_INFINITY;

  /** The last of several with one `at` counts. One that goes back is an application that began anew. */
  note(at: number, members: readonly Judged[]): void {
    if (!Number.isFinite(at)) return;
    if (at < this.#at) this.lines.length = 0;
    this.#at = at;
    members.forEach((member, place) => {
      const line = (this.lines[place] ??= []);
      if (!member.active || member.identity !== this.#identities[place]) line.length = 0;
      this.#identities[place] = member.identity;
      if (!member.active || !Number.isFinite(member.value)) return;
      if (line.at(-1)?.at === at) line.pop();
      line.push({ at, value: member.value });
      while (line[0]!.at <= at - longest_line) line.shift();
    });
    this.lines.length = members.length;
  }

  /** From zero, or the lowest value, to the highest, over all lines: they can be compared. */
  get range(): readonly [low: number, high: number] {
    const values = this.lines.flatMap((line) => line.map((point) => point.value));
    return [Math.min(0, ...values), Math.max(0, ...values)];
  }

  /** The oldest and the newest `at` that a line has. */
  get span(): readonly [from: number, to: number] {
    const begins = this.lines.flatMap((line) => (line[0] ? [line[0].at] : []));
    return [Math.min(this.#at, ...begins), this.#at];
  }
}

/** In a box 100 wide and high; of one point a dot, of none nothing. */
export function linePath(line: readonly Point[], [from, to]: readonly [number, number], [low, high]: readonly [number, number]): string {
  const x = (at: number): string => (to > from ? (100 * (at - from)) / (to - from) : 100).toFixed(1);
  const y = (value: number): string => (high > low ? (100 * (high - value)) / (high - low) : 100).toFixed(1);
  const path = line.map((point, i) => `${i === 0 ? 'M' : 'L'}${x(point.at)} ${y(point.value)}`).join('');
  return line.length === 1 ? `${path}h0` : path;
}

const histories = new WeakMap<WidgetHost, Map<string, PopulationHistory>>();

/** Of this row [widget.NAME]: the same for as long as the page is open. */
export function historyOf(host: WidgetHost, row: string): PopulationHistory {
  const all = histories.get(host) ?? new Map<string, PopulationHistory>();
  histories.set(host, all);
  const history = all.get(row) ?? new PopulationHistory();
  all.set(row, history);
  return history;
}
