import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { MachineWatch, trialOf } from '../machine';
import { FakeCore } from './fake_core';
import { sample } from './sample';
import { noTrial, noUpdate, pc } from './machine_sample';

let asked = 0;
let answer: () => Promise<Response>;
let changes = 0;
let core: FakeCore;

function begin(phase: 'open' | 'waiting' = 'open', hasMachine = true): MachineWatch {
  core = new FakeCore(sample);
  core.hasMachine = hasMachine;
  core.link = { ...core.link, phase };
  const watch = MachineWatch.of(core.core);
  watch.watch(() => { changes += 1; });
  return watch;
}

const says = (body: object, status = 200): Promise<Response> => Promise.resolve(new Response(JSON.stringify(body), { status }));

beforeEach(() => {
  vi.useFakeTimers();
  [asked, changes, answer] = [0, 0, () => says(pc)];
  vi.stubGlobal('fetch', (path: string) => {
    expect(path).toBe('/api/v1/machine');
    asked += 1;
    return answer();
  });
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it('asks nobody where there is no PC', async () => {
  const watch = begin('open', false);
  await vi.advanceTimersByTimeAsync(20_000);
  await watch.refresh();
  expect(asked).toBe(0);
});

it('asks now and then, and more often while somebody looks or something is under way', async () => {
  const watch = begin();
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

it('asks often while an address is on trial', async () => {
  const watch = begin();
  const trial = { interface: 'enp0s2', remaining_s: 87 };
  answer = () => says({ ...pc, network_trial: trial });
  await vi.advanceTimersByTimeAsync(6_000);
  const before = asked;
  await vi.advanceTimersByTimeAsync(3_000);
  expect(asked - before).toBe(3);
  expect(trialOf(watch.state)).toEqual(trial);
});

it('an older helper says nothing of a trial', () => {
  const { network, network_trial, ...older } = pc;
  expect(trialOf(older)).toBeUndefined();
  expect(trialOf({ ...older, network_trial: noTrial })).toBeUndefined();
  expect(trialOf(undefined)).toBeUndefined();
});

it('tells only what is another than before', async () => {
  begin();
  await vi.advanceTimersByTimeAsync(30_000);
  expect(changes).toBe(1);
});

it('keeps what it knew while nobody answers, and says why', async () => {
  const watch = begin();
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
  begin('waiting');
  await vi.advanceTimersByTimeAsync(11_000);
  expect(asked).toBe(0);
  core.link = { ...core.link, phase: 'open' };
  core.says({});
  await vi.advanceTimersByTimeAsync(10);
  expect(asked).toBe(1);
  core.link = { ...core.link, phase: 'waiting' };
  core.says({});
  await vi.advanceTimersByTimeAsync(11_000);
  expect(asked).toBe(1);
  core.link = { ...core.link, phase: 'open' };
  core.says({});
  await vi.advanceTimersByTimeAsync(6_000);
  expect(asked).toBe(3);
});

it('asks anew for what was done while an answer is under way', async () => {
  let open: (response: Response) => void = () => undefined;
  answer = () => new Promise((resolve) => { open = resolve; });
  const watch = begin();
  const refreshed = [watch.refresh(), watch.refresh()];
  await vi.advanceTimersByTimeAsync(10);
  expect(asked).toBe(1);
  answer = () => says({ ...pc, version: 'newer' });
  open(await says(pc));
  await Promise.all(refreshed);
  expect(asked).toBe(2);
  expect(watch.state?.version).toBe('newer');
});
