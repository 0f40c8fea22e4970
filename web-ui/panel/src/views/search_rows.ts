// What can be found, and what a person asked for.
import type { Value } from '../contract';
import type { Component, Item, Model } from '../core/descriptor';
import type { DisplayUnits } from '../core/units';
import { differsFromDefault } from '../widgets/modified';
import { compactText } from './compact_value';
import { hasAll } from './wanted_words';

export type Show = 'all' | 'modified' | 'favourites';

export interface Group {
  readonly component: Component;
  readonly items: readonly Item[];
}

export function isParameter(item: Item): boolean {
  return item.role !== undefined && item.scalar !== 'button' && item.scalar !== 'hold';
}

/** Everything that units and devices declare, in the order of the tables; of a device with the driver that it has. */
export function searchable(model: Model, configurationOf: (component: string) => readonly Item[]): Group[] {
  return [...model.components.values()].map((component) => ({
    component,
    items: [...component.runtime, ...configurationOf(component.name), ...component.feedback].filter((item) => !item.hidden),
  }));
}

/** Undefined or null: not known, so not known to be modified. */
export function isModified(item: Item, value: Value | null | undefined): boolean {
  return isParameter(item) && differsFromDefault(item, value);
}

/** Each of the words stands in the name, the label, the summary or the value. */
export function matches(item: Item, words: readonly string[], value: Value | null | undefined, units: DisplayUnits): boolean {
  if (words.length === 0) return true;
  const shown = value == null ? '' : compactText(item, value, units);
  // As the tables and scripts name it, too: "axis_x.lowest", which kind of parameter it ever is.
  const plain = item.key.replace(/\.(configuration|feedback)\./, '.');
  return hasAll(`${item.key} ${plain} ${item.label} ${item.summary} ${shown}`, words);
}

/** What is asked for, as the address has it after "#/search": "all", "axis_x.lowest". */
export function pathOf(wanted: string, show: Show): string[] {
  return wanted === '' ? (show === 'all' ? [] : [show]) : [show, wanted];
}

export function askedBy(path: readonly string[]): { readonly wanted: string; readonly show: Show } {
  const show = (['all', 'modified', 'favourites'] as const).find((one) => one === path[0]);
  return { show: show ?? 'all', wanted: path.slice(show ? 1 : 0).join('/') };
}
