// What a row's overlays and bodies name of a slot's value: the things in it, and what is said of each.
import type { Things, Value } from '../contract';
import { labelOf } from '../core/descriptor';
import { partOf, partsOf, type Part } from '../core/value_path';
import { anyText, words } from './value_text';

/** A row names few paths, and they are asked for of each thing. */
const taken = new Map<string, readonly Part[]>();

function partsAt(path: string): readonly Part[] {
  const known = taken.get(path) ?? partsOf(path);
  taken.set(path, known);
  return known;
}

/** undefined: it has no such field. */
export function fieldOf(thing: Value, path: string): Value | undefined {
  return partOf(thing, partsAt(path));
}

/** NaN where there is no number. */
export function numberOf(thing: Value, path: string): number {
  const value = fieldOf(thing, path);
  return typeof value === 'number' ? value : Number.NaN;
}

/** Those of the list that are in use and are not empty. */
export function thingsOf(of: Things, value: Value): Value[] {
  const list = of.list === undefined ? [value] : fieldOf(value, of.list);
  if (!Array.isArray(list)) return [];
  const { empty } = of;
  const inUse = of.count === undefined ? list : list.slice(0, Math.max(0, numberOf(value, of.count)) || 0);
  return empty ? inUse.filter((thing) => fieldOf(thing, empty.field) !== empty.value) : inUse;
}

export function isCertain(of: Things, thing: Value): boolean {
  if (of.certain !== undefined) return fieldOf(thing, of.certain) === true;
  return of.doubtful === undefined || fieldOf(thing, of.doubtful) !== true;
}

/** What is written beside it. Of a bool that is true its name, of one that is false nothing. */
export function textOf(of: Things, thing: Value): string {
  return of.text
    .map((path) => {
      const value = fieldOf(thing, path);
      if (typeof value === 'boolean') return value ? words(path) : '';
      return typeof value === 'string' ? words(value) : value === undefined ? '' : anyText(value);
    })
    .filter((part) => part !== '')
    .join(' ');
}

export function titleOf(row: { readonly name: string; readonly label?: string }): string {
  return row.label ?? labelOf(row.name);
}

/** Key of a field of a slot's first thing, for what the tables say of it. */
export function itemKey(of: Things, field: string): string {
  const list = of.list === undefined ? '' : `.${of.list}[0]`;
  return `slot:${of.slots[0] ?? ''}${list}.${field}`;
}
