import { expect, it } from 'vitest';
import { FakeHost, makeItem } from '../tests/fake_host';
import { unitsOf } from '../units_of';

it('knows the members of a population in their order, or one unit, with the slots that they write', () => {
  const host = new FakeHost();
  host.items.set('slot:place[1]', makeItem());
  host.units = [
    { name: 'first' },
    { name: 'axis[0]', population: 'axis', thread: 'control', outputs: { place: 'place[0]', none: null } },
    { name: 'axis[1]', population: 'axis', thread: 'control', outputs: { place: 'place[1]', jobs: 'jobs', several: ['place[1]'] } },
  ];
  expect(unitsOf(host, 'axis')).toEqual([
    { name: 'axis[0]', index: 1, thread: 'control', outputs: {} }, // there is no such slot
    { name: 'axis[1]', index: 2, thread: 'control', outputs: { place: 'place[1]' } },
  ]);
  expect(unitsOf(host, 'first')).toEqual([{ name: 'first', index: 0, thread: '', outputs: {} }]);
  expect(unitsOf(host, 'nobody')).toEqual([]);
});
