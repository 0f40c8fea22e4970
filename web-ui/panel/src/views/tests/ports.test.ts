import { describe, expect, it } from 'vitest';
import { makeModel } from '../../core/descriptor';
import { ownerOf, writerOf } from '../blackboard_rows';
import { portsOf } from '../ports';
import { cell, ported } from '../../core/tests/cell';

const model = makeModel(cell);

describe('ports', () => {
  it('of a unit, with the slots and queues that they are connected to', () => {
    const ports = portsOf(model, model.components.get('axis[1]')!);
    expect(ports.map(({ name, direction, type }) => `${direction} ${name} ${type}`)).toEqual(['in goal Place', 'in jobs Place', 'out place Place']);
    expect(ports[0]).toMatchObject({ maxAge: 5e8, connections: [{ name: 'goal', kind: 'slot' }] });
    expect(ports[1]!.connections).toEqual([{ name: 'jobs', kind: 'queue' }]);
    expect(ports[2]!.connections.map(({ name }) => name)).toEqual(['place[1]', 'wide']);
  });

  it('of a device are its outputs', () => {
    expect(portsOf(model, model.components.get('motor')!)).toMatchObject([{ name: 'ticks', direction: 'out', connections: [{ name: 'ticks' }] }]);
  });

  it('of a device are also those of the driver that it has', () => {
    const ports = (driver: string) => {
      const chosen = makeModel(ported, { motor: driver });
      return portsOf(chosen, chosen.components.get('motor')!)
        .map(({ name, direction, connections }) => `${direction} ${name} ${connections.map((to) => to.name).join(' ')}`);
    };
    expect(ports('model')).toEqual(['in goal goal', 'out ticks ticks', 'out truth truth', 'out guess guess']);
    expect(ports('can')).toEqual(['in goal place[0]', 'out ticks ticks', 'out seen truth']);
  });
});

describe('who writes a slot', () => {
  const writer = (name: string) => writerOf(model, model.slotsByName.get(name)!);

  it('is the owner of the port, dots in names and all', () => {
    expect(ownerOf(model, 'axis[0].goal')?.name).toBe('axis[0]');
    expect(ownerOf(model, 'nobody.goal')).toBeUndefined();
    expect(ownerOf(model, 'goal')).toBeUndefined();
    expect(writer('ticks').component?.name).toBe('motor');
  });

  it('is the component whose feedback it holds', () => {
    expect(writer('axis[0].feedback')).toMatchObject({ text: 'axis[0]', component: { name: 'axis[0]' } });
    expect(writer('goal')).toEqual({ text: '', component: undefined });
  });
});
