import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { FakeSocket } from '../../core/tests/fake_socket';
import { sample } from '../../core/tests/sample';
import { PanelCore } from '../../core/panel_core';
import type { Control, Consent } from '../control';
import '../control';
import { linkText } from '../header';
import { addressOfRoute, parseRoute } from '../router';
import '../stop_motion';
import type { StopMotion } from '../stop_motion';
import { remedyOf, stopText } from '../words';

describe('router', () => {
  it.each([
    ['', 'overview', []], ['#/units/axis%5B0%5D.drive', 'units', ['axis[0].drive']], ['#/log/', 'log', []],
    ['#/menu/a%2Fb', 'menu', ['a/b']], ['#/units/100%', 'units', ['100%']],
  ])('%s', (hash, view, path) => expect(parseRoute(hash, 'overview')).toEqual({ view, path }));
  it('finds back what it wrote', () => {
    const route = { view: 'blackboard', path: ['axis[1].goal', 'ä/b c'] };
    expect(parseRoute(addressOfRoute(route), '')).toEqual(route);
  });
});

describe('words', () => {
  it('say how the link is', () => {
    const link = { phase: 'open', stale: false, roundTrip: 3.21, silence: 120, detail: '' } as const;
    expect(linkText(link)).toBe('Round trip 3.2 ms\ndata 0.1 s old');
    expect(linkText({ ...link, stale: true, silence: 1400 })).toBe('⚠ Silent for 1.4 s');
    expect(linkText({ ...link, phase: 'waiting' })).toBe('✕ No connection');
  });
  it('give a remedy, the fault\'s own where it has one', () => {
    expect(remedyOf({ component: 'robot', kind: 'unit', cause: 'x', remedy: 'Press reset.' })).toBe('Press reset.');
    // Initialised it runs already; what is missing is Start motion.
    expect(remedyOf({ component: 'robot', kind: 'unit', cause: 'x' })).toMatch(/initialise robot on its page\. .*Start motion\.$/);
    expect(remedyOf({ component: 'robot', kind: 'unit', cause: 'x' })).not.toContain('start it');
  });
});

it('says who stopped, and when', () => {
  const at = new Date(2026, 10, 23, 15, 4, 5);
  const state = (motion: object): Parameters<typeof stopText>[0] => ({ motion }) as Parameters<typeof stopText>[0];
  const stopped = state({ stopped: true, may_move: false, stopped_by: { who: 'anna (10.0.0.2)', at_ms: at.getTime() } });
  expect(stopText(stopped, at)).toBe('by anna (10.0.0.2) at 15:04:05');
  expect(stopText(stopped, new Date(2026, 10, 24))).toBe('by anna (10.0.0.2) at 2026-11-23 15:04:05');
  expect(stopText(state({ stopped: true, may_move: false, stopped_by: null }), at)).toBe('');
  expect(stopText(state({ stopped: false, may_move: true, stopped_by: { who: 'anna', at_ms: 1 } }), at)).toBe('');
});

const other = { name: 'panel-2', user: 'anna', address: '10.0.0.2', local: false, you: false };
const you = { ...other, name: 'panel-1', user: '', you: true };

describe('parts of the shell', () => {
  let socket: FakeSocket;
  let core: PanelCore;
  const fetched = vi.fn();

  function say(control: object, motion = { stopped: false, may_move: true }): void {
    socket.say({
      event: 'state', mode: 'running', cause: '', motion, faults: [], control, edit: null,
      server: { connections: 1, places: 8, loop_delay_us: { p99: 1, max: 2 } },
    });
  }
  async function shown<Part extends HTMLElement>(tag: string): Promise<Part> {
    const part = Object.assign(document.createElement(tag), { core }) as unknown as Part;
    document.body.append(part);
    await settle();
    return part;
  }
  const settle = (): Promise<unknown> => vi.advanceTimersByTimeAsync(40);
  const button = (part: HTMLElement, text: RegExp): HTMLButtonElement => {
    const found = [...(part.shadowRoot?.querySelectorAll('button') ?? [])].find((one) => text.test(one.textContent ?? ''));
    if (!found) throw new Error(`no button ${text}`);
    return found;
  };

  beforeEach(async () => {
    vi.useFakeTimers();
    fetched.mockReset().mockImplementation(() => Promise.resolve(new Response(JSON.stringify(sample))));
    vi.stubGlobal('fetch', fetched);
    socket = new FakeSocket();
    core = new PanelCore({ makeSocket: () => socket, onModel: () => undefined, onNotice: () => undefined });
    core.start();
    socket.hello();
    await settle();
    say({ holder: null, wanted_by: null });
  });
  afterEach(() => {
    document.body.replaceChildren();
    core.connection.stop();
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  it('Stop motion is given when the button goes down, not when it comes up', async () => {
    const stop = button(await shown<StopMotion>('flexrf-stop-motion'), /Stop motion/);
    stop.dispatchEvent(new MouseEvent('pointerdown', { button: 0 }));
    expect(socket.of('stop_motion')).toHaveLength(1);
    stop.dispatchEvent(new MouseEvent('click', { detail: 1 })); // belongs to the same press
    expect(socket.of('stop_motion')).toHaveLength(1);
    stop.dispatchEvent(new MouseEvent('click', { detail: 0 })); // of a key
    expect(socket.of('stop_motion')).toHaveLength(2);
  });
  it('Stop motion takes the other way when the first gives no answer', async () => {
    const stop = button(await shown<StopMotion>('flexrf-stop-motion'), /Stop motion/);
    stop.click();
    await vi.advanceTimersByTimeAsync(250);
    expect(fetched).toHaveBeenCalledWith('/api/v1/stop-motion', expect.objectContaining({ method: 'POST' }));
  });
  it('Stop motion looks dead without a link, says what to do, and tries all the same', async () => {
    const part = await shown<StopMotion>('flexrf-stop-motion');
    socket.lose();
    await settle();
    expect(button(part, /Stop motion/).getAttribute('aria-disabled')).toBe('true');
    expect(part.shadowRoot?.textContent).toContain('emergency stop at the machine');
    button(part, /Stop motion/).click();
    await settle();
    expect(fetched).toHaveBeenCalledWith('/api/v1/stop-motion', expect.anything());
  });
  it('Stop motion says that it is no emergency stop', async () => {
    const part = await shown<StopMotion>('flexrf-stop-motion');
    expect(part.shadowRoot?.textContent).toContain('Neither an emergency stop nor an enabling device');
  });

  it('control is taken, asked for, and given back', async () => {
    const part = await shown<Control>('flexrf-control');
    button(part, /Take control/).click();
    expect(socket.of('take_control')).toHaveLength(1);
    socket.say({ id: socket.of('take_control')[0]?.['id'], ok: true });
    say({ holder: other, wanted_by: null });
    await settle();
    expect(part.shadowRoot?.textContent).toContain('anna at 10.0.0.2 has control');
    expect(button(part, /Ask for control/).disabled).toBe(false);
    say({ holder: other, wanted_by: you, answer_within_ms: 9000 });
    await settle();
    expect(button(part, /Asked/).disabled).toBe(true);
    say({ holder: you, wanted_by: null });
    await settle();
    button(part, /Release/).click();
    expect(socket.of('release_control')).toHaveLength(1);
  });
  it('the holder is asked, with the time that is left', async () => {
    const part = await shown<Consent>('flexrf-consent');
    expect(part.shadowRoot?.querySelector('button')).toBeNull();
    say({ holder: you, wanted_by: other, answer_within_ms: 9900 });
    await settle();
    expect(part.shadowRoot?.textContent).toContain('Handed over in 10 s');
    socket.say({ id: 999, ok: true });
    await vi.advanceTimersByTimeAsync(500);
    say({ holder: you, wanted_by: other, answer_within_ms: 4200 });
    await vi.advanceTimersByTimeAsync(500);
    expect(part.shadowRoot?.textContent).toContain('Handed over in 4 s');
    button(part, /Keep/).click();
    expect(socket.of('answer_control')).toMatchObject([{ grant: false }]);
  });
  it('nobody else is asked', async () => {
    const part = await shown<Consent>('flexrf-consent');
    say({ holder: other, wanted_by: you, answer_within_ms: 9900 });
    await settle();
    expect(part.shadowRoot?.querySelector('button')).toBeNull();
  });
});
