// Configuration in force: asked for once per component, and again when an edit ended.
import type { Reading } from '../contract';
import type { Item } from './descriptor';
import type { Values } from './protocol';
import { valueAt } from './value_path';

interface Known {
  readonly watchers: Set<{ readonly item: Item; readonly callback: (reading: Reading) => void }>;
  values: Values | undefined;
}

export type FetchConfiguration = (component: string) => Promise<Values | undefined>;

export class ConfigurationValues {
  #components = new Map<string, Known>();
  #readings = 0;

  constructor(private readonly fetchValues: FetchConfiguration) {}

  watch(item: Item, callback: (reading: Reading) => void): () => void {
    const component = item.component ?? '';
    const watcher = { item, callback };
    let known = this.#components.get(component);
    if (!known) {
      known = { watchers: new Set(), values: undefined };
      this.#components.set(component, known);
      void this.#load(component, known);
    }
    known.watchers.add(watcher);
    if (known.values) this.#tell(watcher, known.values);
    return () => {
      known.watchers.delete(watcher);
      if (known.watchers.size === 0) this.#components.delete(component);
    };
  }

  /** Asks for everything anew that is watched. */
  refresh(): void {
    for (const [component, known] of this.#components) void this.#load(component, known);
  }

  async #load(component: string, known: Known): Promise<void> {
    const values = await this.fetchValues(component);
    if (!values) return;
    known.values = values;
    for (const watcher of known.watchers) this.#tell(watcher, values);
  }

  #tell(watcher: { readonly item: Item; readonly callback: (reading: Reading) => void }, values: Values): void {
    const value = valueAt(values, watcher.item.path);
    this.#readings += 1;
    watcher.callback({
      value: value ?? null, reason: value === undefined ? 'not known' : '', sampledAt: 0, sequence: this.#readings, age: 0,
    });
  }
}
