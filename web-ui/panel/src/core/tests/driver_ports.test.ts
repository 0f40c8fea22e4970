import { describe, expect, it } from 'vitest';
import { makeModel } from '../descriptor';
import { slotUses } from '../driver_ports';
import { ported } from './cell';

describe('the ports of drivers', () => {
  const slots = (driver: string) => makeModel(ported, { motor: driver }).slotsByName;

  it('are those of the driver that was chosen', () => {
    expect(slots('model').get('truth')?.json.writer).toBe('motor.truth');
    expect(slots('can').get('truth')?.json.writer).toBe('motor.seen');
    expect(slots('model').get('goal')?.json.readers).toEqual(['axis[0].goal', 'axis[1].goal', 'motor.goal']);
    expect(slots('can').get('goal')?.json.readers).toEqual(['axis[0].goal', 'axis[1].goal']);
    expect(slots('can').get('place[0]')?.json.readers).toEqual(['motor.goal']);
  });

  it('say of a slot that nobody writes why', () => {
    expect(slots('model').get('guess')?.unwritten).toBeUndefined();
    expect(slots('can').get('truth')?.unwritten).toBeUndefined();
    expect(slots('can').get('guess')?.unwritten).toBe("written by driver 'model' of device 'motor', which was not chosen");
    const none = slotUses(ported, () => 'toy');
    expect(none(ported.slots.find(({ name }) => name === 'truth')!).unwritten)
      .toBe("written by drivers 'model' and 'can' of device 'motor', none of which was chosen");
  });
});
