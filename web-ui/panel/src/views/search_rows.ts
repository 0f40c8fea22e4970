// What can be found, and what a person asked for.
import type { Value } from '../contract';
import type { Component, Item, Model } from '../core/descriptor';
import type { DisplayUnits } from '../core/units';
import { sameValue } from '../widgets/same_value';
import { compactText } from './compact_value';

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
  return isParameter(item) && item.default !== undefined && value != null && !sameValue(value, item.default, item.scalar);
}

/** Each of the words stands in the name, the label, the summary or the value. */
export function matches(item: Item, words: readonly string[], value: Value | null | undefined, units: DisplayUnits): boolean {
  if (words.length === 0) return true;
  const shown = value == null ? '' : compactText(item, value, units);
  const text = `${item.key} ${item.label} ${item.summary} ${shown}`.toLowerCase();
  return words.every((word) => text.includes(word));
}

export function wordsOf(wanted: string): string[] {
  return wanted.toLowerCase().split(/\s+/).filter((word) => word !== '');
}
