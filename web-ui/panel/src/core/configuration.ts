// Configuration in force: asked for once per component, and again when an edit ended.
import type { Reading, Value } from '../contract';
import type { Item } from './descriptor';
import type { Values } from './protocol';

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
    const value = valueAt(values, watcher.item.path ?? '');
    this.#readings += 1;
    watcher.callback({
      value: value ?? null, reason: value === undefined ? 'not known' : '', sampledAt: 0, sequence: this.#readings, age: 0,
    });
  }
}

/** The value at a path as requests have it: "limits.low", "gains[2]". */
export function valueAt(values: Values, path: string): Value | undefined {
  let value: Value | undefined = values as { [field: string]: Value };
  for (const step of path.split(/[.[\]]+/).filter((part) => part !== '')) {
    if (Array.isArray(value)) value = value[Number(step)];
    else if (typeof value === 'object') value = value[step];
    else return undefined;
  }
  return value;
}
