import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Connection } from '../connection';
import { Holds } from '../holds';
import { FakeSocket } from './fake_socket';

let socket: FakeSocket;
let connection: Connection;
let holds: Holds;
let unguard: () => void;

beforeEach(() => {
  vi.useFakeTimers();
  socket = new FakeSocket();
  connection = new Connection({
    makeSocket: () => socket, onHello: () => undefined, onEvent: () => undefined, onFrame: () => undefined, onStatus: () => undefined,
  });
  connection.start();
  socket.hello();
  holds = new Holds(connection);
  unguard = holds.guard(window);
});
afterEach(() => {
  unguard();
  connection.stop();
  vi.useRealTimers();
});

function answer(op: string, fields: object): void {
  socket.say({ id: socket.of(op).at(-1)?.['id'], ...fields });
}
function begin(lease = 'l1'): ReturnType<Holds['begin']> {
  const hold = holds.begin('jog', 'forward');
  answer('hold', { ok: true, lease });
  return hold;
}

describe('a hold', () => {
  it('is refreshed every 100 ms and released once', async () => {
    const hold = await begin();
    expect(socket.of('hold')[0]).toMatchObject({ component: 'jog', parameter: 'forward' });
    vi.advanceTimersByTime(300);
    expect(socket.of('refresh')).toHaveLength(4); // one at once
    hold.release();
    hold.release();
    vi.advanceTimersByTime(500);
    expect(socket.of('refresh')).toHaveLength(4);
    expect(socket.of('release')).toMatchObject([{ lease: 'l1' }]);
    expect(await hold.over).toBe('released');
  });
  it('that is refused says why', async () => {
    const hold = holds.begin('jog', 'forward');
    answer('hold', { ok: false, problem: { title: 'Forbidden', detail: 'control is held by another' } });
    await expect(hold).rejects.toThrow('control is held by another');
  });
  it('ends when the server says that the lease is over', async () => {
    const hold = await begin();
    answer('refresh', { ok: false, problem: { title: 'Gone', detail: 'Motion is stopped.' } });
    expect(await hold.over).toBe('Motion is stopped.');
    vi.advanceTimersByTime(500);
    expect(socket.of('refresh')).toHaveLength(1);
    expect(socket.of('release')).toHaveLength(0);
  });
  it('ends with the link', async () => {
    const hold = await begin();
    socket.lose();
    expect(await hold.over).toMatch(/link/);
    expect(holds.alive).toBe(0);
  });
  it.each([
    ['blur', () => window.dispatchEvent(new Event('blur'))],
    ['pagehide', () => window.dispatchEvent(new Event('pagehide'))],
    ['pointercancel', () => document.body.dispatchEvent(new Event('pointercancel', { bubbles: true }))],
    ['freeze', () => document.dispatchEvent(new Event('freeze'))],
    ['hidden page', () => {
      const visibility = vi.spyOn(document, 'visibilityState', 'get').mockReturnValue('hidden');
      document.dispatchEvent(new Event('visibilitychange'));
      visibility.mockRestore();
    }],
  ])('ends on %s', async (_name, happen) => {
    const hold = await begin();
    happen();
    expect(socket.of('release')).toMatchObject([{ lease: 'l1' }]);
    expect(await hold.over).not.toBe('');
    vi.advanceTimersByTime(500);
    expect(socket.of('refresh')).toHaveLength(1);
  });
  it('stays while the page is seen', async () => {
    await begin();
    document.dispatchEvent(new Event('visibilitychange'));
    expect(holds.alive).toBe(1);
  });
  it('whose lease comes after its end was wanted is given back', async () => {
    const hold = holds.begin('jog', 'forward');
    window.dispatchEvent(new Event('blur'));
    answer('hold', { ok: true, lease: 'late' });
    await expect(hold).rejects.toThrow('focus');
    expect(socket.of('release')).toMatchObject([{ lease: 'late' }]);
    expect(socket.of('refresh')).toHaveLength(0);
  });
  it('is one of several that end together', async () => {
    const first = await begin('l1');
    const second = await begin('l2');
    holds.endAll('control was lost');
    expect(await Promise.all([first.over, second.over])).toEqual(['control was lost', 'control was lost']);
    expect(socket.of('release').map((message) => message['lease'])).toEqual(['l1', 'l2']);
  });
});
