import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { ConfigurationValues } from '../configuration';
import { decodeFrame } from '../decode';
import { makeModel, type Model } from '../descriptor';
import { Holds } from '../holds';
import { Host } from '../host';
import type { Answer } from '../protocol';
import { Store } from '../store';
import { Subscriptions } from '../subscriptions';
import { driven } from './cell';
import { frameOf, runtimeBytes, sample } from './sample';

const model = makeModel(sample);
let answers: ((answer: object) => void)[] = [];
const request = vi.fn<(op: string, fields: object) => Promise<Answer>>();
const fetchValues = vi.fn(() => Promise.resolve({ lag: 0.75 }));
let host: Host;
let store: Store;
let subscriptions: Subscriptions;

beforeEach(() => {
  answers = [];
  request.mockReset().mockImplementation(() => new Promise((resolve) => {
    answers.push((answer) => resolve(answer as Answer));
  }));
  fetchValues.mockClear();
  store = new Store({ serverNow: () => 0 });
  store.reset(model);
  subscriptions = new Subscriptions({ request, onSlotGone: () => undefined, onProblem: () => undefined });
  host = hostOf(model);
});
afterEach(() => vi.unstubAllGlobals());

function hostOf(known: Model): Host {
  return new Host({
    item: (key) => known.item(key), joints: (device) => known.joints(device), units: () => known.json.units, store, subscriptions,
    watchList: () => () => undefined,
    configuration: new ConfigurationValues(fetchValues),
    holds: new Holds({ request: request as never, send: () => true, nextId: () => 1, listen: () => () => undefined }),
    request: request as never,
    locked: (item) => (item ? '' : 'unknown'),
    stale: () => false,
    watchAccess: () => () => undefined,
  });
}

describe('what belongs to a driver that is not there', () => {
  it('reads as NULL with the reason', () => {
    for (const key of ['motor.boost', 'motor.feedback.heat']) {
      const seen = vi.fn();
      hostOf(makeModel(driven)).watch(key, seen)();
      expect(seen.mock.calls).toEqual([[expect.objectContaining({ value: null, reason: "the driver is 'model'; this belongs to 'can'" })]]);
    }
    expect(request).not.toHaveBeenCalled();
  });
});

describe('set', () => {
  it('sends one value, and of those that follow before the answer only the newest', async () => {
    const outcomes = [1, 2, 3, 4].map((value) => host.set('jog.step', value));
    expect(request.mock.calls).toEqual([['set', { component: 'jog', values: { step: 1 } }]]);
    answers[0]?.({ id: 1, ok: true, sequence: 1, values: { step: 1 } });
    expect(await outcomes[0]).toEqual({ ok: true, values: { step: 1 } });
    await vi.waitFor(() => expect(request).toHaveBeenCalledTimes(2));
    expect(request).toHaveBeenLastCalledWith('set', { component: 'jog', values: { step: 4 } });
    answers[1]?.({ id: 2, ok: false, problem: { title: 'Refused', detail: 'above 0.05', parameter: 'step' } });
    const refused = { ok: false, detail: 'above 0.05', parameter: 'step' };
    expect(await Promise.all(outcomes.slice(1))).toEqual([refused, refused, refused]);
    void host.set('jog.step', 5);
    expect(request).toHaveBeenLastCalledWith('set', { component: 'jog', values: { step: 5 } });
  });
  it('does not make one parameter wait for another', () => {
    void host.set('jog.step', 1);
    void host.set('jog.gains[1][2]', 7);
    expect(request).toHaveBeenLastCalledWith('set', { component: 'jog', values: { 'gains[1][2]': 7 } });
  });
  it('keeps values apart as it is asked to, and leaves out what was given up meanwhile', async () => {
    vi.useFakeTimers();
    const given = new AbortController();
    const dragged = { spacing: 100, signal: given.signal };
    void host.set('jog.step', 1, dragged);
    answers[0]?.({ id: 1, ok: true });
    await vi.advanceTimersByTimeAsync(0);
    const second = host.set('jog.step', 2, dragged);
    await vi.advanceTimersByTimeAsync(99);
    expect(request).toHaveBeenCalledTimes(1);
    await vi.advanceTimersByTimeAsync(1);
    expect(request).toHaveBeenLastCalledWith('set', { component: 'jog', values: { step: 2 } });
    const third = host.set('jog.step', 3, dragged);
    given.abort();
    answers[1]?.({ id: 2, ok: true });
    await vi.advanceTimersByTimeAsync(200);
    expect(await second).toEqual({ ok: true });
    expect(await third).toMatchObject({ ok: false });
    expect(request).toHaveBeenCalledTimes(2);
    vi.useRealTimers();
  });
  it('refuses what is no parameter', async () => {
    expect(await host.set('nothing', 1)).toMatchObject({ ok: false });
    expect(await host.set('jog.feedback.presses', 1)).toMatchObject({ ok: false });
    expect(request).not.toHaveBeenCalled();
  });
});

describe('other operations', () => {
  it('press, with a count', async () => {
    const outcome = host.press('jog.home', 2);
    expect(request).toHaveBeenCalledWith('press', { component: 'jog', parameter: 'home', count: 2 });
    answers[0]?.({ id: 1, ok: true });
    expect(await outcome).toEqual({ ok: true });
  });
  it('reset one parameter', () => {
    void host.reset('jog.step');
    expect(request).toHaveBeenCalledWith('reset', { component: 'jog', parameters: ['step'] });
  });
  it('hold', async () => {
    const hold = host.hold('jog.forward');
    answers[0]?.({ id: 1, ok: true, lease: 'a' });
    (await hold).release();
    await expect(host.hold('nothing')).rejects.toThrow();
  });
});

describe('taking back', () => {
  const inForce = (step: number): void => void store.apply(decodeFrame(frameOf([{ slot: 0, bytes: runtimeBytes(step) }]))!);
  const answer = async (index: number, values: object): Promise<void> => {
    await vi.waitFor(() => expect(answers.length).toBeGreaterThan(index));
    answers[index]?.({ id: 1, ok: true, sequence: 1, values });
  };

  it('sets what was in force before, and only as long as nobody changed it', async () => {
    inForce(0.01);
    const set = host.set('jog.step', 0.03);
    await answer(0, { step: 0.03 });
    await set;
    inForce(0.03);
    const undone = host.undo();
    expect(request).toHaveBeenLastCalledWith('set', { component: 'jog', values: { step: 0.01 } });
    await answer(1, { step: 0.01 });
    expect((await undone).ok).toBe(true);
    expect(host.history.last).toBeUndefined();
    expect(await host.undo()).toMatchObject({ ok: false });

    inForce(0.01);
    const again = host.set('jog.step', 0.04);
    await answer(2, { step: 0.04 });
    await again;
    inForce(0.02);
    expect(await host.undo()).toMatchObject({ ok: false, detail: expect.stringContaining('changed elsewhere') });
    expect(request).toHaveBeenCalledTimes(3);
  });

  it('keeps a change that could not be taken back, and none that was refused', async () => {
    inForce(0.01);
    const refused = host.set('jog.step', 7);
    answers[0]?.({ id: 1, ok: false, problem: { title: 'Refused' } });
    await refused;
    expect(host.history.last).toBeUndefined();
    const set = host.set('jog.step', 0.03);
    await answer(1, { step: 0.03 });
    await set;
    const undone = host.undo();
    answers[2]?.({ id: 3, ok: false, problem: { title: 'Take control first' } });
    expect((await undone).ok).toBe(false);
    expect(host.history.last).toBeDefined();
  });

  it('takes a reset of several back as one', async () => {
    inForce(0.03);
    const reset = host.resetAll('jog', ['step', 'limits']);
    expect(request).toHaveBeenLastCalledWith('reset', { component: 'jog', parameters: ['step', 'limits'] });
    await answer(0, { step: 0.02, limits: { low: 0, high: 1 } });
    await reset;
    void host.undo();
    expect(request).toHaveBeenLastCalledWith('set', { component: 'jog', values: { step: 0.03, limits: { low: -1, high: 2 } } });
  });

  it('remembers nothing of what it did not know before', async () => {
    const set = host.set('jog.step', 0.03);
    await answer(0, { step: 0.03 });
    await set;
    expect(host.history.last).toBeUndefined();
  });
});

describe('watch', () => {
  it('subscribes to the slot behind the item, with rate and width', () => {
    vi.useFakeTimers();
    const end = host.watch('jog.feedback.mode', () => undefined, { rate: 5 });
    host.watch('slot:camera', () => undefined, { rate: 15, width: 320 });
    subscriptions.resubscribe();
    expect(request).toHaveBeenLastCalledWith('subscribe', {
      slots: [{ name: 'jog.feedback', rate: 5 }, { name: 'camera', rate: 15, width: 320 }], topics: [],
    });
    end();
    subscriptions.resubscribe();
    expect(request).toHaveBeenLastCalledWith('subscribe', { slots: [{ name: 'camera', rate: 15, width: 320 }], topics: [] });
    vi.useRealTimers();
  });
  it('asks once for a component\'s configuration', async () => {
    const first = vi.fn();
    const second = vi.fn();
    host.watch('jog.configuration.lag', first);
    host.watch('jog.configuration.lag', second);
    await vi.waitFor(() => expect(second).toHaveBeenCalledWith(expect.objectContaining({ value: 0.75, reason: '' })));
    expect(first).toHaveBeenCalledOnce();
    expect(fetchValues).toHaveBeenCalledExactlyOnceWith('jog');
  });
  it('says so when nothing has this name', () => {
    const callback = vi.fn();
    host.watch('nothing', callback);
    expect(callback).toHaveBeenCalledWith(expect.objectContaining({ value: null, reason: 'nothing is called nothing' }));
  });
});

describe('file', () => {
  it('is one of the application\'s folder', async () => {
    const fetched = vi.fn(() => Promise.resolve(new Response('x')));
    vi.stubGlobal('fetch', fetched);
    await host.file('robots/./a b.urdf');
    expect(fetched).toHaveBeenCalledWith('/application/robots/a%20b.urdf');
    await expect(host.file('../secret')).rejects.toThrow();
    await expect(host.file('https://elsewhere/x')).rejects.toThrow();
    expect(fetched).toHaveBeenCalledOnce();
  });
});
