import { afterEach, describe, expect, it } from 'vitest';
import type { ItemInfo } from '../../contract';
import { kindOf, misfit, placedKind } from '../choose';
import { FakeHost, makeItem, makeParameter, mount, settled, show } from '../tests/fake_host';

afterEach(() => document.body.replaceChildren());

describe('kindOf', () => {
  const cases: readonly (readonly [string, Partial<ItemInfo>, shown: string, changed: string])[] = [
    ['number', {}, 'number', 'number_field'],
    ['number with a range', { range: [0, 1] }, 'number', 'slider'],
    ['number with an endless range', { range: [0, Number.POSITIVE_INFINITY] }, 'number', 'number_field'],
    ['integer', { scalar: 'u8' }, 'number', 'number_field'],
    ['bool', { scalar: 'bool' }, 'lamp', 'toggle'],
    ['enumeration', { scalar: 'enumeration', values: ['a'] }, 'enumeration', 'select'],
    ['text', { scalar: 'text' }, 'text', 'text_field'],
    ['vector', { shape: [3] }, 'vector', 'array_field'],
    ['matrix', { shape: [3, 2] }, 'matrix', 'array_field'],
    ['vector of bools', { shape: [3], scalar: 'bool' }, 'vector', 'structure'],
    ['structure', { scalar: 'structure', members: [makeItem()] }, 'structure', 'structure'],
    ['array of structures', { scalar: 'structure', shape: [2] }, 'records', 'structure'],
  ];
  for (const [name, item, shown, changed] of cases) {
    it(`shows a ${name} as ${shown}, changes it by ${changed}`, () => {
      expect(kindOf(makeItem(item))).toBe(shown);
      expect(kindOf(makeParameter(item))).toBe(changed);
    });
  }

  it('knows buttons, holds and images', () => {
    expect(kindOf(makeParameter({ scalar: 'button' }))).toBe('button');
    expect(kindOf(makeParameter({ scalar: 'hold' }))).toBe('hold');
    const members = ['width', 'height', 'format', 'data'].map((name) => makeItem({ key: `slot:c.${name}` }));
    expect(kindOf(makeItem({ scalar: 'structure', kind: 'slot', members }))).toBe('image');
  });

  it('takes the widget that the table names, also one of the application', () => {
    expect(kindOf(makeItem({ range: [0, 1], widget: 'gauge' }))).toBe('gauge');
    expect(kindOf(makeParameter({ range: [0, 1], widget: 'number_field' }))).toBe('number_field');
    expect(kindOf(makeItem({ widget: 'traffic_light' }))).toBe('traffic_light');
  });

  it('takes the usual one where the named one does not fit, and says so', async () => {
    const item = makeItem({ widget: 'slider', range: [0, 1] });
    expect(kindOf(item)).toBe('number');
    expect(misfit(item)).toBe('The widget “slider” needs a number with a range that can be changed; this is the usual one.');
    const shown = await show(item);
    expect(shown.text('.note')).toBe(misfit(item));
    expect(misfit(makeItem())).toBe('');
    expect(misfit(makeItem({ widget: 'gauge', range: [0, 1] }))).toBe('');
  });

  it('does the same for a row of the application', async () => {
    const host = new FakeHost();
    host.items.set('jog.step', makeItem({ range: [0, 1] }));
    const row = { name: 'w', label: '', place: '', slots: {}, parameters: { value: 'jog.step' }, options: {} };
    expect(placedKind(host, { ...row, kind: 'gauge' })).toBe('gauge');
    expect(placedKind(host, { ...row, kind: 'traffic_light' })).toBe('traffic_light');
    expect(placedKind(host, { ...row, kind: 'jog_pad' })).toBe('jog_pad');
    expect(placedKind(host, { ...row, kind: 'gauge', parameters: { value: 'jog.none' } })).toBe('gauge');
    const placement = { ...row, kind: 'lamp' };
    expect(placedKind(host, placement)).toBe('number');
    const shown = await mount('number', { placement }, host);
    expect(shown.text('.note')).toBe('The widget “lamp” needs a bool; this is the usual one.');
  });

  it('gives each element of a vector a widget for numbers', async () => {
    const host = new FakeHost();
    const item = makeParameter({ key: 'jog.gains', path: 'gains', shape: [2], range: [0, 1], widget: 'slider' });
    for (const i of [0, 1]) host.items.set(`jog.gains[${i}]`, { ...item, key: `jog.gains[${i}]`, shape: [] });
    expect(kindOf(item)).toBe('structure');
    const shown = await show(item, {}, kindOf(item), host);
    await settled(shown.widget);
    expect([...shown.find('.members').children].map((child) => child.localName)).toEqual(['flexrf-widget-slider', 'flexrf-widget-slider']);
    expect(shown.root.querySelector('.note')).toBeNull();
  });
});
