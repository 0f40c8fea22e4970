// What somebody may do to a running application by its panel, and what must not come of it: no crash, no growth, no word
// from the cell's threads, and others go on being served. What one connection or one parser can be told is tested beside
// the server's own sources.
import { connect, type Socket } from 'node:net';
import { afterEach, beforeEach, describe, expect, it, onTestFinished } from 'vitest';
import { Application, RawSocket, familyOf, frameOf, residentMemory, within, type Rest, type User } from './harness';

const anna: User = { name: 'anna', role: 'engineer', password: 'a long password of anna' };

let running: Application;
const left: (RawSocket | Socket)[] = [];

afterEach(async () => {
  left.splice(0).forEach((one) => (one instanceof RawSocket ? one.end() : one.destroy()));
  await running.end(); // it lives, and without a fault
});

/** The cell's own work goes on, and its real-time threads allocated nothing. */
async function expectUnmoved(rest: Rest): Promise<void> {
  const threads = (await rest.do('threads')).body as { name: string; cycles: number; allocations: number }[];
  const motion = threads.find((one) => one.name === 'motion')!;
  expect(motion.allocations).toBe(0);
  await expect.poll(async () => {
    const now = ((await rest.do('threads')).body as typeof threads).find((one) => one.name === 'motion')!;
    return now.cycles - motion.cycles;
  }, { timeout: within }).toBeGreaterThan(10);
}

describe('passwords', () => {
  beforeEach(async () => { running = await Application.start('panel_cell', { users: [anna] }); });

  it('1000 wrong ones are refused, and the right one still opens', async () => {
    const rest = running.rest();
    const answers = new Map<number, number>();
    const began = Date.now();
    for (let group = 0; group < 50; group += 1) {
      const statuses = await Promise.all(Array.from({ length: 20 }, async (_, i) =>
        (await rest.ask('login', { body: { user: i % 2 ? 'anna' : 'nobody', password: `wrong ${group} ${i}` } })).status));
      for (const status of statuses) answers.set(status, (answers.get(status) ?? 0) + 1);
    }
    expect([...answers.values()].reduce((sum, count) => sum + count)).toBe(1000);
    for (const status of answers.keys()) expect([403, 429, 503]).toContain(status);
    // Most were not even tried: hashing is what costs. Soon it is one in two seconds, however long this takes.
    expect(answers.get(403) ?? 0).toBeLessThan(20 + (Date.now() - began) / 1000);
    await expect.poll(async () => (await rest.ask('login', { body: { user: anna.name, password: anna.password } })).status,
      { timeout: within, interval: 500 }).toBeLessThan(300);
    await expectUnmoved(rest);
    // No helper process is left behind.
    await expect.poll(() => familyOf(running.id).length, { timeout: within }).toBe(1);
  });
});

describe('a server that somebody wishes ill', () => {
  let rest: Rest;
  beforeEach(async () => {
    running = await Application.start('panel_cell');
    rest = running.rest();
    await rest.do('session');
  });

  it('a million messages of one client: it is shut out, others are served', async () => {
    const flood = await RawSocket.connect(rest);
    left.push(flood);
    const other = await RawSocket.connect(rest);
    left.push(other);
    const many = Buffer.concat(Array.from({ length: 1000 }, (_, id) => frameOf(JSON.stringify({ op: 'ping', id: id + 1, sent: 0 }))));
    const before = residentMemory(running.id);
    // Who says nothing for a second is shut out, too.
    const alive = setInterval(() => other.closed || other.send({ op: 'ping', id: 1, sent: 0 }), 250);
    onTestFinished(() => clearInterval(alive));
    let sent = 0;
    while (sent < 1_000_000 && !flood.closed) {
      if (!flood.socket.write(many)) await new Promise((resolve) => { flood.socket.once('drain', resolve); flood.socket.once('close', resolve); });
      sent += 1000;
      if (sent % 50_000 === 0) expect((await rest.ask('state')).status).toBe(200);
    }
    expect(residentMemory(running.id) - before).toBeLessThan(4 << 20);
    other.send({ op: 'ping', id: 7, sent: 7 });
    await expect.poll(() => other.texts.some((one) => one['id'] === 7 && one['ok'] === true), { timeout: within }).toBe(true);
    await expectUnmoved(rest);
  });

  it('a socket that never reads: nobody else waits, nothing grows', async () => {
    const deaf = await RawSocket.connect(rest);
    const other = await RawSocket.connect(rest);
    left.push(deaf, other);
    const subscription = {
      op: 'subscribe', id: 1, topics: [],
      slots: [{ name: 'picture', rate: 60, width: 160 }, { name: 'sample', rate: 60 }, { name: 'place', rate: 60 }],
    };
    deaf.send(subscription);
    other.send(subscription);
    deaf.socket.pause();
    const before = residentMemory(running.id);
    let alive: ReturnType<typeof setInterval> | undefined;
    try {
      alive = setInterval(() => {
        for (const one of [deaf, other]) if (!one.closed) one.send({ op: 'ping', id: 2, sent: 0 });
      }, 250);
      await expect.poll(() => other.values, { timeout: within }).toBeGreaterThan(150);
    } finally {
      clearInterval(alive);
    }
    expect(residentMemory(running.id) - before).toBeLessThan(4 << 20);
    await expectUnmoved(rest);
  });

  it('slow headers and half-open connections are ended', async () => {
    const slow = Array.from({ length: 8 }, () => connect(running.port, '127.0.0.1'));
    left.push(...slow);
    let ended = 0;
    for (const one of slow) {
      one.on('error', () => undefined);
      one.on('data', () => undefined);
      one.on('close', () => { ended += 1; });
      one.write('GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n');
    }
    const drip = setInterval(() => slow.forEach((one) => one.destroyed || one.write('X')), 500);
    try {
      expect((await rest.ask('state')).status).toBe(200);
      await expect.poll(() => ended, { timeout: within }).toBe(slow.length);
    } finally {
      clearInterval(drip);
    }
    await expectUnmoved(rest);
  });

  it('more clients than places: 503 with Retry-After, and room again afterwards', async () => {
    const clients: RawSocket[] = [];
    let refused: RawSocket | undefined;
    // Who is silent makes room, and does not count.
    const alive = setInterval(() => clients.forEach((one) => one.send({ op: 'ping', id: 1 })), 300);
    try {
      for (let number = 0; number < 64 && !refused; number += 1) {
        const one = await RawSocket.connect(rest);
        left.push(one);
        if (one.refusal || one.closed) refused = one;
        else clients.push(one);
      }
    } finally {
      clearInterval(alive);
    }
    expect(refused?.refusal).toMatch(/^HTTP\/1\.1 503/);
    expect(refused?.refusal).toMatch(/Retry-After: \d+/i);
    expect(clients.length).toBeGreaterThan(3);
    clients.forEach((one) => one.end());
    await expect.poll(async () => (await rest.ask('state').catch(() => undefined))?.status, { timeout: within }).toBe(200);
  });

  it('a foreign Host, a foreign Origin, a foreign page\'s socket', async () => {
    expect((await rest.ask('state', { headers: { host: 'evil.example' } })).status).toBe(421);
    expect((await rest.ask('stop-motion', { method: 'POST', headers: { origin: 'http://evil.example' } })).status).toBe(403);
    const foreign = await RawSocket.connect(rest, { Origin: 'http://evil.example' });
    left.push(foreign);
    expect(foreign.refusal).toMatch(/^HTTP\/1\.1 403/);
  });

  it('messages that make no sense end their connection, and nothing else', async () => {
    const senseless: readonly (readonly [string, Buffer])[] = [
      ['no JSON', frameOf('{"op":')],
      ['no object', frameOf('[1, 2]')],
      ['no text', frameOf(Buffer.from([0xff, 0xfe, 0xfd]))],
      ['binary', frameOf(Buffer.alloc(16), 2)],
      ['too long', frameOf(`{"op":"ping","id":1,"x":"${'x'.repeat(20_000)}"}`)],
      ['too deep', frameOf(`{"op":"ping","id":1,"x":${'['.repeat(5000)}${']'.repeat(5000)}}`)],
    ];
    for (const [what, bytes] of senseless) {
      const one = await RawSocket.connect(rest);
      left.push(one);
      one.socket.write(bytes);
      await expect.poll(() => one.closed || one.closeCode !== undefined, { timeout: within, message: what }).toBe(true);
    }
    await expectUnmoved(rest);
  });

  it('what does not exist, and what is of the wrong kind', async () => {
    const asked: readonly (readonly [string, string, unknown, number])[] = [
      ['GET', 'components/nobody', undefined, 404],
      ['GET', 'slots/nothing', undefined, 404],
      ['GET', 'nothing', undefined, 404],
      ['DELETE', 'state', undefined, 405],
      ['GET', 'slots/sample/image', undefined, 404],
    ];
    for (const [method, path, body, status] of asked) {
      const answer = await rest.ask(path, { method, ...(body !== undefined && { body }) });
      expect([answer.status, path]).toEqual([status, path]);
      expect(answer.headers['content-type'], path).toContain('application/problem+json');
    }
    const admin = new Address(running.address);
    const own = await admin.session();
    await own.do('control/take', { method: 'POST' });
    const before = await own.runtime('gadget');
    const values: readonly unknown[] = [
      { level: 'five' }, { level: null }, { level: [5] }, { level: 1e999 }, { nothing: 1 }, { count: 2.5 }, { count: 1e12 }, { tint: 'pink' },
      { tint: 1 }, { enabled: 1 }, { gains: [1, 2] }, { 'gains[9]': 0 }, { level: 2, count: 'x' }, { title: 'x'.repeat(100) }, [], 'x', 7,
    ];
    for (const value of values) {
      const answer = await own.ask('components/gadget/parameters', { method: 'PUT', body: value });
      expect([answer.status >= 400 && answer.status < 500, JSON.stringify(value)]).toEqual([true, JSON.stringify(value)]);
    }
    expect(await own.runtime('gadget')).toEqual(before);
    // Stale: changed since it was read.
    const read = await own.do('components/gadget/parameters');
    await own.do('components/gadget/parameters', { method: 'PUT', body: { level: 6 }, headers: { 'if-match': read.headers.etag! } });
    const stale = await own.ask('components/gadget/parameters', { method: 'PUT', body: { level: 7 }, headers: { 'if-match': read.headers.etag! } });
    expect(stale.status).toBe(412);
    expect((await own.runtime('gadget'))['level']).toBe(6);
  });
});

/** The printed address, used by a script. */
class Address {
  constructor(private readonly address: string) {}

  async session(): Promise<Rest> {
    const rest = running.rest();
    const { pathname, search } = new URL(this.address);
    await rest.ask(`${pathname}${search}`);
    return rest;
  }
}
