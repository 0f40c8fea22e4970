// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { labelOf, makeModel, rowsOf, unitWith } from '../descriptor';
import { cell, driven } from './cell';
import { sample } from './sample';

const model = makeModel(sample);

describe('makeModel', () => {
  it('makes an item of each parameter, with what the application changes of it', () => {
    expect(model.item('jog.step')).toMatchObject({
      label: 'Schritt', unit: 'm', scalar: 'f64', range: [0.001, 0.05], widget: 'slider', role: 'operator', kind: 'runtime',
      component: 'jog', path: 'step', default: 0.02, place: 'overview', hidden: false,
    });
    expect(model.item('jog.forward')).toMatchObject({ label: 'Ahead', scalar: 'hold' });
    expect(model.item('jog.configuration.lag')).toMatchObject({ kind: 'configuration', path: 'lag', default: 0.25, range: [0, 1] });
    expect(model.item('jog.configuration.lag')?.source).toBeUndefined();
    expect(model.item('jog.feedback.presses')).toMatchObject({ kind: 'feedback', label: 'Presses', hidden: true });
    expect(model.item('jog.feedback.presses')?.role).toBeUndefined();
    expect(model.item('jog.feedback.mode')?.values).toEqual(['off', 'manual']);
  });
  it('takes what an application changes to be the runtime parameter\'s, where feedback has the same name', () => {
    const twice = makeModel({
      ...sample,
      unit_types: sample.unit_types.map((type) => ({
        ...type,
        ...(type.runtime && type.feedback && {
          runtime: { ...type.runtime, parameters: [...type.runtime.parameters, { name: 'presses' }] },
        }),
      })),
    });
    expect(twice.item('jog.feedback.presses')).toMatchObject({ hidden: false, place: '' });
  });
  it('makes rows of a matrix that the descriptor lists by columns', () => {
    expect(model.item('jog.gains')?.default).toEqual([[1, 3, 5], [2, 4, 6]]);
  });
  it('knows members and elements, with the path that a request needs', () => {
    expect(model.item('jog.limits.low')).toMatchObject({ path: 'limits.low', role: 'engineer', unit: 'm' });
    expect(model.item('jog.gains[1]')).toMatchObject({ path: 'gains[1]', shape: [3], default: [2, 4, 6] });
    expect(model.item('jog.gains[1][2]')).toMatchObject({ path: 'gains[1][2]', shape: [], default: 6 });
    expect(model.item('jog.gains[2]')).toBeUndefined();
  });
  it('knows slots, and the members of their elements', () => {
    expect(model.item('slot:track')).toMatchObject({ scalar: 'structure', typeName: 'Track', kind: 'slot' });
    expect(model.item('slot:track.parts[1]')?.members?.map((member) => member.key)).toEqual(['slot:track.parts[1].low', 'slot:track.parts[1].high']);
    expect(model.item('slot:track.parts[1].high')?.source?.steps).toEqual([1, 'high']);
    expect(model.slotsByName.get('camera')?.image).toBe(true);
    expect(model.item('slot:nothing')).toBeUndefined();
  });
  it('measures each joint of an arm by what it is: in what its device and the unit that leads it tell', () => {
    const field = { name: 'position', scalar: 'f64', shape: [3], offset: 0, size: 24, unit: 'rad|m', summary: '' };
    const turning = { name: 'turn', unit: 'rad' as const };
    const of = (...joints: readonly { readonly name: string; readonly unit: 'rad' | 'm' }[]) => makeModel({
      ...cell,
      types: cell.types.map((type) => ({ ...type, ...(type.fields && { fields: [...type.fields, field] }) })),
      devices: cell.devices.map((device) => ({ ...device, ...(joints.length > 0 && { joints }) })),
    });
    const mixed = of(turning, { name: 'slide', unit: 'm' });
    for (const key of ['axis[0].feedback.position', 'slot:ticks.position', 'slot:place[0].position']) {
      expect(mixed.item(key)).toMatchObject({ unit: 'rad|m', units: ['rad', 'm'] });
      expect(mixed.item(`${key}[1]`)).toMatchObject({ unit: 'm' });
      expect(mixed.item(`${key}[1]`)?.units).toBeUndefined();
      expect(of(turning, turning).item(key)).toMatchObject({ unit: 'rad' });
      expect(of().item(key)).toMatchObject({ unit: 'rad|m' });
    }
    expect(mixed.item('slot:goal.position')?.units).toBeUndefined();
    expect(mixed.joints('motor').map((joint) => joint.name)).toEqual(['turn', 'slide']);
    expect(mixed.joints('axis[0]')).toEqual([]);
  });
  it('lists a device\'s parameter once in its menu, whatever drivers the table permits', () => {
    const [face] = cell.interfaces;
    const declared = { type: 'MotorConfiguration', parameters: [{ name: 'gear', role: 'engineer' as const, menu: 'Motors' }] };
    const { menus } = makeModel({ ...cell, interfaces: [{ ...face!, configuration: declared }] });
    expect(menus.get('Motors')?.map((item) => item.key)).toEqual(['motor.configuration.gear']);
  });
  it('lists menus and places, without what is hidden', () => {
    expect([...model.menus].map(([name, items]) => [name, items.map((item) => item.key)])).toEqual([['Jogging', ['jog.step']]]);
    const { items, placements } = model.placed('overview');
    expect(items.map((item) => item.key)).toEqual(['jog.step']);
    expect(placements).toEqual([{
      name: 'arrows', kind: 'jog_arrows', label: 'Arrows', place: 'overview', slots: { pose: 'track' }, parameters: {}, options: { size: 3 },
    }]);
  });
});

describe('a device whose driver has more than its interface', () => {
  const keysOf = (made: ReturnType<typeof makeModel>, kind: 'runtime' | 'feedback' | 'configuration') =>
    made.components.get('motor')?.[kind].map((item) => item.key);

  it('has its interface\'s values and the driver\'s own, each at its place', () => {
    const can = makeModel(driven, { motor: 'can' });
    expect(keysOf(can, 'runtime')).toEqual(['motor.pace', 'motor.boost']);
    expect(keysOf(can, 'feedback')).toEqual(['motor.feedback.turns', 'motor.feedback.heat']);
    expect(keysOf(can, 'configuration')).toEqual(['motor.configuration.gear', 'motor.configuration.node']);
    expect(can.item('motor.pace')).toMatchObject({ default: 2, path: 'pace' });
    expect(can.item('motor.boost')).toMatchObject({ default: 0.5, range: [0, 1], path: 'boost' });
    expect(can.item('motor.boost')?.source?.fields.map((field) => field.offset)).toEqual([8]);
    expect(can.item('motor.feedback.heat')).toMatchObject({ label: 'How warm', place: 'overview' });
    expect(can.item('motor.feedback.heat')?.absent).toBeUndefined();
    expect(can.slotsByName.get('motor.feedback')?.json.type).toBe('CanFeedback');
    expect(can.item('slot:motor.feedback.heat')).toBeDefined();
    expect(can.menus.get('Motor')?.map((item) => item.key)).toEqual(['motor.boost']);
  });
  it('says of what belongs to another driver that it is not there', () => {
    for (const other of [makeModel(driven), makeModel(driven, { motor: 'model' })]) {
      expect(keysOf(other, 'runtime')).toEqual(['motor.pace']);
      expect(keysOf(other, 'feedback')).toEqual(['motor.feedback.turns']);
      expect(other.item('motor.boost')).toMatchObject({ absent: "the driver is 'model'; this belongs to 'can'", path: 'boost' });
      expect(other.item('motor.boost')?.source).toBeUndefined();
      expect(other.item('motor.pace')?.absent).toBeUndefined();
      expect(other.item('motor.pace')?.source).toBeDefined();
      expect(other.slotsByName.get('motor.feedback')?.json.type).toBe('MotorFeedback');
      expect(other.item('slot:motor.feedback.heat')).toBeUndefined();
      expect(other.placed('overview').items.map((item) => item.key)).toEqual(['motor.feedback.heat']);
      expect(other.menus.size).toBe(0);
    }
  });
});

describe('words', () => {
  it('makes a label of a name', () => expect(labelOf('longest_advance')).toBe('Longest advance'));
  it('makes rows', () => expect(rowsOf([1, 2, 3, 4], [2, 2])).toEqual([[1, 3], [2, 4]]));

  it('takes the units of a device from its row, also on the blackboard', () => {
    const field = (name: string, offset: number, unit: string) => ({ name, scalar: 'f64', offset, size: 8, unit, summary: '' });
    const devices = ['m', 'rad'].map((axis) => ({
      name: `drive_${axis}`, interface: 'Drive', drivers: [{ driver: 'toy', type: 'toy_drive' }], units: { axis }, feedback_slot: `${axis}.feedback`,
    }));
    const model = makeModel({
      ...sample,
      interfaces: [{
        name: 'Drive', summary: '', configuration: { type: 'DriveConfiguration', parameters: [{ name: 'fastest', role: 'engineer', default: 1 }] },
        feedback: { type: 'DriveFeedback', parameters: [{ name: 'position' }] },
      }],
      drivers: [],
      types: [
        { name: 'DriveConfiguration', summary: '', hash: '1', size: 8, fields: [field('fastest', 0, 'axis/s')] },
        { name: 'DriveFeedback', summary: '', hash: '2', size: 8, fields: [field('position', 0, 'axis')] },
      ],
      units: [], unit_types: [], devices: devices as unknown as typeof sample.devices,
      slots: devices.map((device) => ({ ...sample.slots[0]!, name: device.feedback_slot, type: 'DriveFeedback' })),
    });
    expect(model.item('drive_m.configuration.fastest')?.unit).toBe('m/s');
    expect(model.item('drive_rad.configuration.fastest')?.unit).toBe('rad/s');
    expect(model.item('drive_m.feedback.position')?.unit).toBe('m');
    expect(model.item('slot:rad.feedback.position')?.unit).toBe('rad');
    expect(unitWith('N*axis^2', { axis: 'm' })).toBe('N*m^2');
    expect(unitWith('taxis', { axis: 'm' })).toBe('taxis');
  });

  it('takes the step of the table, or of the application', () => {
    const unit = sample.units[0]!;
    const type = sample.unit_types[0]!;
    const runtime = { ...type.runtime!, parameters: type.runtime!.parameters.map((one) => (one.name === 'step' ? { ...one, step: 0.001 } : one)) };
    const types = [{ ...type, runtime }];
    expect(makeModel({ ...sample, unit_types: types }).item('jog.step')?.step).toBe(0.001);
    const overrides = [{ parameter: 'step', step: 0.002 }];
    expect(makeModel({ ...sample, unit_types: types, units: [{ ...unit, overrides }] }).item('jog.step')?.step).toBe(0.002);
    expect(makeModel(sample).item('jog.step')).not.toHaveProperty('step');
  });
});
