// @vitest-environment node
// Each folder uses only those below it, and all the contract: what two of them need stands in the lower one.
import { expect, it } from 'vitest';

/** Each with what it may import, from the top down. */
const layers = ['main', 'shell', 'views', 'widgets', 'core', 'contract'] as const;

const read: { readonly [path: string]: string } = import.meta.glob(['../**/*.ts', '!../tests/**'], { query: '?raw', import: 'default', eager: true });
/** The texts of all sources but this folder's, by their paths from the folder above. */
const sources = Object.fromEntries(Object.entries(read).map(([path, text]) => [path.slice(1), text]));

/** "./views/tests/log.test.ts" stands in "views", "./main.ts" in "main"; -1: in no layer. */
function layerOf(path: string): number {
  return layers.findIndex((layer) => new RegExp(`^\\./${layer}(/|\\.ts$|$)`).test(path));
}

/** What "../core/units" means in "./views/log.ts". */
function resolved(from: string, to: string): string {
  const parts = from.split('/').slice(1, -1);
  for (const part of to.split('/')) {
    if (part === '..') parts.pop();
    else if (part !== '.') parts.push(part);
  }
  return ['.', ...parts].join('/');
}

function importsOf(text: string): string[] {
  return [...text.matchAll(/(?:\bfrom|\bimport|\bimport\(|\bvi\.mock\()\s*['"](\.[^'"]*)['"]/g)].map((match) => match[1]!.replace(/\?.*$/, ''));
}

/** Why the file may not import this; empty when it may. */
function fault(file: string, imported: string): string {
  const [user, used] = [layerOf(file), layerOf(resolved(file, imported))];
  if (used < 0) return `${file} imports '${imported}', which lies in none of ${layers.join(', ')}`;
  if (used >= user) return '';
  return `${file} imports '${imported}': ${layers[user]} may use ${layers.slice(user).join(', ')}; what it needs of ${layers[used]} belongs into ${layers[user]} `
    + 'or below, or is handed down by whoever makes it';
}

it('imports point one way: shell → views → widgets → core', () => {
  const files = Object.keys(sources);
  expect(files.filter((file) => layerOf(file) < 0)).toEqual([]);
  const all = files.flatMap((file) => importsOf(sources[file]!).map((imported) => [file, imported] as const));
  expect(all.length).toBeGreaterThan(files.length); // it reads them
  expect(all.map(([file, imported]) => fault(file, imported)).filter((text) => text !== '')).toEqual([]);
});
