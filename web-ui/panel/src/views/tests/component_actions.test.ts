// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { actionsOf, componentRows, stateText, urgency, type ComponentRow } from '../component_actions';

const unit: ComponentRow = {
  name: 'jog', kind: 'unit', type: 'jog', life: 'running', fault: '', restraint: '', restraints: 0, budget_overruns: 0, active: true, member: null, steps: 5,
  execution: { mean_ns: 100, max_ns: 200 },
};

const locks = (row: ComponentRow): { [action: string]: string } =>
  Object.fromEntries(actionsOf(row).map((offer) => [offer.action, offer.locked]));

describe('acts of a component', () => {
  it('depend on its life', () => {
    expect(locks(unit)).toEqual({ start: 'It is running.', stop: '', initialise: '' });
    expect(locks({ ...unit, life: 'stopped' })).toEqual({ start: '', stop: 'It is not running.', initialise: '' });
    expect(locks({ ...unit, life: 'fault' })).toEqual({ start: '', stop: '', initialise: '' });
    expect(locks({ ...unit, life: 'waiting' })).toEqual({ start: '', stop: '', initialise: '' });
  });

  it('include those of populations for members alone', () => {
    const member = { ...unit, member: { population: 'axis', index: 1 } };
    expect(Object.keys(locks(unit))).not.toContain('retire');
    expect(locks(member)).toMatchObject({ activate: 'It is active.', retire: '' });
    expect(locks({ ...member, active: false })).toMatchObject({ activate: '', clone: '', retire: 'It is not active.' });
    expect(locks({ ...member, active: false, life: 'stopped' })).toMatchObject({ activate: 'It is not running.' });
  });

  it('name the least role', () => {
    const roles = Object.fromEntries(actionsOf({ ...unit, member: { population: 'p', index: 0 } }).map((o) => [o.action, o.role]));
    expect(roles).toEqual({
      start: 'engineer', stop: 'engineer', initialise: 'engineer', activate: 'operator', clone: 'operator', retire: 'operator',
    });
  });
});

it('puts faults first, sleeping members last', () => {
  expect(urgency({ ...unit, life: 'fault' })).toBe(0);
  expect(urgency({ ...unit, life: 'stopped' })).toBe(1);
  expect(urgency({ ...unit, life: 'waiting' })).toBe(1);
  expect(urgency({ ...unit, active: false, life: 'stopped' })).toBe(2);
  expect(stateText({ ...unit, member: { population: 'p', index: 0 }, active: false })).toBe('ready, not active');
  expect(stateText({ ...unit, life: 'fault' })).toBe('in fault');
});

it('takes only rows from what the server sends', () => {
  expect(componentRows(null)).toEqual([]);
  expect(componentRows([unit, null, 5, {}])).toEqual([unit]);
});
