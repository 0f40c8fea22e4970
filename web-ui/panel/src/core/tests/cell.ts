// A small cell's descriptor.json: two members of a population, one device with two drivers, slots, a queue, a thread.
import type { DescriptorJson } from '../descriptor_json';

const number = (name: string, offset: number) => ({ name, scalar: 'f64', offset, size: 8, unit: 'm', summary: `${name}.` });
const slot = (name: string, type: string, writer: string, readers: string[], observe = true) => ({
  name, type, writer, readers, buffers: 3, observe, wall: false, history: 0, summary: '',
});
const member = (index: number) => ({
  name: `axis[${index}]`, type: 'drive', thread: 'control', population: 'axis', member: index, restart: 'never',
  inputs: { goal: 'goal', jobs: 'jobs' }, outputs: { place: [`place[${index}]`, 'wide'] }, devices: { motor: 'motor' },
  feedback_slot: `axis[${index}].feedback`, budget_ns: 50_000,
});

export const cell: DescriptorJson = {
  hash: '0000000000000001', format: 1, application: 'cell', summary: 'For tests.', autostart: true,
  unit_types: [
    {
      name: 'drive', class: 'Drive', summary: 'Drives.',
      inputs: [{ name: 'goal', type: 'Place', max_age_ns: 5e8, summary: 'Where to.' }, { name: 'jobs', queue: 'Place', summary: 'Jobs.' }],
      outputs: [{ name: 'place', type: 'Place', summary: 'Where it is.' }],
      configuration: {
        type: 'DriveConfiguration',
        parameters: [
          { name: 'lag', role: 'engineer', default: 0.5, range: [0, 1] },
          { name: 'reach', role: 'engineer', default: 2, range: [0, 4] },
        ],
      },
      feedback: { type: 'Place', parameters: [{ name: 'x' }, { name: 'y' }] },
    },
  ],
  interfaces: [{ name: 'Motor', summary: 'Turns.', configuration: { type: 'MotorConfiguration', parameters: [{ name: 'gear', role: 'engineer', default: 9 }] }, outputs: [{ name: 'ticks', type: 'Place', summary: 'Ticks.' }] }],
  drivers: [
    { name: 'model_motor', driver: 'model', interface: 'Motor', kind: 'simulated', actuates: true, virtual_time: true, summary: 'A model.' },
    {
      name: 'can_motor', driver: 'can', interface: 'Motor', kind: 'real', actuates: true, virtual_time: false, summary: 'On a bus.',
      configuration: { type: 'CanConfiguration', parameters: [{ name: 'node', role: 'engineer', default: 1, range: [1, 127] }] },
    },
  ],
  types: [
    { name: 'Place', summary: 'A place.', hash: '1', size: 16, fields: [number('x', 0), number('y', 8)] },
    { name: 'MotorConfiguration', summary: 'Configuration.', hash: '4', size: 8, fields: [number('gear', 0)] },
    { name: 'CanConfiguration', summary: 'Configuration.', hash: '3', size: 8, fields: [number('node', 0)] },
    { name: 'DriveConfiguration', summary: 'Configuration.', hash: '2', size: 16, fields: [number('lag', 0), number('reach', 8)] },
  ],
  devices: [
    {
      name: 'motor', interface: 'Motor', unit: 'axis[0]', thread: 'control', outputs: { ticks: 'ticks' },
      drivers: [{ driver: 'model', type: 'model_motor' }, { driver: 'can', type: 'can_motor' }],
    },
  ],
  units: [member(0), member(1)],
  populations: [{ name: 'axis', capacity: 2, active: 1 }],
  groups: [],
  slots: [
    slot('goal', 'Place', '', ['axis[0].goal', 'axis[1].goal']),
    slot('place[0]', 'Place', 'axis[0].place', []),
    slot('wide', 'Place', 'axis[1].place', ['axis[0].goal'], false),
    slot('ticks', 'Place', 'motor.ticks', []),
    slot('axis[0].feedback', 'Place', '', []),
  ],
  widgets: [{ name: 'wheel', kind: 'wheel', label: 'The wheel', place: 'motor' }],
  queues: [
    {
      name: 'jobs', type: 'Place', capacity: 4, policy: 'drop_oldest', share: 'copies', wall: false,
      writers: ['motor.jobs', 'axis[1].more'], readers: ['axis[0].jobs'], summary: '',
    },
  ],
  threads: [
    {
      name: 'control', trigger: { kind: 'period', period_ns: 1_000_000 }, priority: 40, role: 'control',
      units: ['axis[0]', 'axis[1]'], devices: ['motor'], budget_ns: 100_000, stack: 65536, summary: '',
    },
  ],
};

const can = { pace: { name: 'pace', role: 'operator' as const, default: 1 }, turns: { name: 'turns' } };

/** The same, whose device has runtime parameters and feedback, and with its second driver more of them. */
export const driven: DescriptorJson = {
  ...cell,
  interfaces: cell.interfaces.map((face) => ({
    ...face,
    runtime: { type: 'MotorRuntime', parameters: [can.pace] }, feedback: { type: 'MotorFeedback', parameters: [can.turns] },
  })),
  drivers: cell.drivers.map((one) => (one.driver !== 'can' ? one : {
    ...one,
    runtime: { type: 'CanRuntime', parameters: [can.pace, { name: 'boost', role: 'operator', default: 0, range: [0, 1], menu: 'Motor' }] },
    feedback: { type: 'CanFeedback', parameters: [can.turns, { name: 'heat' }] },
  })),
  types: [
    ...cell.types,
    { name: 'MotorRuntime', summary: 'Runtime.', hash: '5', size: 8, fields: [number('pace', 0)] },
    { name: 'MotorFeedback', summary: 'Feedback.', hash: '6', size: 8, fields: [number('turns', 0)] },
    { name: 'CanRuntime', summary: 'Runtime.', hash: '7', size: 16, fields: [number('pace', 0), number('boost', 8)] },
    { name: 'CanFeedback', summary: 'Feedback.', hash: '8', size: 16, fields: [number('turns', 0), number('heat', 8)] },
  ],
  devices: cell.devices.map((device) => ({
    ...device, values_slot: 'motor.values', feedback_slot: 'motor.feedback', runtime: { pace: 2 },
    drivers: device.drivers.map((one) => (one.driver === 'can' ? { ...one, runtime: { boost: 0.5 } } : one)),
    overrides: [{ parameter: 'heat', label: 'How warm', place: 'overview' }],
  })),
  slots: [
    ...cell.slots,
    { ...slot('motor.values', 'MotorRuntime', '', []), driver_types: { can: 'CanRuntime' } },
    { ...slot('motor.feedback', 'MotorFeedback', '', []), driver_types: { can: 'CanFeedback' } },
  ],
};

const place = { type: 'Place', summary: 'A place.' };

/** Whose device has drivers with ports: both write "truth", by ports of other names, the first alone "guess"; each reads. */
export const ported: DescriptorJson = {
  ...cell,
  drivers: cell.drivers.map((one) =>
    one.driver === 'can'
      ? { ...one, inputs: [{ name: 'goal', ...place }], outputs: [{ name: 'seen', ...place }] }
      : { ...one, inputs: [{ name: 'goal', ...place }], outputs: [{ name: 'truth', ...place }, { name: 'guess', ...place }] }),
  devices: cell.devices.map((device) => ({
    ...device,
    drivers: [
      { driver: 'model', type: 'model_motor', inputs: { goal: 'goal' }, outputs: { truth: 'truth', guess: 'guess' } },
      { driver: 'can', type: 'can_motor', inputs: { goal: 'place[0]' }, outputs: { seen: 'truth' } },
    ],
  })),
  slots: [
    ...cell.slots.map((one) => (one.name === 'goal' || one.name === 'place[0]' ? { ...one, readers: [...one.readers, 'motor.goal'] } : one)),
    { ...slot('truth', 'Place', 'motor.truth', []), driver_writers: { model: 'motor.truth', can: 'motor.seen' } },
    { ...slot('guess', 'Place', 'motor.guess', []), driver_writers: { model: 'motor.guess' } },
  ],
};
