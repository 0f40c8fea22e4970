// @vitest-environment node
import { expect, it } from 'vitest';
import { data, failure, noUpdate, pc } from '../../core/tests/machine_sample';
import { ageOf, bootSentence, bytesText, chosenDrivers, confirmedSentence, dataParts, dataSentence, driversSentence, failedStartText, failureHeading, isNearlyFull, motionSentence, sentence, silentStartsSentence, slotSentence, updateSentence } from '../machine_words';

it('says why a slot runs', () => {
  const words = ['confirmed', 'only', 'trial', 'fallback', 'manual', 'unknown'] as const;
  const all = words.map((boot) => bootSentence({ ...pc, boot }));
  expect(new Set(all).size).toBe(words.length);
  expect(all.every((text) => text.startsWith('Slot A: '))).toBe(true);
  expect(bootSentence({ ...pc, boot: 'something' as 'only' })).toBe(bootSentence({ ...pc, boot: 'unknown' }));
});

it('says how far a version is with confirming itself', () => {
  expect(confirmedSentence(pc)).toMatch(/^Yes/);
  const trial = { ...pc, confirmed: false, healthy_for_s: 12 };
  expect(confirmedSentence(trial)).toBe('Not yet: healthy for 12 of 60 s.');
  expect(confirmedSentence({ ...trial, why_not_healthy: 'device arm is in fault' })).toBe(
    'Not yet: healthy for 12 of 60 s. It is not healthy now: device arm is in fault.');
});

it('says whether motion is permitted', () => {
  expect(motionSentence(pc)).toBe('Permitted by this PC.');
  expect(motionSentence({ ...pc, motion: 'it is being updated' })).toBe('Not permitted: it is being updated.');
});

it('says what a slot is', () => {
  expect(slotSentence(pc, 'A', pc.slots.A!)).toBe('runs, starts next');
  expect(slotSentence(pc, 'B', pc.slots.B!)).toBe('holds nothing that could start');
  expect(slotSentence(pc, 'B', { ...pc.slots.B!, version: '7', whole: true, primary: true })).toBe('starts next');
  expect(slotSentence(pc, 'B', { ...pc.slots.B!, version: '7', whole: true })).toBe('could start');
});

it('compares an update with what runs', () => {
  const update = { ...noUpdate, version: '9', application: 'pick-station' };
  expect(ageOf(pc, update)).toBe('newer');
  expect(ageOf(pc, { ...update, version: pc.version })).toBe('same');
  expect(ageOf(pc, { ...update, older: true })).toBe('older');
  expect(updateSentence({ ...pc, update })).toBe('pick-station 9: newer than what runs.');
  expect(updateSentence({ ...pc, update: { ...update, application: 'keyboard' } })).toContain('it would become another cell');
});

it('says which drivers a version changes, and which run', () => {
  const changes = [{ device: 'arm', from: 'canopen', to: 'simulated' }, { device: 'valve', from: '', to: 'gpio' }, { device: 'lamp', from: 'gpio', to: '' }];
  expect(driversSentence([])).toBe('');
  expect(driversSentence(changes)).toBe(
    'It changes drivers: arm from canopen to simulated; valve is new, with gpio; lamp had gpio, and has none that is known.');
  const update = { ...noUpdate, version: '9', application: 'pick-station', driver_changes: changes };
  expect(updateSentence({ ...pc, update })).toMatch(/^pick-station 9: newer than what runs\. ⚠ It changes drivers: arm /);
  expect(chosenDrivers({ x: 'canopen', camera: 'v4l2', z: 'canopen' })).toBe('canopen: x, z; v4l2: camera');
  expect(chosenDrivers({})).toBe('There are no devices.');
});

it('counts bytes', () => {
  expect([0, 999, 1000, 61_440, 999_600, 123_400_000, 2_500_000_000].map(bytesText)).toEqual(
    ['0 B', '999 B', '1.0 kB', '61 kB', '1.0 MB', '123 MB', '2.5 GB']);
});

it('says which start of a version failed, and what of the starts after it', () => {
  expect(failureHeading(failure)).toBe('Why version 20261201T1 in slot B failed');
  expect(failureHeading({ ...failure, version: '' })).toBe('Why the version in slot B failed');
  expect(failedStartText(failure)).toMatch(/^Start 3 of 3, begun \d{4}-/);
  expect(failedStartText({ ...failure, start: 1, began: 0 })).toBe('Start 1 of 3');
  expect(failedStartText({ ...failure, start: 0 })).toBe('3 starts');
  expect(failedStartText({ ...failure, start: 0, starts: 1 })).toBe('1 start');
  expect(failedStartText({ ...failure, start: 0, starts: 0 })).toBe('The boot loader could not start it');
  expect(silentStartsSentence(failure)).toBe('');
  expect(silentStartsSentence({ ...failure, start: 0 })).toBe('');
  expect(silentStartsSentence({ ...failure, start: 2 })).toMatch(/^Start 3 stopped before the services ran/);
  expect(silentStartsSentence({ ...failure, start: 1 })).toMatch(/^Starts 2 to 3 stopped/);
  expect([sentence('it failed'), sentence('Done.'), sentence('')]).toEqual(['It failed.', 'Done.', '']);
});

it('says what fills the partition for data, the largest part first', () => {
  expect(dataSentence(data)).toBe('180 MB of 250 MB used, 32 MB free for the application.');
  expect(dataParts(data).map(([name]) => name)).toEqual(['Updates', 'Logs of the PC', 'Audit', 'Other files', 'Configuration']);
  expect(dataParts({ ...data, updates: 0 }).map(([name]) => name)).not.toContain('Updates');
  expect(isNearlyFull(data)).toBe(false);
  expect(isNearlyFull({ ...data, free: 19e6 })).toBe(true);
  expect(isNearlyFull({ ...data, free: 20e6 })).toBe(false);
});
