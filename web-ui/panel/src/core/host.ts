// What every widget is given: the core behind the contract of widgets.
import type { Hold, Joint, ListName, Outcome, Reading, SetOptions, UnitTable, Value, WidgetHost } from '../contract';
import { sameValue } from './same_value';
import type { ConfigurationValues } from './configuration';
import type { Item } from './descriptor';
import { chosen, History } from './history';
import type { Holds } from './holds';
import { Newest } from './newest';
import type { Answer } from './protocol';
import { textOf } from './reasons';
import type { Store } from './store';
import type { Subscriptions } from './subscriptions';

export interface HostParts {
  readonly item: (key: string) => Item | undefined;
  readonly joints: (device: string) => readonly Joint[];
  readonly units: () => readonly UnitTable[];
  readonly watchList: (name: ListName, callback: (list: unknown) => void, rate?: number) => () => void;
  readonly store: Store;
  readonly subscriptions: Subscriptions;
  readonly configuration: ConfigurationValues;
  readonly holds: Holds;
  readonly request: <Fields>(op: string, fields: object) => Promise<Answer<Fields>>;
  readonly locked: (item: Item | undefined) => string;
  readonly stale: () => boolean;
  readonly watchAccess: (callback: () => void) => () => void;
}

interface Applied {
  readonly sequence: number;
  readonly values: { [path: string]: Value };
}

const unknownKey: Outcome = { ok: false, detail: 'There is no such parameter.' };
const withdrawn: Outcome = { ok: false, detail: 'It was given up before it was sent.' };

export class Host implements WidgetHost {
  readonly history = new History();
  /** Of each parameter that was set. */
  #settings = new Map<string, Newest<Outcome>>();

  constructor(private readonly parts: HostParts) {}

  get stale(): boolean { return this.parts.stale(); }
  get units(): readonly UnitTable[] { return this.parts.units(); }

  item(key: string): Item | undefined {
    return this.parts.item(key);
  }

  locked(key: string): string {
    return this.parts.locked(this.item(key));
  }

  watchAccess(callback: () => void): () => void {
    return this.parts.watchAccess(callback);
  }

  watch(key: string, callback: (reading: Reading) => void, options: { rate?: number; width?: number } = {}): () => void {
    const item = this.item(key);
    if (!item) {
      callback({ value: null, reason: `nothing is called ${key}`, sampledAt: 0, sequence: 0, age: 0 });
      return () => undefined;
    }
    if (item.absent !== undefined) {
      callback({ value: null, reason: item.absent, sampledAt: 0, sequence: 0, age: 0 });
      return () => undefined;
    }
    if (!item.source) return this.parts.configuration.watch(item, callback);
    const rate = options.rate ?? 30;
    const unwatch = this.parts.store.watch(item, callback, rate);
    const unsubscribe = this.parts.subscriptions.addSlot(item.source.slot.name, rate, options.width);
    return () => {
      unwatch();
      unsubscribe();
    };
  }

  async set(key: string, value: Value, options?: SetOptions): Promise<Outcome> {
    const item = this.item(key);
    if (item?.component === undefined || item.path === undefined) return unknownKey;
    const { component, path } = item;
    const setting = this.#settings.get(key) ?? new Newest(withdrawn);
    this.#settings.set(key, setting);
    return setting.run(() => this.#note(component, [path], this.parts.request('set', { component, values: { [path]: value } })), options);
  }

  async press(key: string, count = 1): Promise<Outcome> {
    const item = this.item(key);
    if (item?.component === undefined || item.path === undefined) return unknownKey;
    return outcomeOf(await this.parts.request('press', { component: item.component, parameter: item.path, count }));
  }

  async hold(key: string): Promise<Hold> {
    const item = this.item(key);
    if (item?.component === undefined || item.path === undefined) throw new Error('There is no such parameter.');
    return this.parts.holds.begin(item.component, item.path);
  }

  async reset(key: string): Promise<Outcome> {
    const item = this.item(key);
    if (item?.component === undefined || item.path === undefined) return unknownKey;
    return this.resetAll(item.component, [item.path]);
  }

  /** All of them, or none. */
  resetAll(component: string, parameters: readonly string[]): Promise<Outcome> {
    return this.#note(component, parameters, this.parts.request('reset', { component, parameters }));
  }

  /** Takes the newest change back that this page made and nobody has changed since. */
  async undo(): Promise<Outcome> {
    const { last } = this.history;
    if (!last) return { ok: false, detail: 'There is nothing to take back.' };
    const other = Object.entries(last.after).find(([path, value]) => {
      const item = this.item(`${last.component}.${path}`);
      const now = this.#value(last.component, path);
      // The value before: the unit's newest has not come yet.
      return item && now !== undefined && [value, last.before[path]].every((ours) => !sameValue(now, ours, item.scalar));
    });
    if (other) {
      this.history.drop(last);
      return { ok: false, detail: `${other[0]} of ${last.component} was changed elsewhere meanwhile; it stays as it is.` };
    }
    const outcome = outcomeOf(await this.parts.request<Applied>('set', { component: last.component, values: last.before }));
    if (outcome.ok) this.history.drop(last);
    return outcome;
  }

  joints(device: string): readonly Joint[] {
    return this.parts.joints(device);
  }

  watchList(name: ListName, callback: (list: unknown) => void, rate?: number): () => void {
    return this.parts.watchList(name, callback, rate);
  }

  async file(path: string): Promise<Response> {
    const parts = path.split('/').filter((part) => part !== '' && part !== '.');
    if (parts.includes('..') || path.includes(':')) throw new Error(`"${path}" is not in the application's folder`);
    return fetch(`/application/${parts.map(encodeURIComponent).join('/')}`);
  }

  /** What was asked for just now is a change to take back, if it is made. */
  async #note(component: string, paths: readonly string[], asked: Promise<Answer<Applied>>): Promise<Outcome> {
    const known: { [path: string]: Value } = {};
    for (const path of paths) {
      const value = this.#value(component, path);
      if (value !== undefined) known[path] = value;
    }
    const outcome = outcomeOf(await asked);
    const before = chosen(known, paths);
    const after = outcome.ok ? chosen(outcome.values, paths) : undefined;
    if (before && after) this.history.note({ component, before, after });
    return outcome;
  }

  /** Of a runtime parameter, as far as it is watched. */
  #value(component: string, path: string): Value | undefined {
    const item = this.item(`${component}.${path}`);
    return (item && this.parts.store.reading(item)?.value) ?? undefined;
  }
}

export function outcomeOf(answer: Answer<Partial<Applied>>): Outcome {
  if (answer.ok) return { ok: true, ...(answer.values && { values: answer.values }) };
  const { problem } = answer;
  return { ok: false, detail: textOf(problem), ...(problem.parameter !== undefined && { parameter: problem.parameter }) };
}
