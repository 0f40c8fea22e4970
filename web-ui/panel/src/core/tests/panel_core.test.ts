import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { WidgetHost } from '../../contract';
import type { Model } from '../descriptor';
import { longestWait } from '../next_frame';
import { PanelCore, type PanelCoreOptions } from '../panel_core';
import type { BuiltInWidgets } from '../registry';
import { FakeSocket } from './fake_socket';
import { frameOf, runtimeBytes, sample } from './sample';

const you = { name: 'panel-1', user: '', address: '::1', local: true, you: true };
const state = {
  event: 'state', mode: 'running', cause: '', motion: { stopped: false, may_move: true }, faults: [],
  control: { holder: you, wanted_by: null }, edit: null,
  server: { connections: 1, places: 8, loop_delay_us: { p99: 1, max: 2 } },
};
let sockets: FakeSocket[] = [];
let hash = sample.hash;
const onModel = vi.fn<(model: Model) => void>();
const onNotice = vi.fn();
const fetched = vi.fn();
const loadBuiltIn = vi.fn<PanelCoreOptions['loadBuiltIn']>();
const makeMissing = vi.fn<PanelCoreOptions['makeMissing']>();
let core: PanelCore;

const newest = (): FakeSocket => sockets.at(-1) ?? new FakeSocket();
const settle = (): Promise<unknown> => vi.advanceTimersByTimeAsync(40);

beforeEach(async () => {
  vi.useFakeTimers();
  sockets = [];
  hash = sample.hash;
  [onModel, onNotice].forEach((mock) => mock.mockReset());
  loadBuiltIn.mockReset().mockRejectedValue(new Error('no line'));
  makeMissing.mockReset().mockImplementation((text) => Object.assign(document.createElement('p'), { textContent: text }));
  fetched.mockReset().mockImplementation(() => Promise.resolve(new Response(JSON.stringify({ ...sample, hash }))));
  vi.stubGlobal('fetch', fetched);
  core = new PanelCore({
    makeSocket: () => {
      sockets.push(new FakeSocket());
      return newest();
    },
    onModel, onNotice, loadBuiltIn, makeMissing,
  });
  core.start();
  newest().hello();
  await settle();
  newest().say(state);
  await settle();
});
afterEach(() => {
  core.connection.stop();
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

async function reconnect(fields: object): Promise<void> {
  newest().lose();
  await vi.advanceTimersByTimeAsync(400);
  newest().hello(fields);
  await settle();
}

describe('the core', () => {
  it('tells who watches also where no frame of the screen comes any more: a hidden page has a title, too', async () => {
    const told = vi.fn();
    core.watchState(told);
    vi.stubGlobal('requestAnimationFrame', () => 1);
    newest().say({ ...state, faults: [{ component: 'jog', kind: 'unit', cause: 'it broke', since_ns: 1 }] });
    await vi.advanceTimersByTimeAsync(longestWait);
    expect(told).toHaveBeenCalledOnce();
  });
  it('loads the description before anything is shown', () => {
    expect(onModel).toHaveBeenCalledOnce();
    expect(core.application).toBe('sample');
    expect(core.model.item('jog.step')?.label).toBe('Schritt');
    expect(core.host.locked('jog.step')).toBe('');
  });
  it('asks again for what is shown, and for nothing else, when the same application is back', async () => {
    core.host.watch('jog.step', () => undefined);
    await settle();
    await reconnect({});
    expect(onModel).toHaveBeenCalledOnce();
    expect(fetched.mock.calls.filter(([path]) => path === '/api/v1/descriptor')).toHaveLength(1);
    expect(newest().of('subscribe').at(-1)).toMatchObject({ slots: [{ name: 'jog.values', rate: 30 }] });
  });
  it('tells a restarted application from a reconnect', async () => {
    await reconnect({});
    expect(onNotice).not.toHaveBeenCalled();
    await reconnect({ boot: 'b' });
    expect(onNotice).toHaveBeenCalledWith('The application was started anew.', 'info');
    expect(onModel).toHaveBeenCalledOnce();
  });
  it('loads another description when the application is another', async () => {
    hash = '0000000000000009';
    await reconnect({ boot: 'b', descriptor: hash });
    expect(onModel).toHaveBeenCalledTimes(2);
    expect(core.model.hash).toBe(hash);
  });
  it('makes the page anew when a device has another driver', async () => {
    await reconnect({ drivers: { arm: 'simulated' } });
    expect(onModel).toHaveBeenCalledTimes(2);
    await reconnect({ drivers: { arm: 'simulated' } });
    expect(onModel).toHaveBeenCalledTimes(2);
    await reconnect({ boot: 'b', drivers: { arm: 'real' } });
    expect(onModel).toHaveBeenCalledTimes(3);
    expect(core.model.drivers).toEqual({ arm: 'real' });
  });
  it('tries again, after a while, when the description cannot be had', async () => {
    fetched.mockImplementation(() => Promise.resolve(new Response('{"title":"No"}', { status: 500 })));
    await reconnect({ boot: 'b', descriptor: '0000000000000009' });
    expect(core.link).toMatchObject({ phase: 'waiting', detail: expect.stringContaining('No') as string });
    const tried = sockets.length;
    await vi.advanceTimersByTimeAsync(400);
    expect(sockets).toHaveLength(tried + 1);
  });
  it('hands values to who watches, and none from before a loss', async () => {
    const seen: unknown[] = [];
    core.host.watch('jog.step', (reading) => seen.push(reading.value));
    newest().say(frameOf([{ slot: 0, bytes: runtimeBytes(0.03) }]));
    await settle();
    expect(seen).toEqual([0.03]);
    await reconnect({});
    const later = vi.fn();
    core.host.watch('jog.step', later);
    expect(later).not.toHaveBeenCalled();
  });
  it('ends holds with control, with Stop motion, and with the link', async () => {
    const causes: [string, () => unknown][] = [
      ['control was lost', () => newest().say({ ...state, control: { holder: null, wanted_by: null } })],
      ['motion is stopped', () => newest().say({ ...state, motion: { stopped: true, may_move: false } })],
      ['the link is lost', () => newest().lose()],
    ];
    for (const [reason, cause] of causes) {
      newest().say(state);
      const asked = core.host.hold('jog.forward');
      newest().say({ id: newest().of('hold').at(-1)?.['id'], ok: true, lease: reason });
      const hold = await asked;
      cause();
      expect(await hold.over).toBe(reason);
    }
  });
  it('says that values are old, and calls who watches access', async () => {
    const watcher = vi.fn();
    core.host.watchAccess(watcher);
    newest().say(frameOf([]));
    await settle();
    watcher.mockClear();
    await vi.advanceTimersByTimeAsync(1300);
    expect(core.host.stale).toBe(true);
    expect(core.host.locked('jog.step')).toBe('values are old');
    expect(watcher).toHaveBeenCalled();
  });
  it('keeps each line of the log once', async () => {
    const lines: string[] = [];
    core.watchLog((fresh) => fresh.forEach((line) => lines.push(line.text)));
    await settle();
    expect(newest().of('subscribe').at(-1)).toMatchObject({ topics: [{ name: 'log', rate: 10 }] });
    newest().say({ event: 'log', lines: [{ number: 1, text: 'a' }, { number: 2, text: 'b' }] });
    newest().say({ event: 'log', lines: [{ number: 2, text: 'b' }, { number: 3, text: 'c' }] });
    expect(lines).toEqual(['a', 'b', 'c']);
    const again: string[] = [];
    core.watchLog((fresh) => fresh.forEach((line) => again.push(line.text)));
    expect(again).toEqual(['a', 'b', 'c']);
  });
  it('gives a topic to all who watch it, and the last one at once', () => {
    const first = vi.fn();
    core.watchTopic('threads', first);
    newest().say({ event: 'topic', name: 'threads', body: [{ name: 'control' }] });
    const second = vi.fn();
    core.watchTopic('threads', second);
    expect(first).toHaveBeenCalledWith([{ name: 'control' }]);
    expect(second).toHaveBeenCalledWith([{ name: 'control' }]);
  });
  it('puts another element where a widget cannot be had, and the widget in its place when it can', async () => {
    const item = core.model.item('jog.step')!;
    const missing = await core.createWidget({ item });
    expect(missing.textContent).toMatch(/^Schritt cannot be shown: it could not be loaded/);
    const again = makeMissing.mock.calls[0]![1];
    const place = document.createElement('div');
    place.append(missing);
    const other = { ...core.host } as unknown as WidgetHost;
    missing.host = other;
    const builtIn: BuiltInWidgets = {
      registerBuiltIn: (register) => register('plain', class extends HTMLElement { host!: WidgetHost; }),
      registerFurther: () => Promise.resolve(() => Promise.resolve(undefined)),
      kindOf: () => 'plain',
      placedKind: () => 'plain',
    };
    loadBuiltIn.mockResolvedValue(builtIn);
    await again();
    expect(place.firstElementChild).toMatchObject({ localName: 'flexrf-widget-plain', host: other, item });
    expect(makeMissing).toHaveBeenCalledOnce();
  });
});
