import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Connection } from '../connection';
import { FakeSocket } from './fake_socket';
import { frameOf } from './sample';

let sockets: FakeSocket[] = [];
const onHello = vi.fn();
const onEvent = vi.fn();
const onFrame = vi.fn();
let explanation = '';

function connect(now?: () => number, onStatus: () => void = () => undefined): Connection {
  const connection = new Connection({
    makeSocket: () => {
      const socket = new FakeSocket();
      sockets.push(socket);
      return socket;
    },
    random: () => 0.5,
    ...(now && { now }),
    onHello, onEvent, onFrame,
    onStatus,
    explain: () => Promise.resolve(explanation),
  });
  connection.start();
  return connection;
}
const newest = (): FakeSocket => {
  const socket = sockets.at(-1);
  if (!socket) throw new Error('no socket');
  return socket;
};

beforeEach(() => {
  vi.useFakeTimers();
  sockets = [];
  explanation = '';
  [onHello, onEvent, onFrame].forEach((mock) => mock.mockClear());
});
afterEach(() => vi.useRealTimers());

describe('a connection', () => {
  it('is open with the first hello', () => {
    const connection = connect();
    expect(connection.status).toMatchObject({ phase: 'connecting', stale: true });
    newest().hello();
    expect(connection.status).toMatchObject({ phase: 'open', stale: false, detail: '' });
    expect(onHello).toHaveBeenCalledOnce();
    expect(connection.serverNow()).toBeGreaterThanOrEqual(5_000_000_000);
  });
  it('gives each request the answer with its number', async () => {
    const connection = connect();
    newest().hello();
    const first = connection.request<{ sequence: number }>('set', { component: 'jog' });
    const second = connection.request('press');
    const [set] = newest().of('set');
    const [press] = newest().of('press');
    newest().say({ id: press?.['id'], ok: false, problem: { title: 'No' } });
    newest().say({ id: set?.['id'], ok: true, sequence: 4 });
    expect(await first).toMatchObject({ ok: true, sequence: 4 });
    expect(await second).toMatchObject({ ok: false, problem: { title: 'No' } });
  });
  it('tells who asks without a link, and who waits when it is lost', async () => {
    const connection = connect();
    expect(await connection.request('press')).toMatchObject({ ok: false, problem: { title: 'No connection' } });
    newest().hello();
    const waiting = connection.request('press');
    newest().lose();
    expect(await waiting).toMatchObject({ ok: false, problem: { title: 'No connection' } });
  });
  it('does not wait for an answer for ever', async () => {
    const connection = connect();
    newest().hello();
    const waiting = connection.request('press', {}, 300);
    vi.advanceTimersByTime(301);
    expect(await waiting).toMatchObject({ ok: false, problem: { title: 'No answer' } });
  });
  it('pings four times a second and knows the round trip', () => {
    const connection = connect();
    newest().hello();
    vi.advanceTimersByTime(1000);
    const pings = newest().of('ping');
    expect(pings.length).toBeGreaterThanOrEqual(3);
    vi.advanceTimersByTime(2);
    newest().say({ id: pings.at(-1)?.['id'], ok: true, sent: pings.at(-1)?.['sent'], server_time_ns: 1 });
    expect(connection.status.roundTrip).toBeGreaterThan(0);
  });
  it('pings on what it hears, for a hidden page has slow timers', () => {
    let clock = 1000;
    connect(() => clock);
    newest().hello();
    const before = newest().of('ping').length;
    clock += 260;
    newest().say(frameOf([]));
    expect(newest().of('ping')).toHaveLength(before + 1);
  });
});

describe('silence', () => {
  it('makes values old after a second, and any word makes them fresh', () => {
    const connection = connect();
    newest().hello();
    vi.advanceTimersByTime(1000);
    expect(connection.status.stale).toBe(false);
    vi.advanceTimersByTime(100);
    expect(connection.status).toMatchObject({ stale: true, phase: 'open' });
    newest().say(frameOf([]));
    expect(connection.status.stale).toBe(false);
    expect(onFrame).toHaveBeenCalledOnce();
  });
  it('of long is a lost link', () => {
    const connection = connect();
    newest().hello();
    const silent = newest();
    vi.advanceTimersByTime(4200);
    expect(silent.readyState).toBe(3);
    expect(connection.status.phase).toBe('waiting');
    vi.advanceTimersByTime(300);
    expect(sockets).toHaveLength(2);
  });
  it('is not judged by a page that did nothing itself, before it has heard what waited', () => {
    let away = 0;
    const connection = connect(() => performance.now() + away);
    newest().hello();
    vi.advanceTimersByTime(200);
    away = 10_000;
    vi.advanceTimersByTime(100);
    expect(connection.status).toMatchObject({ stale: true, phase: 'open' });
    newest().say(frameOf([]));
    vi.advanceTimersByTime(100);
    expect(connection.status).toMatchObject({ stale: false, phase: 'open' });
    expect(sockets).toHaveLength(1);
    away = 20_000; // and nothing waited
    vi.advanceTimersByTime(200);
    expect(connection.status.phase).toBe('waiting');
  });
});

describe('coming back', () => {
  it('takes longer each time, and 2 s at most', () => {
    connect();
    const waits = [250, 500, 1000, 2000, 2000];
    for (const [index, wait] of waits.entries()) {
      newest().lose();
      vi.advanceTimersByTime(wait - 1);
      expect(sockets).toHaveLength(index + 1);
      vi.advanceTimersByTime(1);
      expect(sockets).toHaveLength(index + 2);
    }
    newest().hello();
    newest().lose();
    vi.advanceTimersByTime(250);
    expect(sockets).toHaveLength(waits.length + 2);
  });
  it('says why it was refused', async () => {
    explanation = 'login';
    const connection = connect();
    newest().lose();
    await vi.advanceTimersByTimeAsync(0);
    expect(connection.status.detail).toBe('login');
  });
  it('keeps what was explained through the next tries, until it is explained anew', async () => {
    explanation = 'login';
    const details: string[] = [];
    let connection: Connection | undefined;
    const note = (): void => { details.push(connection?.status.detail ?? ''); };
    connection = connect(undefined, note);
    for (let tries = 0; tries < 3; tries += 1) {
      newest().lose();
      await vi.advanceTimersByTimeAsync(2000);
    }
    expect(new Set(details.slice(details.indexOf('login')))).toEqual(new Set(['login']));
    explanation = ''; // let in by now
    newest().lose();
    await vi.advanceTimersByTimeAsync(0);
    expect(connection.status.detail).toBe('');
  });
  it('is ended by stop()', () => {
    const connection = connect();
    newest().hello();
    connection.stop();
    vi.advanceTimersByTime(10_000);
    expect(sockets).toHaveLength(1);
  });
  it('happens at once with restart(), and the old socket is not heard any more', () => {
    const connection = connect();
    newest().hello();
    const old = newest();
    connection.restart();
    expect(sockets).toHaveLength(2);
    old.hello();
    expect(connection.status.phase).toBe('connecting');
  });
  it('gives up a server that never says hello', () => {
    connect();
    vi.advanceTimersByTime(5400);
    expect(sockets).toHaveLength(2);
  });
});

describe('what it does not understand', () => {
  it.each(['{', '{"event":"hello","protocol":2}'])('ends the connection: %s', (text) => {
    const connection = connect();
    newest().readyState = 1;
    newest().say(text);
    expect(connection.status.phase).toBe('waiting');
  });
  it('ends the connection: a frame that was cut', () => {
    const connection = connect();
    newest().hello();
    newest().say(frameOf([]).slice(0, 20));
    expect(connection.status.phase).toBe('waiting');
    expect(onFrame).not.toHaveBeenCalled();
  });
  it('is passed over: answers nobody waits for, and what is no object', () => {
    const connection = connect();
    newest().hello();
    newest().say({ id: 999, ok: true });
    newest().say('null');
    newest().say('3');
    expect(connection.status.phase).toBe('open');
  });
});
