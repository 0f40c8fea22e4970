// What this page changed, newest last, so that it can be taken back.
import type { Value } from '../contract';
import type { Values } from './protocol';
import { added } from './watchers';

/** One transaction: parameters of one component, by path. */
export interface Change {
  readonly component: string;
  readonly before: Values;
  /** As the unit answered. */
  readonly after: Values;
}

const most = 100;
/** Values of one parameter that follow each other as fast as from a hand that drags are one change, ms. */
const oneHand = 1000;

export class History {
  #changes: Change[] = [];
  #notedAt = -Infinity;
  #watchers = new Set<() => void>();

  get last(): Change | undefined {
    return this.#changes.at(-1);
  }

  note(change: Change, now = performance.now()): void {
    const { last } = this;
    const goesOn = last !== undefined && now - this.#notedAt < oneHand && last.component === change.component
      && String(Object.keys(last.before)) === String(Object.keys(change.before));
    this.#notedAt = now;
    if (goesOn) this.#changes.pop();
    this.#changes = [...this.#changes, goesOn ? { ...change, before: last.before } : change].slice(-most);
    this.#tell();
  }

  drop(change: Change): void {
    this.#changes = this.#changes.filter((one) => one !== change);
    this.#notedAt = -Infinity;
    this.#tell();
  }

  clear(): void {
    this.#changes = [];
    this.#tell();
  }

  watch(callback: () => void): () => void {
    return added(this.#watchers, callback);
  }

  #tell(): void {
    this.#watchers.forEach((watcher) => watcher());
  }
}

/** Of these values those that are at these paths; undefined: one is not known. */
export function chosen(values: Values | undefined, paths: readonly string[]): Values | undefined {
  const entries = paths.map((path): [string, Value | undefined] => [path, values?.[path]]);
  return entries.some(([, value]) => value === undefined) ? undefined : (Object.fromEntries(entries) as Values);
}
