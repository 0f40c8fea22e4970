// The members of a population, or one unit, as the tables connect them.
import type { WidgetHost } from '../contract';

export interface UnitInfo {
  readonly name: string;
  /** Among all units: its number in the list `steps`. */
  readonly index: number;
  readonly thread: string;
  /** By output port the slot that it publishes into; of one that is not connected, or goes into a queue: none. */
  readonly outputs: { readonly [port: string]: string };
}

/** In the order of the tables; none: nothing has this name. */
export function unitsOf(host: WidgetHost, name: string): UnitInfo[] {
  return host.units.flatMap((unit, index): UnitInfo[] => {
    if (unit.population !== name && unit.name !== name) return [];
    const slots = Object.entries(unit.outputs ?? {}).filter((output): output is [string, string] =>
      typeof output[1] === 'string' && host.item(`slot:${output[1]}`) !== undefined);
    return [{ name: unit.name, index, thread: unit.thread ?? '', outputs: Object.fromEntries(slots) }];
  });
}
