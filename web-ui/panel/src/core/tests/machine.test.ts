// @vitest-environment node
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { MachineWatch, lastingLines } from '../machine';
import { noUpdate, pc } from './machine_sample';

let asked = 0;
let answer: () => Promise<Response>;
let linked = true;
let changes = 0;
let watch: MachineWatch;

const says = (body: object, status = 200): Promise<Response> => Promise.resolve(new Response(JSON.stringify(body), { status }));

beforeEach(() => {
  vi.useFakeTimers();
  [asked, changes, linked, answer] = [0, 0, true, () => says(pc)];
  vi.stubGlobal('fetch', (path: string) => {
    expect(path).toBe('/api/v1/machine');
    asked += 1;
    return answer();
  });
  watch = new MachineWatch({ isLinked: () => linked, changed: () => { changes += 1; } });
});
afterEach(() => {
  watch.end();
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it('asks nobody where there is no PC', async () => {
  watch.begin(false);
  await vi.advanceTimersByTimeAsync(20_000);
  await watch.refresh();
  expect(asked).toBe(0);
  expect(watch.isThere).toBe(false);
});

it('asks now and then, and more often while somebody looks or something is under way', async () => {
  watch.begin(true);
  await vi.advanceTimersByTimeAsync(9_000);
  expect(asked).toBe(2);
  expect(watch.state).toEqual(pc);
  const end = watch.look();
  await vi.advanceTimersByTimeAsync(3_500);
  expect(asked).toBe(6);
  end();
  answer = () => says({ ...pc, update: { ...noUpdate, phase: 'installing' } });
  await vi.advanceTimersByTimeAsync(6_000);
  const before = asked;
  await vi.advanceTimersByTimeAsync(3_000);
  expect(asked - before).toBe(3);
});

it('tells only what is another than before', async () => {
  watch.begin(true);
  await vi.advanceTimersByTimeAsync(30_000);
  expect(changes).toBe(1);
});

it('keeps what it knew while nobody answers, and says why', async () => {
  watch.begin(true);
  await vi.advanceTimersByTimeAsync(100);
  answer = () => says({ title: 'Service Unavailable', detail: 'The PC’s helper is not there.' }, 503);
  await vi.advanceTimersByTimeAsync(5_000);
  expect(watch.state).toEqual(pc);
  expect(watch.trouble).toBe('The PC’s helper is not there.');
  answer = () => says(pc);
  await vi.advanceTimersByTimeAsync(5_000);
  expect(watch.trouble).toBe('');
});

it('asks nobody while the link is lost, and goes on by itself', async () => {
  linked = false;
  watch.begin(true);
  await vi.advanceTimersByTimeAsync(11_000);
  expect(asked).toBe(0);
  linked = true;
  await vi.advanceTimersByTimeAsync(5_000);
  expect(asked).toBe(1);
});

it('asks anew for what was done while an answer is under way', async () => {
  let open: (response: Response) => void = () => undefined;
  answer = () => new Promise((resolve) => { open = resolve; });
  watch.begin(true);
  const refreshed = [watch.refresh(), watch.refresh()];
  await vi.advanceTimersByTimeAsync(10);
  expect(asked).toBe(1);
  answer = () => says({ ...pc, version: 'newer' });
  open(await says(pc));
  await Promise.all(refreshed);
  expect(asked).toBe(2);
  expect(watch.state?.version).toBe('newer');
});

it('says in every view what lasts', () => {
  expect(lastingLines(undefined)).toEqual([]);
  expect(lastingLines(pc)).toEqual([]);
  expect(lastingLines({ ...pc, development_key: true, confirmed: false, healthy_for_s: 12 })).toEqual([
    'Signed with the development key: anyone can make an update for this PC',
    'Version 20261128T001500Z-4fb48992 has not confirmed itself: healthy for 12 of 60 s',
  ]);
  const update = { ...noUpdate, version: '7', percent: 30, received: 5, size: 50 };
  const line = (phase: typeof update.phase) => lastingLines({ ...pc, update: { ...update, phase } });
  expect(line('receiving')).toEqual(['An update is being uploaded: 10 %']);
  expect(line('verifying')).toEqual(['An update is being verified']);
  expect(line('verified')).toEqual([]);
  expect(line('installing')).toEqual(['Version 7 is being installed: 30 %. Nothing may move meanwhile']);
  expect(line('installed')).toEqual(['Version 7 is installed: it starts with the next restart']);
  expect(line('failed')).toEqual([]);
});
