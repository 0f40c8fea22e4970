import { describe, expect, it } from 'vitest';
import { actOf, filterEntries, timeOf, type AuditEntry } from '../audit_entries';

const change: AuditEntry = {
  number: 1, at: '2026-11-23T14:40:28.125Z', who: 'ann (192.168.0.7)', did: 'changed', what: 'jog.step', before: 0.01, after: 0.02,
};
const press: AuditEntry = { number: 2, at: '2026-11-23T14:41:00.000Z', who: 'bob (127.0.0.1)', did: 'pressed', what: 'mixer.kick', count: 3 };

describe('entries of the audit', () => {
  it('say what was before and what is after', () => {
    expect(actOf(change)).toBe('changed jog.step: 0.01 → 0.02');
    expect(actOf({ ...change, before: 'slow', after: null })).toBe('changed jog.step: slow → null');
    expect(actOf(press)).toBe('pressed mixer.kick (3 times)');
    expect(actOf({ number: 3, at: '', who: 'ann', did: 'logged in' })).toBe('logged in');
  });
  it('bear the time of the person who reads them', () => {
    expect(timeOf(change.at)).toMatch(/^2026-11-2[234] \d\d:40:28$/);
    expect(timeOf('yesterday')).toBe('yesterday');
  });
  it('are found by words in any order', () => {
    expect(filterEntries([change, press], 'STEP ann')).toEqual([change]);
    expect(filterEntries([change, press], ' ')).toEqual([change, press]);
    expect(filterEntries([change, press], 'ann kick')).toEqual([]);
  });
});
