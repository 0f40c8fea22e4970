// The widgets that a first view needs, in one chunk; those that change something or draw come with a second one.
import type { RegisterWidget } from '../contract';
import type { LoadWidget } from '../core/registry';
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

/** All others; needed for any item that can be changed, whatever its kind of widget. Gives those that come by themselves. */
export async function registerFurther(register: RegisterWidget): Promise<LoadWidget> {
  return (await import('./further')).registerFurther(register);
}
