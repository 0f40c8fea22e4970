// What a slot tells of bodies around the robot, as they are drawn.
import type { Bodies, Value } from '../../contract';
import { fieldOf, isCertain, numberOf, textOf, thingsOf } from '../things';

export interface Body {
  /** Into the row's kinds. */
  readonly kind: number;
  /** m, of the lower face, in the frame of the row's base. */
  readonly place: readonly [x: number, y: number, z: number];
  /** rad about z. */
  readonly angle: number;
  /** m, of one that is round; else 1. */
  readonly radius: number;
  readonly text: string;
  readonly certain: boolean;
}

export interface Seen {
  readonly bodies: readonly Body[];
  /** Things of no kind that the row knows, or without a place. */
  readonly leftOut: number;
}

function bodyOf(row: Bodies, thing: Value): Body | undefined {
  const value = fieldOf(thing, row.kind);
  const kind = row.kinds.findIndex((one) => one.value === value);
  const look = row.kinds[kind];
  const place = fieldOf(thing, row.position);
  if (!look || !Array.isArray(place)) return undefined;
  const [x, y, z = 0] = place;
  const angle = row.angle === undefined ? 0 : numberOf(thing, row.angle);
  const radius = look.outline ? 1 : typeof look.radius === 'string' ? numberOf(thing, look.radius) : (look.radius ?? 0);
  if (typeof x !== 'number' || typeof y !== 'number' || typeof z !== 'number') return undefined;
  if (![x, y, z, angle, radius].every(Number.isFinite) || radius <= 0) return undefined;
  return { kind, place: [x, y, z], angle, radius, text: textOf(row, thing), certain: isCertain(row, thing) };
}

export function bodiesOf(row: Bodies, value: Value): Seen {
  const all = thingsOf(row, value).map((thing) => bodyOf(row, thing));
  const bodies = all.filter((body): body is Body => body !== undefined);
  return { bodies, leftOut: all.length - bodies.length };
}
