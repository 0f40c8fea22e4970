// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { decodeFrame, decodeField, decodeStructure } from '../decode';
import { makeTypes } from '../types';
import { feedbackBytes, frameOf, runtimeBytes, sample } from './sample';

const types = makeTypes(sample.types);
const viewOf = (bytes: Uint8Array): DataView => new DataView(bytes.buffer);

describe('decodeFrame', () => {
  it('reads the headers and finds each value', () => {
    const frame = decodeFrame(frameOf([
      { slot: 3, sequence: 8, sampledAt: 900_000_000, jpeg: true, scaledBy: 3, bytes: new Uint8Array([1, 2, 3]) },
      { slot: 1, reason: 3 },
    ]));
    expect(frame?.hash).toBe(sample.hash);
    expect(frame).toMatchObject({ serverTime: 1_000_000_000, dropped: 2, number: 7 });
    expect(frame?.items[0]).toMatchObject({ slot: 3, sequence: 8, sampledAt: 900_000_000, jpeg: true, scaledBy: 3, missed: 5, reason: 0 });
    expect(frame?.items[0]?.bytes.byteLength).toBe(3);
    expect(frame?.items[1]).toMatchObject({ slot: 1, reason: 3 });
  });
  it('takes a heartbeat', () => {
    expect(decodeFrame(frameOf([]))?.items).toEqual([]);
  });
  it.each([0, 31, 40, 63, 64, 66])('refuses a frame that was cut after %i bytes', (length) => {
    const whole = frameOf([{ slot: 0, bytes: new Uint8Array([1, 2, 3]) }]);
    expect(decodeFrame(whole.slice(0, length))).toBeUndefined();
  });
  it('refuses a size beyond the end', () => {
    const buffer = frameOf([{ slot: 0, bytes: new Uint8Array(8) }]);
    new DataView(buffer).setUint32(36, 0xffffffff, true);
    expect(decodeFrame(buffer)).toBeUndefined();
  });
  it('refuses more items than there are', () => {
    const buffer = frameOf([{ slot: 0 }]);
    new DataView(buffer).setUint32(16, 2, true);
    expect(decodeFrame(buffer)).toBeUndefined();
  });
});

describe('values', () => {
  it('decodes a structure with matrix, members, hold and button', () => {
    const type = types.get('JogRuntime');
    expect(type && decodeStructure(viewOf(runtimeBytes(0.02)), 0, type, types)).toEqual({
      step: 0.02, gains: [[1, 3, 5], [2, 4, 6]], limits: { low: -1, high: 2 }, forward: true, home: 9,
    });
  });
  it('decodes 64 bits, enumerations, texts and booleans', () => {
    const type = types.get('JogFeedback');
    expect(type && decodeStructure(viewOf(feedbackBytes(5_000_000_000n, 1, 'grüß')), 0, type, types)).toEqual({
      presses: 5_000_000_000, mode: 'manual', note: 'grüß', moving: true, offset: -3,
    });
  });
  it('keeps the number of an enumeration that it does not know, and a text without an end', () => {
    const bytes = viewOf(feedbackBytes(0n, 9, '0123456789abcdefgh'));
    const fields = types.get('JogFeedback')?.fields ?? [];
    expect(fields.slice(1, 3).map((field) => decodeField(bytes, 0, field, types))).toEqual([9, '0123456789abcdef']);
  });
  it.each([
    ['bool', 1, [1], true], ['i8', 1, [0xff], -1], ['u8', 1, [0xff], 255], ['i16', 2, [0xfe, 0xff], -2],
    ['u16', 2, [1, 2], 513], ['i32', 4, [0xff, 0xff, 0xff, 0xff], -1], ['u32', 4, [0, 0, 0, 0x80], 2147483648],
    ['f32', 4, [0, 0, 0x80, 0x3f], 1],
  ] as const)('decodes %s', (scalar, size, bytes, expected) => {
    const field = { name: 'x', scalar, shape: [], offset: 0, elementSize: size, count: 1, unit: '', summary: '' };
    expect(decodeField(viewOf(new Uint8Array(bytes)), 0, field, types)).toBe(expected);
  });
});
