// @vitest-environment node
import { beforeEach, describe, expect, it, vi } from 'vitest';
import type { Reading } from '../../contract';
import { decodeFrame } from '../decode';
import { makeModel } from '../descriptor';
import { Store } from '../store';
import { feedbackBytes, frameOf, runtimeBytes, sample, type SampleItem } from './sample';

const model = makeModel(sample);
let frames: ((time: number) => void)[] = [];
let store: Store;

function animate(time: number): void {
  const due = frames;
  frames = [];
  due.forEach((callback) => callback(time));
}
function arrive(items: readonly SampleItem[], hash?: string): boolean {
  const frame = decodeFrame(frameOf(items, 1_000_000_000, hash));
  if (!frame) throw new Error('no frame');
  return store.apply(frame);
}
function item(key: string): NonNullable<ReturnType<typeof model.item>> {
  const found = model.item(key);
  if (!found) throw new Error(key);
  return found;
}

beforeEach(() => {
  frames = [];
  store = new Store({ serverNow: () => 3_000_000_000, requestFrame: (callback) => frames.push(callback) });
  store.beginLink(['none', 'nothing yet', 'too old', 'writer stopped', 'writer in fault']);
  store.reset(model);
});

describe('store', () => {
  it('gives everybody the newest value in one animation frame', () => {
    const seen: [string, unknown][] = [];
    for (const key of ['jog.step', 'jog.gains[1]', 'jog.limits.high', 'slot:jog.values.step']) {
      store.watch(item(key), (reading) => seen.push([key, reading.value]), 60);
    }
    arrive([{ slot: 0, bytes: runtimeBytes(0.01) }]);
    arrive([{ slot: 0, bytes: runtimeBytes(0.03) }]);
    expect(frames).toHaveLength(1);
    expect(seen).toEqual([]);
    animate(1000);
    expect(seen).toEqual([['jog.step', 0.03], ['jog.gains[1]', [2, 4, 6]], ['jog.limits.high', 2], ['slot:jog.values.step', 0.03]]);
    animate(2000);
    expect(seen).toHaveLength(4);
  });
  it('calls back at once with what is known', () => {
    arrive([{ slot: 1, sequence: 4, sampledAt: 2_000_000_000, bytes: feedbackBytes(7n, 1, 'x') }]);
    const callback = vi.fn<(reading: Reading) => void>();
    store.watch(item('jog.feedback.presses'), callback);
    expect(callback).toHaveBeenCalledWith({ value: 7, reason: '', sampledAt: 2_000_000_000, sequence: 4, age: 1 });
  });
  it('keeps to the rate, and still delivers the last value', () => {
    const seen: unknown[] = [];
    store.watch(item('jog.step'), (reading) => seen.push(reading.value), 10);
    [0, 16, 32, 48, 64, 80, 96].forEach((time) => {
      arrive([{ slot: 0, bytes: runtimeBytes(time + 1) }]);
      animate(time);
    });
    expect(seen).toEqual([1, 97]);
  });
  it('says why there is no value', () => {
    const callback = vi.fn<(reading: Reading) => void>();
    store.watch(item('jog.step'), callback);
    arrive([{ slot: 0, reason: 3, sequence: 9 }]);
    animate(0);
    expect(callback).toHaveBeenCalledWith(expect.objectContaining({ value: null, reason: 'writer stopped', sequence: 9 }));
    arrive([{ slot: 0, reason: 77, sequence: 9 }]);
    expect(store.reading(item('jog.step'))).toMatchObject({ value: null, reason: 'unknown reason 77' });
  });
  it('does not read beyond a value that is too short', () => {
    arrive([{ slot: 0, bytes: runtimeBytes(1).slice(0, 40) }]);
    expect(store.reading(item('jog.step'))).toMatchObject({ value: null, reason: 'wrong type' });
  });
  it('hands out an image, the same as long as it is the same', () => {
    arrive([{ slot: 3, jpeg: true, scaledBy: 2, bytes: new Uint8Array([0xff, 0xd8]) }]);
    expect(store.reading(item('slot:camera'))?.scaledBy).toBe(2);
    const image = store.reading(item('slot:camera'))?.image;
    expect(image).toMatchObject({ size: 2, type: 'image/jpeg' });
    expect(store.reading(item('slot:camera'))?.image).toBe(image);
  });
  it('says where to look for why there is no image', () => {
    arrive([{ slot: 3, jpeg: true, bytes: new Uint8Array() }]);
    expect(store.reading(item('slot:camera'))).toMatchObject({ value: null, reason: 'the picture cannot be shown: the log says why' });
    arrive([{ slot: 3, jpeg: true, reason: 4, bytes: new Uint8Array() }]);
    expect(store.reading(item('slot:camera'))).toMatchObject({ value: null, reason: 'writer in fault' });
  });
  it('leaves a frame of another application alone', () => {
    expect(arrive([{ slot: 0, bytes: runtimeBytes(1) }], '0000000000000001')).toBe(false);
    expect(store.reading(item('jog.step'))).toBeUndefined();
  });
  it('forgets a slot, and everything', () => {
    arrive([{ slot: 0, bytes: runtimeBytes(1) }, { slot: 1, bytes: feedbackBytes(1n, 0, '') }]);
    store.forgetSlot(0);
    expect(store.reading(item('jog.step'))).toBeUndefined();
    store.beginLink([]);
    expect(store.reading(item('jog.feedback.mode'))).toBeUndefined();
  });
  it('does not call who has gone, and one that throws harms nobody', () => {
    const error = vi.spyOn(console, 'error').mockImplementation(() => undefined);
    const gone = vi.fn();
    const later = vi.fn();
    store.watch(item('jog.step'), gone)();
    store.watch(item('jog.step'), () => { throw new Error('broken widget'); });
    store.watch(item('jog.step'), later);
    arrive([{ slot: 0, bytes: runtimeBytes(1) }]);
    animate(0);
    expect(gone).not.toHaveBeenCalled();
    expect(later).toHaveBeenCalledOnce();
    expect(error).toHaveBeenCalledOnce();
    error.mockRestore();
  });
});
