import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { FakeSocket } from '../../core/tests/fake_socket';
import { sample } from '../../core/tests/sample';
import { PanelCore } from '../../core/panel_core';
import type { Consent } from '../consent';
import '../consent';
import type { Control } from '../control';
import '../control';
import type { Faults } from '../faults';
import { linkText, type Header } from '../header';
import { makeMissing } from '../missing';
import type { PasswordDialog } from '../password';
import '../password';
import '../stop_motion';
import type { StopMotion } from '../stop_motion';

it('says how the link is', () => {
  const link = { phase: 'open', stale: false, roundTrip: 3.21, silence: 120, detail: '' } as const;
  expect(linkText(link)).toBe('Round trip 3.2 ms\ndata 0.1 s old');
  expect(linkText({ ...link, stale: true, silence: 1400 })).toBe('⚠ Silent for 1.4 s');
  expect(linkText({ ...link, phase: 'waiting' })).toBe('✕ No connection');
});

const other = { name: 'panel-2', user: 'anna', address: '10.0.0.2', local: false, you: false };
const you = { ...other, name: 'panel-1', user: '', you: true };

describe('parts of the shell', () => {
  let socket: FakeSocket;
  let core: PanelCore;
  const fetched = vi.fn();

  const noticed: string[] = [];

  function say(control: object, motion: object = { stopped: false, may_move: true }, faults: object[] = [], mode = 'running'): void {
    socket.say({
      event: 'state', mode, cause: '', motion, faults, control, edit: null,
      server: { connections: 1, places: 8, loop_delay_us: { p99: 1, max: 2 } },
    });
  }
  async function shown<Part extends HTMLElement>(tag: string, more: object = {}): Promise<Part> {
    const part = Object.assign(document.createElement(tag), { core, ...more }) as unknown as Part;
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
    core = new PanelCore({
      makeSocket: () => socket, onModel: () => undefined, onNotice: (text) => noticed.push(text),
      loadBuiltIn: () => Promise.reject(new Error('not needed')), makeMissing,
    });
    noticed.length = 0;
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

  it('Start that would be refused cannot be pressed, and says why', async () => {
    const header = await shown<Header>('flexrf-header');
    const mine = { holder: you, wanted_by: null };
    const updated = { stopped: false, may_move: false, start_refused: 'this machine does not permit motion: it is being updated' };
    say(mine, updated);
    await vi.advanceTimersByTimeAsync(1000);
    say(mine, updated); // the link is not silent
    await settle();
    expect(button(header, /Start motion/).disabled).toBe(true);
    expect(header.shadowRoot?.textContent).toContain('this machine does not permit motion: it is being updated');
    say(mine, { stopped: false, may_move: false, start_refused: '' });
    await settle();
    expect(button(header, /Start motion/).disabled).toBe(false);
    expect(header.shadowRoot?.textContent).not.toContain('updated');
  });
  it('a password is asked for with what it is for, and again when it is wrong', async () => {
    const given: string[] = [];
    let closed = 0;
    const question = {
      heading: 'Restart the PC now?', says: ['The application ends.', 'Nothing moves after it.'], action: 'Restart now',
      act: (password: string) => {
        given.push(password);
        return Promise.resolve(given.length === 1 ? 'User or password is wrong.' : '');
      },
    };
    const dialog = await shown<PasswordDialog>('flexrf-password', { question });
    dialog.addEventListener('close', () => { closed += 1; });
    expect(dialog.shadowRoot?.textContent).toMatch(/The application ends\.\s*Nothing moves after it\./);
    const form = dialog.shadowRoot!.querySelector('form')!;
    const field = dialog.shadowRoot!.querySelector<HTMLInputElement>('[type=password]')!;
    for (const password of ['wrong', 'right']) {
      field.value = password;
      form.dispatchEvent(new SubmitEvent('submit', { cancelable: true }));
      await settle();
      if (password === 'wrong') expect(dialog.shadowRoot?.querySelector('[role=alert]')?.textContent).toContain('password is wrong');
    }
    expect(given).toEqual(['wrong', 'right']);
    expect(closed).toBe(1);
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
  it('Stop motion is given when a key goes down, once for each press, and whatever key comes then', async () => {
    const stop = button(await shown<StopMotion>('flexrf-stop-motion'), /Stop motion/);
    for (const key of [' ', 'Enter']) {
      const down = new KeyboardEvent('keydown', { key, cancelable: true });
      stop.dispatchEvent(down);
      expect(down.defaultPrevented).toBe(true); // no click follows
      stop.dispatchEvent(new KeyboardEvent('keydown', { key, repeat: true }));
    }
    expect(socket.of('stop_motion')).toHaveLength(2);
    stop.dispatchEvent(new KeyboardEvent('keydown', { key: 'Escape' }));
    expect(socket.of('stop_motion')).toHaveLength(2);
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
    // It has taken the place of what was pressed: a second press is not for it.
    button(part, /Release/).click();
    expect(socket.of('release_control')).toHaveLength(0);
    vi.advanceTimersByTime(1000);
    say({ holder: you, wanted_by: null }); // the link is not silent
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
  it('the question is dead while nothing reaches the application, and says so', async () => {
    const part = await shown<Consent>('flexrf-consent');
    say({ holder: you, wanted_by: other, answer_within_ms: 9900 });
    await settle();
    expect(button(part, /Keep/).disabled).toBe(false);
    await vi.advanceTimersByTimeAsync(1500); // not a word for so long
    expect(core.link.stale).toBe(true);
    expect([button(part, /Keep/).disabled, button(part, /Hand over/).disabled]).toEqual([true, true]);
    expect(part.shadowRoot?.textContent).toContain('no answer reaches the application');
    button(part, /Keep/).click();
    expect(socket.of('answer_control')).toHaveLength(0);
    say({ holder: you, wanted_by: other, answer_within_ms: 7000 });
    await settle();
    expect(button(part, /Keep/).disabled).toBe(false);
  });
  it('who asked and did not get it is told', async () => {
    const part = await shown<Control>('flexrf-control');
    say({ holder: other, wanted_by: you, answer_within_ms: 9000 });
    await settle();
    say({ holder: other, wanted_by: null });
    await settle();
    expect(noticed).toEqual(['You did not get control: anna at 10.0.0.2 keeps control.']);
    expect(part.shadowRoot?.querySelector('#why')?.textContent).toBe('anna at 10.0.0.2 keeps control');
    say({ holder: other, wanted_by: you, answer_within_ms: 9000 });
    say({ holder: you, wanted_by: null });
    await settle();
    expect(noticed).toHaveLength(1);
    expect(part.shadowRoot?.querySelector('#why')?.textContent).toBe('');
  });
  const arm = { component: 'arm', kind: 'device', cause: 'no answer on the bus', since_ns: 3e9 };
  const jog = { component: 'jog', kind: 'unit', cause: 'lost its way', since_ns: 5e9 };
  it('no faults are told in the place where faults would be', async () => {
    const part = await shown<Faults>('flexrf-faults');
    expect(part.shadowRoot?.querySelector('span')?.textContent).toBe('No faults');
    expect(part.shadowRoot?.querySelector('a')).toBeNull();
  });
  it('faults are told in every view: how many, the newest, since when, and where more is said', async () => {
    vi.setSystemTime(new Date(2026, 10, 23, 14, 32, 7));
    vi.spyOn(core.connection, 'serverNow').mockReturnValue(8e9);
    const part = await shown<Faults>('flexrf-faults');
    say({ holder: null, wanted_by: null }, undefined, [jog, arm]);
    await settle();
    const link = part.shadowRoot!.querySelector('a')!;
    expect(link.textContent?.replace(/\s+/g, ' ')).toBe('✕ 2 faults, newest since 14:32:04: jog: lost its way');
    expect(link.getAttribute('href')).toBe('#/units/jog');
    say({ holder: null, wanted_by: null }, undefined, [arm]);
    await settle();
    expect(part.shadowRoot!.querySelector('a')!.textContent).toContain('1 fault');
    await vi.advanceTimersByTimeAsync(1500);
    expect(part.shadowRoot!.querySelector('a')!.className).toBe('old');
  });
  it('the header says what is so, not what was', async () => {
    const part = await shown<Header>('flexrf-header');
    const text = () => part.shadowRoot!.textContent!;
    say({ holder: null, wanted_by: null });
    await settle();
    expect(text()).toContain('Motion enabled');
    say({ holder: null, wanted_by: null }, undefined, [], 'stopping');
    await settle();
    expect(text()).toContain('Motion is coming to rest');
    socket.say({ event: 'ended', text: 'signal' });
    await settle();
    expect(text()).toContain('Motion ended');
    socket.lose();
    await settle();
    expect(text()).toContain('Motion ended');
    expect(text()).not.toContain('Motion enabled');
  });
  it('nobody else is asked', async () => {
    const part = await shown<Consent>('flexrf-consent');
    say({ holder: other, wanted_by: you, answer_within_ms: 9900 });
    await settle();
    expect(part.shadowRoot?.querySelector('button')).toBeNull();
  });
});
