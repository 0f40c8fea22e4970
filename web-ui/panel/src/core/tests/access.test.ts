// @vitest-environment node
import { describe, expect, it } from 'vitest';
import type { Role } from '../../contract';
import { deniedAction, deniedControl, includes, locked, type Situation } from '../access';
import { makeModel } from '../descriptor';
import type { ControlSession } from '../protocol';
import { sample } from './sample';

const model = makeModel(sample);
const other: ControlSession = { name: 'panel-2', user: 'anna', address: '10.0.0.2', local: false, you: false };
const you: ControlSession = { ...other, name: 'panel-1', user: '', you: true };

function situation(role: Role, holder: ControlSession | null = you, more: Partial<Situation> = {}, wanted: ControlSession | null = null): Situation {
  return {
    link: { phase: 'open', stale: false },
    session: { name: 'panel-1', role, local: false, user: '' },
    state: {
      mode: 'running', cause: '', motion: { stopped: false, may_move: true }, faults: [],
      values: { file: false, on: 'change', unsaved: false, saved_at_ms: null, writings: 0, failure: '' },
      control: { holder, wanted_by: wanted }, edit: null, server: { connections: 1, places: 8, loop_delay_us: { p99: 1, max: 2 } },
    },
    ...more,
  };
}

describe('roles', () => {
  it('include those before them', () => {
    expect(includes('admin', 'operator')).toBe(true);
    expect(includes('operator', 'operator')).toBe(true);
    expect(includes('operator', 'engineer')).toBe(false);
  });
});

describe('locked', () => {
  const of = (key: string, where: Situation): string => locked(where, model.item(key));
  it('is empty for who has role and control', () => expect(of('jog.step', situation('operator'))).toBe(''));
  it('says that the link is lost, before everything else that could be said', () => {
    expect(of('jog.step', situation('viewer', null, { link: { phase: 'waiting', stale: true } }))).toBe('link lost');
    expect(of('jog.step', situation('operator', you, { link: { phase: 'open', stale: true } }))).toBe('values are old');
  });
  it('names the role', () => expect(of('jog.gains', situation('operator'))).toBe('needs engineer'));
  it('names who has control', () => {
    expect(of('jog.step', situation('operator', other))).toBe('anna has control');
    expect(of('jog.step', situation('operator', null))).toBe('take control first');
  });
  it('says what a hold lacks to move anything', () => {
    const moving = (motion: { stopped: boolean; may_move: boolean }, more: object = {}): Situation => {
      const where = situation('operator');
      return { ...where, state: { ...where.state!, motion, ...more } };
    };
    expect(of('jog.forward', situation('operator'))).toBe('');
    expect(of('jog.forward', moving({ stopped: true, may_move: false }))).toBe('motion is stopped');
    expect(of('jog.forward', moving({ stopped: false, may_move: false }))).toBe('motion is inhibited: give Start motion');
    expect(of('jog.forward', situation('operator', null))).toBe('take control first');
    // A value can be set all the same.
    expect(of('jog.step', moving({ stopped: true, may_move: false }))).toBe('');
    expect(of('jog.step', moving({ stopped: true, may_move: false }, { mode: 'safe' }))).toBe('the application ends');
  });
  it('says that the time of the session is over', () => {
    const over = situation('viewer', null);
    const lapsed = { ...over, session: { ...over.session!, lapsed: true } };
    expect(of('jog.step', lapsed)).toBe('log in again');
    expect(deniedControl(lapsed)).toBe('log in again');
  });
  it('says that motion has to be permitted, last of all and where the table says so', () => {
    const still = situation('operator');
    const stopped = { ...still, state: { ...still.state!, motion: { stopped: true, may_move: false } } };
    const hold = { ...model.item('jog.step')!, needs: [{ reason: 'needs motion' }] };
    expect(locked(stopped, hold)).toBe('needs motion');
    expect(locked(still, hold)).toBe('');
    expect(locked({ ...stopped, session: { ...still.session!, role: 'viewer' } }, hold)).toBe('needs operator');
    expect(locked(stopped, { ...hold, needs: [{ reason: 'needs state to be ready', key: 'jog.feedback.state', numbers: [1] }] })).toBe('');
  });
  it('says to which driver belongs what is not there', () => {
    expect(locked(situation('admin'), { ...model.item('jog.step')!, absent: "this belongs to 'can'" })).toBe("this belongs to 'can'");
  });
  it('tells what is never changed here', () => {
    expect(of('jog.feedback.presses', situation('admin'))).toBe('read only');
    expect(of('jog.configuration.lag', situation('admin'))).toBe('changed by Edit');
    expect(of('nothing', situation('admin'))).toBe('unknown');
  });
  it('trusts nobody before session and state are known', () => {
    expect(of('jog.step', situation('admin', you, { session: undefined }))).toBe('needs operator');
    expect(of('jog.step', situation('admin', you, { state: undefined }))).toBe('take control first');
  });
});

describe('control', () => {
  it('may be taken by an operator', () => {
    expect(deniedControl(situation('operator', null))).toBe('');
    expect(deniedControl(situation('operator', other))).toBe('');
    expect(deniedControl(situation('viewer', null))).toBe('needs operator');
  });
  it('is not asked for twice, nor taken from the machine', () => {
    expect(deniedControl(situation('operator', you, {}, other))).toBe('anna asks for it already');
    expect(deniedControl(situation('operator', { ...other, local: true }))).toBe('held at the machine');
  });
  it('is needed for actions', () => {
    expect(deniedAction(situation('engineer'), 'engineer')).toBe('');
    expect(deniedAction(situation('engineer', null), 'engineer')).toBe('take control first');
  });
});
