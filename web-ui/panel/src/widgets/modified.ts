// What is marked as modified: a value in force that is not the default.
import type { ItemInfo, Value } from '../contract';
import { sameValue } from '../core/same_value';

/** What is not known is not known to differ. */
export function differsFromDefault(item: ItemInfo, value: Value | null | undefined): boolean {
  return item.default !== undefined && value != null && !sameValue(value, item.default, item.scalar);
}
