// Which built-in widget shows an item: the one that its table names if it fits, or else the one that suits its type.
import type { ItemInfo, Placement, WidgetElement, WidgetHost } from '../contract';
import { tagOf } from '../core/registry';
import { lastOf } from '../core/value_path';
import { isNumeric, isWide } from './quantity';

/** What a widget can show or change, for the sentence that says why it does not fit. */
interface Fit {
  readonly needs: string;
  readonly fits: (item: ItemInfo) => boolean;
}

const scalar = (item: ItemInfo): boolean => item.shape.length === 0;
const number = (item: ItemInfo): boolean => scalar(item) && isNumeric(item.scalar);
const editable = (item: ItemInfo): boolean => item.role !== undefined;
const data = (item: ItemInfo): boolean => item.scalar !== 'button' && item.scalar !== 'hold';
const numbers = (item: ItemInfo, dimensions: number): boolean => item.shape.length === dimensions && isNumeric(item.scalar);
const ranged = (item: ItemInfo): boolean =>
  item.range !== undefined && Number.isFinite(item.range[1] - item.range[0]) && item.range[1] > item.range[0];
const members = (item: ItemInfo): string[] =>
  scalar(item) ? (item.members ?? []).map((member) => lastOf(member.key)) : [];
const named = (item: ItemInfo, names: readonly string[]): boolean => names.every((name) => members(item).includes(name));
const isImage = (item: ItemInfo): boolean => item.kind === 'slot' && named(item, ['width', 'height', 'format', 'data']);

/** Made of several items, which only a row [widget.NAME] can name. */
const rowOnly: Fit = { needs: 'a row [widget.NAME] of its own', fits: () => false };

const fits: { readonly [kind: string]: Fit } = {
  number: { needs: 'a number', fits: number },
  vector: { needs: 'a vector', fits: (item) => item.shape.length === 1 && item.scalar !== 'structure' },
  matrix: { needs: 'a matrix', fits: (item) => item.shape.length === 2 && item.scalar !== 'structure' },
  lamp: { needs: 'a bool', fits: (item) => scalar(item) && item.scalar === 'bool' },
  enumeration: { needs: 'an enumeration', fits: (item) => scalar(item) && item.scalar === 'enumeration' },
  text: { needs: 'a single value', fits: (item) => scalar(item) && data(item) && item.scalar !== 'structure' },
  image: { needs: 'a slot of an image type', fits: isImage },
  histogram: { needs: 'a vector of numbers', fits: (item) => numbers(item, 1) },
  gauge: { needs: 'a number with a range', fits: (item) => number(item) && ranged(item) },
  pose_2d: {
    needs: 'a structure with position and orientation, or three numbers x, y, heading',
    fits: (item) => named(item, ['position', 'orientation']) || (numbers(item, 1) && item.shape[0] === 3),
  },
  records: { needs: 'an array of structures', fits: (item) => item.scalar === 'structure' && item.shape.length === 1 },
  structure: { needs: 'a structure or an array', fits: (item) => data(item) && (item.members !== undefined || !scalar(item)) },
  button: { needs: 'a button', fits: (item) => item.scalar === 'button' },
  hold: { needs: 'a hold', fits: (item) => item.scalar === 'hold' },
  toggle: { needs: 'a bool that can be changed', fits: (item) => editable(item) && scalar(item) && item.scalar === 'bool' },
  slider: { needs: 'a number with a range that can be changed', fits: (item) => editable(item) && number(item) && ranged(item) },
  number_field: { needs: 'a number that can be changed', fits: (item) => editable(item) && number(item) },
  select: {
    needs: 'an enumeration that can be changed',
    fits: (item) => editable(item) && scalar(item) && item.scalar === 'enumeration',
  },
  text_field: { needs: 'a text that can be changed', fits: (item) => editable(item) && scalar(item) && item.scalar === 'text' },
  array_field: {
    needs: 'a vector or matrix of numbers that can be changed',
    fits: (item) => editable(item) && (numbers(item, 1) || numbers(item, 2)),
  },
  jog_pad: rowOnly, robot: rowOnly, population: rowOnly, timeline: rowOnly,
};

/** Of an item, by its type alone. */
export function defaultKind(item: ItemInfo): string {
  if (item.scalar === 'button' || item.scalar === 'hold') return item.scalar;
  if (isImage(item)) return 'image';
  if (!scalar(item)) {
    if (editable(item)) return isNumeric(item.scalar) ? 'array_field' : 'structure';
    if (item.scalar === 'structure') return item.shape.length === 1 ? 'records' : 'structure';
    return item.shape.length === 1 ? 'vector' : 'matrix';
  }
  if (item.scalar === 'structure') return item.members ? 'structure' : 'text';
  if (item.scalar === 'bool') return editable(item) ? 'toggle' : 'lamp';
  if (item.scalar === 'enumeration') return editable(item) ? 'select' : 'enumeration';
  if (item.scalar === 'text') return editable(item) ? 'text_field' : 'text';
  if (!editable(item)) return 'number';
  return ranged(item) && !isWide(item) ? 'slider' : 'number_field';
}

/** An element of a vector, as far as the choice of its widget goes. */
function element(item: ItemInfo): ItemInfo {
  return { ...item, shape: item.shape.slice(1) };
}

/** A kind that no widget of the panel's has is taken for one of the application's. */
export function kindOf(item: ItemInfo): string {
  const wanted = item.widget;
  if (wanted === undefined) return defaultKind(item);
  const fit = fits[wanted];
  if (!fit || fit.fits(item)) return wanted;
  // A widget for numbers, asked for a vector of them: one for each.
  if (item.shape.length === 1 && fit.fits(element(item))) return 'structure';
  return defaultKind(item);
}

/** Why the widget that the table names is not the one that is shown; empty when it is. */
export function misfit(item: ItemInfo): string {
  const fit = item.widget === undefined ? undefined : fits[item.widget];
  if (!fit || kindOf(item) !== defaultKind(item) || fit.fits(item)) return '';
  if (item.shape.length === 1 && fit.fits(element(item))) return '';
  return `The widget “${item.widget}” needs ${fit.needs}; this is the usual one.`;
}

/** The item of a placed widget: `value` among its parameters and slots, or else the first of them. */
export function placedItem(host: WidgetHost, placement: Placement): ItemInfo | undefined {
  const names = { ...placement.slots, ...placement.parameters };
  const name = names['value'] ?? Object.values(names)[0];
  return name === undefined ? undefined : (host.item(name) ?? host.item(`slot:${name}`));
}

/** The kind that shows a row [widget.NAME]: its own where that fits. */
export function placedKind(host: WidgetHost, placement: Placement): string {
  const item = fits[placement.kind] === rowOnly ? undefined : placedItem(host, placement);
  return item ? kindOf({ ...item, widget: placement.kind }) : placement.kind;
}

/** A built-in widget, ready to be put into the document: for members and elements, which name no others. */
export function createBuiltIn(host: WidgetHost, item: ItemInfo): WidgetElement {
  const kind = kindOf(item);
  // Only a whole slot comes as a picture.
  const tag = tagOf(kind === 'image' ? 'structure' : fits[kind] ? kind : defaultKind(item));
  return Object.assign(document.createElement(tag) as WidgetElement, { host, item });
}
