// What the threads' steps were, as the list `steps` tells it again and again: put together into one account.
import type { UnitInfo } from './units_of';

/** Of one thread in the list `steps`. */
export interface ThreadSteps {
  readonly thread: string;
  /** CLOCK_MONOTONIC of the first step, ns. */
  readonly begin_ns: number;
  /** Steps before these were left out for lack of room. */
  readonly cut: boolean;
  /** Of each step, one after the other: number of the unit, when it began after `begin_ns`, how long it took, ns. */
  readonly steps: readonly number[];
}

export interface Work {
  readonly begin: number;
  readonly end: number;
}

interface Step extends Work {
  readonly unit: number;
}

interface Account {
  steps: Step[];
  /** Between these times steps are missing. */
  gaps: Work[];
}

export class WorkTrace {
  #threads = new Map<string, Account>();

  /** The newest list. */
  add(list: unknown): void {
    if (!Array.isArray(list)) return;
    for (const told of list as readonly ThreadSteps[]) this.#addThread(told);
  }

  #addThread(told: ThreadSteps): void {
    const account = this.#threads.get(told.thread) ?? { steps: [], gaps: [] };
    this.#threads.set(told.thread, account);
    let last = account.steps.at(-1);
    if (last && told.steps.length > 0 && told.begin_ns + told.steps.at(-2)! < last.begin) {
      account.steps = []; // the application began anew, on another machine's clock
      account.gaps = [];
      last = undefined;
    }
    if (last && told.cut && told.begin_ns > last.begin) account.gaps.push({ begin: last.end, end: told.begin_ns });
    for (let i = 0; i + 2 < told.steps.length; i += 3) {
      const begin = told.begin_ns + told.steps[i + 1]!;
      if (!last || begin > last.begin) account.steps.push({ unit: told.steps[i]!, begin, end: begin + told.steps[i + 2]! });
    }
  }

  /** When the last `count` frames that are over began, the oldest first, and when the last of them ended. */
  frames(unit: UnitInfo, count: number): readonly number[] {
    return this.#stepsOf(unit).slice(-count - 1).map((step) => step.begin);
  }

  /** Steps of the unit that reach into this time. */
  work(unit: UnitInfo, from: number, to: number): readonly Work[] {
    return this.#stepsOf(unit).filter((step) => step.end > from && step.begin < to);
  }

  isMissing(thread: string, from: number, to: number): boolean {
    return (this.#threads.get(thread)?.gaps ?? []).some((gap) => gap.end > from && gap.begin < to);
  }

  /** Forgets what was over before. */
  keepFrom(time: number): void {
    for (const account of this.#threads.values()) {
      account.steps = account.steps.filter((step) => step.end >= time);
      account.gaps = account.gaps.filter((gap) => gap.end >= time);
    }
  }

  /** Forgets all but the newest of each thread: nobody knows when a frame begins. */
  keepLast(count: number): void {
    for (const account of this.#threads.values()) account.steps = account.steps.slice(-count);
  }

  #stepsOf(unit: UnitInfo): readonly Step[] {
    return (this.#threads.get(unit.thread)?.steps ?? []).filter((step) => step.unit === unit.index);
  }
}

/** Bars in a box `width` wide and 10 high, each seen however short it was; those that would touch are one. */
export function workPath(work: readonly Work[], from: number, to: number, width: number): string {
  const least = width / 400;
  const x = (time: number): number => (width * (Math.min(to, Math.max(from, time)) - from)) / (to - from);
  let path = '';
  let [begin, end] = [0, -1];
  const draw = (): void => {
    if (end >= begin) path += `M${begin.toFixed(1)} 0H${Math.max(end, begin + least).toFixed(1)}V10H${begin.toFixed(1)}z`;
  };
  for (const one of work) {
    if (end >= begin && x(one.begin) <= Math.max(end, begin + least)) {
      end = Math.max(end, x(one.end));
      continue;
    }
    draw();
    [begin, end] = [x(one.begin), x(one.end)];
  }
  draw();
  return path;
}
