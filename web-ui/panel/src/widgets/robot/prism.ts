// Upright prisms as triangles. Outlines are counter-clockwise, and may be concave.

export type Outline = readonly (readonly number[])[];

export interface Triangles {
  /** x, y, z of each corner, three corners for each triangle. */
  readonly positions: readonly number[];
  readonly normals: readonly number[];
}

/** Of radius 1. */
export const circle: Outline = Array.from({ length: 32 }, (_, i) => [Math.cos((i * Math.PI) / 16), Math.sin((i * Math.PI) / 16)]);

type Corner = readonly [x: number, y: number];

/** Above 0: from `a` to `b` one turns to the left about `o`. */
function turn(o: Corner, a: Corner, b: Corner): number {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

function isWithin(p: Corner, a: Corner, b: Corner, c: Corner): boolean {
  return turn(a, b, p) > 0 && turn(b, c, p) > 0 && turn(c, a, p) > 0;
}

/** Places of corners, three for each triangle: ears are cut off one by one (Meisters 1975). */
export function triangulate(outline: Outline): number[] {
  const corners = outline.map(([x = 0, y = 0]): Corner => [x, y]);
  const left = corners.map((_, i) => i);
  const found: number[] = [];
  const at = (i: number): number => left[(i + left.length) % left.length]!;
  const isEar = (i: number): boolean => {
    const [a, b, c] = [corners[at(i - 1)]!, corners[at(i)]!, corners[at(i + 1)]!];
    return turn(a, b, c) > 0 && !left.some((other) => isWithin(corners[other]!, a, b, c));
  };
  while (left.length > 3) {
    const ear = left.findIndex((_, i) => isEar(i));
    if (ear < 0) break; // it crosses itself
    found.push(at(ear - 1), at(ear), at(ear + 1));
    left.splice(ear, 1);
  }
  for (let i = 1; i + 1 < left.length; i += 1) found.push(left[0]!, left[i]!, left[i + 1]!);
  return found;
}

export function prism(outline: Outline, height: number): Triangles {
  const positions: number[] = [];
  const normals: number[] = [];
  const add = (normal: readonly [number, number, number], ...places: readonly (readonly number[])[]): void => {
    for (const [x = 0, y = 0, z = 0] of places) {
      positions.push(x, y, z);
      normals.push(...normal);
    }
  };
  outline.forEach(([x = 0, y = 0], i) => {
    const [nextX = 0, nextY = 0] = outline[(i + 1) % outline.length] ?? [];
    const length = Math.hypot(nextX - x, nextY - y);
    if (length === 0) return;
    const low = [[x, y, 0], [nextX, nextY, 0]] as const;
    const high = [[x, y, height], [nextX, nextY, height]] as const;
    add([(nextY - y) / length, (x - nextX) / length, 0], low[0], low[1], high[1], low[0], high[1], high[0]);
  });
  const faces = triangulate(outline).map((i) => outline[i]!);
  for (let i = 0; i < faces.length; i += 3) {
    const [a, b, c] = [faces[i]!, faces[i + 1]!, faces[i + 2]!];
    add([0, 0, 1], ...[a, b, c].map(([x = 0, y = 0]) => [x, y, height]));
    add([0, 0, -1], a, c, b);
  }
  return { positions, normals };
}
