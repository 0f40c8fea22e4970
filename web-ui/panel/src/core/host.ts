// What every widget is given: the core behind the contract of widgets.
import type { Hold, Joint, Outcome, Reading, Value, WidgetHost } from '../contract';
import { sameValue } from './same_value';
import type { ConfigurationValues } from './configuration';
import type { Item } from './descriptor';
import { chosen, History } from './history';
import type { Holds } from './holds';
import type { Answer, Problem } from './protocol';
import type { Store } from './store';
import type { Subscriptions } from './subscriptions';

export interface HostParts {
  readonly item: (key: string) => Item | undefined;
  readonly joints: (device: string) => readonly Joint[];
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

interface Wanted {
  readonly value: Value;
  readonly done: readonly ((outcome: Outcome) => void)[];
}

/** One parameter that is being set: a newer value waits for the answer to the one before, those between are left out. */
interface Setting {
  next: Wanted | undefined;
}

const unknownKey: Outcome = { ok: false, detail: 'There is no such parameter.' };

export class Host implements WidgetHost {
  readonly history = new History();
  #settings = new Map<string, Setting>();

  constructor(private readonly parts: HostParts) {}

  get stale(): boolean { return this.parts.stale(); }

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
    if (!item.source) return this.parts.configuration.watch(item, callback);
    const rate = options.rate ?? 30;
    const unwatch = this.parts.store.watch(item, callback, rate);
    const unsubscribe = this.parts.subscriptions.addSlot(item.source.slot.name, rate, options.width);
    return () => {
      unwatch();
      unsubscribe();
    };
  }

  set(key: string, value: Value): Promise<Outcome> {
    const item = this.item(key);
    if (item?.component === undefined || item.path === undefined) return Promise.resolve(unknownKey);
    const { component, path } = item;
    return new Promise((resolve) => {
      const running = this.#settings.get(key);
      if (running) {
        running.next = { value, done: [...(running.next?.done ?? []), resolve] };
        return;
      }
      const setting: Setting = { next: undefined };
      this.#settings.set(key, setting);
      void this.#send(key, setting, component, path, { value, done: [resolve] });
    });
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
    return this.#change('reset', component, parameters, { parameters });
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

  async file(path: string): Promise<Response> {
    const parts = path.split('/').filter((part) => part !== '' && part !== '.');
    if (parts.includes('..') || path.includes(':')) throw new Error(`"${path}" is not in the application's folder`);
    return fetch(`/application/${parts.map(encodeURIComponent).join('/')}`);
  }

  async #send(key: string, setting: Setting, component: string, path: string, first: Wanted): Promise<void> {
    for (let wanted: Wanted | undefined = first; wanted; wanted = setting.next) {
      setting.next = undefined;
      const outcome = await this.#change('set', component, [path], { values: { [path]: wanted.value } });
      wanted.done.forEach((resolve) => resolve(outcome));
    }
    this.#settings.delete(key);
  }

  async #change(op: 'set' | 'reset', component: string, paths: readonly string[], fields: object): Promise<Outcome> {
    const known: { [path: string]: Value } = {};
    for (const path of paths) {
      const value = this.#value(component, path);
      if (value !== undefined) known[path] = value;
    }
    const outcome = outcomeOf(await this.parts.request<Applied>(op, { component, ...fields }));
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

/** A problem in one sentence or two. */
export function textOf(problem: Problem): string {
  return problem.detail ?? problem.reason ?? problem.title;
}

export function outcomeOf(answer: Answer<Partial<Applied>>): Outcome {
  if (answer.ok) return { ok: true, ...(answer.values && { values: answer.values }) };
  const { problem } = answer;
  return { ok: false, detail: textOf(problem), ...(problem.parameter !== undefined && { parameter: problem.parameter }) };
}
