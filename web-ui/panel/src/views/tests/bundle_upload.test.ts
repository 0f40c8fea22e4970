// @vitest-environment node
import { beforeEach, expect, it } from 'vitest';
import type { Fetched } from '../../core/http';
import { BundleUpload, partSize, pauses } from '../bundle_upload';

type Put = Fetched<{ readonly received: number }>;

/** A PC that takes bytes as they come, unless the test says otherwise. */
let stored: number[];
let paused: number[];
let answers: ((offset: number) => Put | undefined)[];
let upload: BundleUpload;

const file = new Blob([new Uint8Array(3 * partSize + 100).map((_, index) => (index * 7) % 251)]);
const refused = (status: number, received?: number): Put => ({
  ok: false, status, detail: `refused ${status}`, problem: { title: 'No', ...(received !== undefined && { received }) },
});

beforeEach(() => {
  [stored, paused, answers] = [[], [], []];
  upload = new BundleUpload({
    put: async (token, offset, bytes) => {
      expect(token).toBe('t');
      const other = answers.shift()?.(offset);
      if (other) return other;
      if (offset !== stored.length) return refused(409, stored.length);
      stored.push(...new Uint8Array(await bytes.arrayBuffer()));
      return { ok: true, body: { received: stored.length } };
    },
    pause: (ms) => {
      paused.push(ms);
      return Promise.resolve();
    },
    changed: () => undefined,
  });
});

async function isComplete(): Promise<void> {
  expect(upload.state).toEqual({ step: 'sent', size: file.size });
  const sent = new Uint8Array(await file.arrayBuffer());
  expect(stored.length === sent.length && stored.every((byte, index) => byte === sent[index])).toBe(true);
}

it('sends a file in parts', async () => {
  await upload.begin(file, 't');
  await isComplete();
  expect(paused).toEqual([]);
});

it('sends again what did not arrive', async () => {
  answers = [() => undefined, () => refused(0), () => refused(503), () => refused(429)];
  await upload.begin(file, 't');
  await isComplete();
  expect(paused).toEqual([1000, 2000, 4000]);
});

it('goes on where the PC says, if an answer was lost', async () => {
  answers = [(offset) => {
    expect(offset).toBe(0);
    stored.push(...Array.from({ length: partSize }, (_, index) => (index * 7) % 251)); // it arrived, and the answer did not
    return refused(0);
  }];
  await upload.begin(file, 't');
  await isComplete();
  expect(paused).toEqual([1000]);
});

it('goes back where the PC says that it has less', async () => {
  answers = [() => undefined, () => {
    stored.length = 10;
    return refused(409, 10);
  }];
  await upload.begin(file, 't');
  await isComplete();
});

it('gives up after several attempts in a row, and goes on when it is told to', async () => {
  answers = Array.from({ length: 2 + pauses.length }, (_, index) => () => (index === 0 ? undefined : refused(0)));
  await upload.begin(file, 't');
  expect(upload.state).toEqual({ step: 'failed', sent: partSize, size: file.size, why: 'refused 0', resumable: true });
  expect(paused).toEqual(pauses);
  await upload.resume();
  await isComplete();
});

it('does not go round for ever with a PC that does not count', async () => {
  answers = Array.from({ length: 100 }, () => () => ({ ok: true, body: { received: 0 } }));
  await upload.begin(file, 't');
  expect(upload.state).toMatchObject({ step: 'failed', resumable: true, why: 'The PC does not count what it gets.' });
});

it('ends at once where it makes no sense to go on', async () => {
  for (const status of [400, 404, 409, 413, 507]) {
    stored = [];
    answers = [() => refused(status)];
    await upload.begin(file, 't');
    expect(upload.state).toEqual({ step: 'failed', sent: 0, size: file.size, why: `refused ${status}`, resumable: false });
  }
  await upload.resume();
  expect(upload.state.step).toBe('failed');
  // Who logs in again goes on.
  answers = [() => refused(403)];
  await upload.begin(file, 't');
  expect(upload.state).toMatchObject({ step: 'failed', resumable: true });
  await upload.resume();
  await isComplete();
});

it('can be given up', async () => {
  answers = [() => {
    upload.cancel();
    return undefined;
  }];
  await upload.begin(file, 't');
  expect(upload.state).toEqual({ step: 'none' });
  expect(stored.length).toBe(partSize);
});
