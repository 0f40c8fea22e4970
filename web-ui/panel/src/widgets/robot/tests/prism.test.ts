// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { circle, prism, triangulate, type Outline } from '../prism';

const square: Outline = [[0, 0], [2, 0], [2, 2], [0, 2]];
const bracket: Outline = [[0, 0], [5, 0], [5, 2], [2, 2], [2, 4], [0, 4]];
const comb: Outline = [[0, 0], [7, 0], [7, 3], [6, 3], [6, 1], [5, 1], [5, 3], [4, 3], [4, 1], [3, 1], [3, 3], [0, 3]];

/** Area of an outline, or of the triangles of it. */
function area(outline: Outline, corners = outline.map((_, i) => i), size = corners.length): number {
  let sum = 0;
  for (let first = 0; first < corners.length; first += size) {
    const part = corners.slice(first, first + size).map((i) => outline[i]!);
    part.forEach(([x = 0, y = 0], i) => {
      const [nextX = 0, nextY = 0] = part[(i + 1) % part.length]!;
      sum += (x * nextY - nextX * y) / 2;
    });
  }
  return sum;
}

describe('an outline in triangles', () => {
  it.each([['a square', square], ['an L', bracket], ['a comb', comb], ['a circle', circle]])('%s is covered once', (_name, outline) => {
    const corners = triangulate(outline);
    expect(corners).toHaveLength(3 * (outline.length - 2));
    expect(area(outline, corners, 3)).toBeCloseTo(area(outline), 9);
    // None is turned over: then another one would cover too much.
    for (let i = 0; i < corners.length; i += 3) expect(area(outline, corners.slice(i, i + 3), 3)).toBeGreaterThan(-1e-12);
  });

  it('ends for one that crosses itself', () => {
    expect(triangulate([[0, 0], [1, 1], [1, 0], [0, 1]])).toHaveLength(6);
  });
});

describe('a prism', () => {
  it('is closed, and its faces look outwards', () => {
    const { positions, normals } = prism(bracket, 3);
    expect(positions).toHaveLength(normals.length);
    expect(positions.length / 9).toBe(2 * bracket.length + 2 * (bracket.length - 2));
    // Gauss: the sum over all faces is three times the volume.
    let volume = 0;
    for (let i = 0; i < positions.length; i += 9) {
      const [a, b, c] = [0, 3, 6].map((at) => positions.slice(i + at, i + at + 3)) as [number[], number[], number[]];
      const [u, v] = [b, c].map((corner) => corner.map((one, k) => one - a[k]!)) as [number[], number[]];
      const cross = [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!, u[0]! * v[1]! - u[1]! * v[0]!];
      const normal = normals.slice(i, i + 3);
      expect(cross.reduce((sum, one, k) => sum + one * normal[k]!, 0)).toBeGreaterThan(0);
      volume += cross.reduce((sum, one, k) => sum + one * a[k]!, 0) / 6;
    }
    expect(volume).toBeCloseTo(3 * area(bracket), 9);
  });
});
