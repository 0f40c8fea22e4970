import { describe, expect, it } from 'vitest';
import { addressOfRoute, parseRoute } from '../route';

describe('routes', () => {
  it.each([
    ['', 'overview', []], ['#/units/axis%5B0%5D.drive', 'units', ['axis[0].drive']], ['#/log/', 'log', []],
    ['#/menu/a%2Fb', 'menu', ['a/b']], ['#/units/100%', 'units', ['100%']],
  ])('%s', (hash, view, path) => expect(parseRoute(hash, 'overview')).toEqual({ view, path }));
  it('finds back what it wrote', () => {
    const route = { view: 'blackboard', path: ['axis[1].goal', 'ä/b c'] };
    expect(parseRoute(addressOfRoute(route), '')).toEqual(route);
  });
});
