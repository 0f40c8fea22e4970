// A small application's descriptor.json, and frames of its values.
import type { DescriptorJson } from '../descriptor_json';

export const sample: DescriptorJson = {
  hash: '84bdd5562b9e2e53', format: 1, application: 'sample', summary: 'For tests.', autostart: true,
  unit_types: [
    {
      name: 'jog', class: 'Jog', summary: 'Jogs.',
      configuration: { type: 'JogConfiguration', parameters: [{ name: 'lag', role: 'engineer', default: 0.5, range: [0, 1] }] },
      runtime: {
        type: 'JogRuntime',
        parameters: [
          { name: 'step', role: 'operator', default: 0.01, range: [0.001, 0.1], persist: true, menu: 'Jogging' },
          { name: 'gains', role: 'engineer', default: [1, 2, 3, 4, 5, 6], persist: true },
          { name: 'limits', role: 'engineer', default: { low: 0, high: 1 }, persist: true },
          { name: 'forward', role: 'operator', label: 'Ahead' },
          { name: 'home', role: 'operator' },
        ],
      },
      feedback: { type: 'JogFeedback', parameters: [{ name: 'presses' }, { name: 'mode' }, { name: 'note' }] },
    },
  ],
  interfaces: [], drivers: [],
  types: [
    { name: 'Mode', summary: 'Mode.', hash: '1', values: [{ name: 'off', summary: '' }, { name: 'manual', summary: '' }] },
    {
      name: 'Limits', summary: 'Limits.', hash: '2', size: 16,
      fields: [
        { name: 'low', scalar: 'f64', offset: 0, size: 8, unit: 'm', summary: 'Low.' },
        { name: 'high', scalar: 'f64', offset: 8, size: 8, unit: 'm', summary: 'High.' },
      ],
    },
    {
      name: 'JogRuntime', summary: 'Runtime.', hash: '3', size: 88,
      fields: [
        { name: 'step', scalar: 'f64', offset: 0, size: 8, unit: 'm', summary: 'How far.' },
        { name: 'gains', scalar: 'f64', shape: [2, 3], offset: 8, size: 48, unit: '1', summary: 'Gains.' },
        { name: 'limits', scalar: 'structure', type: 'Limits', offset: 56, size: 16, summary: 'Limits.' },
        { name: 'forward', scalar: 'hold', offset: 72, size: 1, summary: 'Moves on.' },
        { name: 'home', scalar: 'button', offset: 76, size: 4, summary: 'Homes.' },
      ],
    },
    {
      name: 'JogConfiguration', summary: 'Configuration.', hash: '4', size: 8,
      fields: [{ name: 'lag', scalar: 'f64', offset: 0, size: 8, unit: 's', summary: 'Lag.' }],
    },
    {
      name: 'JogFeedback', summary: 'Feedback.', hash: '5', size: 48,
      fields: [
        { name: 'presses', scalar: 'u64', offset: 0, size: 8, summary: 'Presses.' },
        { name: 'mode', scalar: 'enumeration', type: 'Mode', offset: 8, size: 1, summary: 'Mode.' },
        { name: 'note', scalar: 'text', capacity: 16, offset: 16, size: 16, summary: 'Note.' },
        { name: 'moving', scalar: 'boolean', offset: 32, size: 1, summary: 'Moves.' },
        { name: 'offset', scalar: 'i64', offset: 40, size: 8, summary: 'Signed.' },
      ],
    },
    {
      name: 'Track', summary: 'Two limits.', hash: '6', size: 32,
      fields: [{ name: 'parts', scalar: 'structure', type: 'Limits', shape: [2], offset: 0, size: 32, summary: 'Parts.' }],
    },
    { name: 'Image', summary: 'Image.', hash: '7', size: 8, image: true, fields: [] },
  ],
  devices: [],
  units: [
    {
      name: 'jog', type: 'jog', thread: 'operator', values_slot: 'jog.values', feedback_slot: 'jog.feedback',
      runtime: { step: 0.02 }, configuration: { lag: 0.25 }, restart: 'never',
      overrides: [
        { parameter: 'step', label: 'Schritt', range: [null, 0.05], widget: 'slider', place: 'overview' },
        { parameter: 'presses', hidden: true, place: 'overview' },
      ],
    },
  ],
  populations: [], groups: [],
  slots: ['jog.values JogRuntime', 'jog.feedback JogFeedback', 'track Track', 'camera Image'].map((line) => {
    const [name = '', type = ''] = line.split(' ');
    return { name, type, writer: '', readers: [], buffers: 3, observe: true, wall: false, history: 0, summary: '' };
  }),
  queues: [], threads: [],
  widgets: [{ name: 'arrows', kind: 'jog_arrows', slots: { pose: 'track' }, options: { size: 3 } }],
};

export interface SampleItem {
  readonly slot: number;
  readonly sequence?: number;
  readonly sampledAt?: number;
  readonly reason?: number;
  readonly jpeg?: boolean;
  readonly scaledBy?: number;
  readonly bytes?: Uint8Array;
}

/** A frame as the server writes it. */
export function frameOf(items: readonly SampleItem[], serverTime = 1_000_000_000, hash = sample.hash): ArrayBuffer {
  const padded = (size: number): number => Math.ceil(size / 8) * 8;
  const total = items.reduce((sum, item) => sum + 32 + padded(item.bytes?.length ?? 0), 32);
  const buffer = new ArrayBuffer(total);
  const view = new DataView(buffer);
  view.setBigUint64(0, BigInt(`0x${hash}`), true);
  view.setBigInt64(8, BigInt(serverTime), true);
  view.setUint32(16, items.length, true);
  view.setUint32(20, 2, true);
  view.setBigUint64(24, 7n, true);
  let at = 32;
  for (const item of items) {
    const bytes = item.bytes ?? new Uint8Array();
    view.setUint32(at, item.slot, true);
    view.setUint32(at + 4, bytes.length, true);
    view.setBigUint64(at + 8, BigInt(item.sequence ?? 1), true);
    view.setBigInt64(at + 16, BigInt(item.sampledAt ?? serverTime), true);
    view.setUint8(at + 24, item.reason ?? 0);
    view.setUint8(at + 25, item.jpeg ? 1 : 0);
    view.setUint16(at + 26, item.scaledBy ?? 0, true);
    view.setUint32(at + 28, 5, true);
    new Uint8Array(buffer).set(bytes, at + 32);
    at += 32 + padded(bytes.length);
  }
  return buffer;
}

/** The value of slot 0, jog.values. */
export function runtimeBytes(step: number): Uint8Array {
  const view = new DataView(new ArrayBuffer(88));
  view.setFloat64(0, step, true);
  for (let index = 0; index < 6; index += 1) view.setFloat64(8 + 8 * index, index + 1, true);
  view.setFloat64(56, -1, true);
  view.setFloat64(64, 2, true);
  view.setUint8(72, 1);
  view.setUint32(76, 9, true);
  return new Uint8Array(view.buffer);
}

/** The value of slot 1, jog.feedback. */
export function feedbackBytes(presses: bigint, mode: number, note: string): Uint8Array {
  const view = new DataView(new ArrayBuffer(48));
  view.setBigUint64(0, presses, true);
  view.setUint8(8, mode);
  new Uint8Array(view.buffer).set(new TextEncoder().encode(note).subarray(0, 16), 16);
  view.setUint8(32, 1);
  view.setBigInt64(40, -3n, true);
  return new Uint8Array(view.buffer);
}
