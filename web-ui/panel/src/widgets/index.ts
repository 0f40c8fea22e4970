// The widgets that a first view needs, in one chunk; those that change something or draw come with a second one.
import type { RegisterWidget, WidgetElement } from '../contract';
import { ArrayReadout } from './array_readout';
import { Lamp } from './lamp';
import { NumberReadout } from './number_readout';
import { Records } from './records';
import { Structure } from './structure';
import { EnumerationReadout, TextReadout } from './text_readout';

export { kindOf, placedKind } from './choose';

export function registerBuiltIn(register: RegisterWidget): void {
  register('number', NumberReadout);
  register('vector', ArrayReadout);
  register('matrix', class extends ArrayReadout {}); // an element class has one name
  register('lamp', Lamp);
  register('enumeration', EnumerationReadout);
  register('text', TextReadout);
  register('structure', Structure);
  register('records', Records);
}

/** Kinds that few applications show: each is loaded by itself. */
const apart: { readonly [kind: string]: (() => Promise<new () => WidgetElement>) | undefined } = {
  population: async () => (await import('./population')).Population,
  timeline: async () => (await import('./timeline')).Timeline,
};

/** undefined: there is no such kind, or it is one of the others. */
export async function loadApart(kind: string): Promise<(new () => WidgetElement) | undefined> {
  return Object.hasOwn(apart, kind) ? apart[kind]?.() : undefined;
}

/** All others; needed for any item that can be changed, whatever its kind of widget. */
export async function registerFurther(register: RegisterWidget): Promise<void> {
  (await import('./further')).registerFurther(register);
}
