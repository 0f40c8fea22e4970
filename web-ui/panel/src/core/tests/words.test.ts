import { describe, expect, it } from 'vitest';
import type { ApplicationState } from '../protocol';
import { addressOfFault, clockText, motionOf, newestFault, remedyOf, stopText, titleOf } from '../words';

describe('words', () => {
  it('say whether it may move only as long as that is known', () => {
    const link = { phase: 'open', stale: false } as const;
    const of = (mode: ApplicationState['mode'], motion = { stopped: false, may_move: true }, more: Partial<typeof link> | object = {}) =>
      motionOf({ link: { ...link, ...more }, state: { mode, motion } as ApplicationState });
    expect(of('running')).toBe('enabled');
    expect(of('running', { stopped: false, may_move: false })).toBe('inhibited');
    expect(of('finishing', { stopped: true, may_move: false })).toBe('stopped');
    expect([of('stopping'), of('safe'), of('ended')]).toEqual(['ending', 'ended', 'ended']);
    expect(of('running', undefined, { stale: true })).toBe('unknown');
    expect(of('running', undefined, { phase: 'waiting' })).toBe('unknown');
    expect(of('ended', undefined, { phase: 'waiting' })).toBe('ended');
  });
  it('name the newest fault, and where more is told of it', () => {
    const fault = (component: string, kind: 'unit' | 'device' | 'thread' | 'process', since_ns: number) => ({ component, kind, cause: 'x', since_ns });
    const [old, young] = [fault('arm', 'device', 5), fault('axis[0].drive', 'unit', 7)];
    expect(newestFault([])).toBeUndefined();
    expect(newestFault([old, young])).toBe(young);
    expect(newestFault([young, old])).toBe(young);
    expect([old, young, fault('motion', 'thread', 1), fault('cell', 'process', 1)].map(addressOfFault)).toEqual([
      '#/devices/arm', '#/units/axis%5B0%5D.drive', '#/threads/motion', '#/threads']);
  });
  it('tell the tab what is wrong', () => {
    const link = { phase: 'open', stale: false } as const;
    const state = { mode: 'running', faults: [] } as unknown as ApplicationState;
    const two = { ...state, faults: [{}, {}] } as unknown as ApplicationState;
    expect(titleOf('cell', { link, state })).toBe('cell – FlexRF panel');
    expect(titleOf('cell', { link, state: two })).toBe('✕ 2 faults · cell – FlexRF panel');
    expect(titleOf('cell', { link: { ...link, stale: true }, state: two })).toBe('⚠ No connection · cell – FlexRF panel');
    expect(titleOf('cell', { link: { ...link, phase: 'waiting' }, state: { ...state, mode: 'ended' } })).toBe('Ended · cell – FlexRF panel');
  });
  it('tell the time of day, and the day where it was another', () => {
    const now = new Date(2026, 10, 23, 15, 0, 0);
    expect(clockText(new Date(2026, 10, 23, 4, 5, 6), now)).toBe('04:05:06');
    expect(clockText(new Date(2026, 10, 22, 23, 59, 6), now)).toBe('2026-11-22 23:59:06');
  });
  it('give a remedy', () => {
    // Initialised it runs already; what is missing is Start motion.
    expect(remedyOf({ component: 'robot', kind: 'unit', cause: 'x' })).toMatch(/initialise robot on its page\. .*Start motion\.$/);
    expect(remedyOf({ component: 'robot', kind: 'unit', cause: 'x' })).not.toContain('start it');
  });
});

it('says who stopped, and when', () => {
  const at = new Date(2026, 10, 23, 15, 4, 5);
  const state = (motion: object): Parameters<typeof stopText>[0] => ({ motion }) as Parameters<typeof stopText>[0];
  const stopped = state({ stopped: true, may_move: false, stopped_by: { who: 'anna (10.0.0.2)', at_ms: at.getTime() } });
  expect(stopText(stopped, at)).toBe('by anna (10.0.0.2) at 15:04:05');
  expect(stopText(stopped, new Date(2026, 10, 24))).toBe('by anna (10.0.0.2) at 2026-11-23 15:04:05');
  expect(stopText(state({ stopped: true, may_move: false, stopped_by: null }), at)).toBe('');
  expect(stopText(state({ stopped: false, may_move: true, stopped_by: { who: 'anna', at_ms: 1 } }), at)).toBe('');
});
