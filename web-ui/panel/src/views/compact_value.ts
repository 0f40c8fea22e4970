// A value in one short line, for a table's cell.
import type { ItemInfo, Value } from '../contract';
import { formatNumber } from '../core/format_number';
import type { DisplayUnits } from '../core/units';

const longest = 96;

/** "position 420.0 0 1230 mm · orientation 0 0 0 1"; cut off with "…" where it is too long. */
export function compactText(item: ItemInfo, value: Value, units: DisplayUnits): string {
  const text = textOf(item, value, units);
  return text.length <= longest ? text : `${text.slice(0, longest - 1)}…`;
}

function textOf(item: ItemInfo, value: Value, units: DisplayUnits): string {
  if (typeof value === 'object' && !Array.isArray(value)) {
    const members = item.members ?? [];
    const texts = Object.entries(value).map(([name, inner]) => {
      const member = members.find((one) => one.key.endsWith(`.${name}`));
      const text = member ? textOf(member, inner, units) : plainText(inner);
      return `${name} ${typeof inner === 'object' && !Array.isArray(inner) ? `{${text}}` : text}`;
    });
    return texts.join(' · ');
  }
  if (item.units && Array.isArray(value)) {
    return value.slice(0, item.units.length).map((element, i) => {
      const own = units.of(item.units?.[i] ?? item.unit);
      return `${numbersText(element, own.factor, false)} ${own.text}`;
    }).join(' ');
  }
  const unit = units.of(item.unit);
  const text = numbersText(value, unit.factor, item.scalar !== 'f32' && item.scalar !== 'f64');
  return unit.text === '' ? text : `${text} ${unit.text}`;
}

function numbersText(value: Value, factor: number, integer: boolean): string {
  if (typeof value === 'number') return formatNumber(value * factor, { integer: integer && factor === 1 });
  if (Array.isArray(value)) {
    const rows = value.some((element) => Array.isArray(element));
    // One text is enough for a cell: what is beyond is cut off anyway.
    return value.slice(0, 32).map((element) => numbersText(element, factor, integer)).join(rows ? '; ' : ' ');
  }
  return plainText(value);
}

function plainText(value: Value): string {
  if (typeof value === 'boolean') return value ? 'on' : 'off';
  if (typeof value === 'string') return value === '' ? '“”' : value;
  if (typeof value === 'number') return formatNumber(value);
  if (Array.isArray(value)) return value.slice(0, 32).map(plainText).join(' ');
  return Object.entries(value).map(([name, inner]) => `${name} ${plainText(inner)}`).join(' · ');
}
