import { expect, it } from 'vitest';
import { noUpdate, pc } from '../../core/tests/machine_sample';
import { lastingLines } from '../machine_lines';

it('says in every view what lasts', () => {
  expect(lastingLines(undefined)).toEqual([]);
  expect(lastingLines(pc)).toEqual([]);
  expect(lastingLines({ ...pc, development_key: true, confirmed: false, healthy_for_s: 12 })).toEqual([
    'Signed with the development key: anyone can make an update for this PC',
    'Version 20261128T001500Z-4fb48992 has not confirmed itself: healthy for 12 of 60 s',
  ]);
  expect(lastingLines({ ...pc, network_trial: { interface: 'enp0s2', remaining_s: 87 } })).toEqual([
    'The address of enp0s2 is on trial: it is taken back in 87 s',
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
