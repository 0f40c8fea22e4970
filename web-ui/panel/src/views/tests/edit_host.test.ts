import { beforeEach, describe, expect, it } from 'vitest';
import type { Reading } from '../../contract';
import { EditSession } from '../edit_session';
import { cell } from '../../core/tests/cell';
import { FakeCore, quiet, reading } from '../../core/tests/fake_core';

const lag = 'axis[0].configuration.lag';
const reach = 'axis[0].configuration.reach';
const you = { name: 'me', user: '', address: '', local: true, you: true };

let fake: FakeCore;
let session: EditSession;
let shown: (Reading['value'])[];

beforeEach(() => {
  fake = new FakeCore(cell);
  fake.answer = (op) =>
    op === 'edit_begin'
      ? { ok: true, edit: '7', reinitialised: ['axis[0]'], configuration: { 'axis[0]': { lag: 0.25, reach: 3 } } }
      : op === 'edit_apply'
        ? { ok: true, outcome: 'done', causes: [], owners: ['axis[0]'] }
        : { ok: true };
  session = EditSession.of(fake.core);
  shown = [];
  session.host.watch(lag, ({ value }) => shown.push(value));
});

const frame = (): Promise<void> => new Promise((resolve) => requestAnimationFrame(() => resolve()));

describe('the host of configuration parameters', () => {
  it('shows what is in force, and is locked with what to do about it', () => {
    fake.value(lag, reading(0.25));
    expect(shown).toEqual([0.25]);
    expect(session.host.locked(lag)).toContain('Press Edit');
    fake.denied = 'take control first';
    expect(session.host.locked(lag)).toBe('take control first');
  });

  it('shows the draft while it is edited, and what is in force afterwards', async () => {
    fake.value(lag, reading(0.25));
    await session.flow.open(['axis[0]']);
    expect(session.host.locked(lag)).toBe('');
    expect(await session.host.set(lag, 0.75)).toEqual({ ok: true });
    await frame();
    expect(shown).toEqual([0.25, 0.75]);
    session.flow.discard();
    await frame();
    expect(shown).toEqual([0.25, 0.75, 0.25]);
    expect(fake.requests.map(({ op }) => op)).toEqual(['edit_begin', 'edit_discard']);
  });

  it('refuses what lies beyond the range, and keeps it from being applied', async () => {
    await session.flow.open(['axis[0]']);
    expect(await session.host.set(lag, 3)).toMatchObject({ ok: false, parameter: 'lag' });
    expect(session.flow.cannotApply).toContain('Lag');
  });

  it('sends all edited values together', async () => {
    await session.flow.open(['axis[0]']);
    await session.host.set(lag, 0.75);
    await session.host.set(reach, 1);
    await session.flow.apply();
    expect(fake.requests.at(-1)).toEqual({
      op: 'edit_apply', fields: { edit: '7', changes: [{ component: 'axis[0]', values: { lag: 0.75, reach: 1 } }] },
    });
    expect(session.flow.state.step).toBe('applied');
  });

  it('resets to the default within the edit', async () => {
    await session.flow.open(['axis[0]']);
    await session.host.reset(lag);
    expect(session.flow.value('axis[0]', 'lag')).toBe(0.5);
  });

  it('locks what is no part of the edit', async () => {
    await session.flow.open(['axis[0]']);
    expect(session.host.locked('axis[1].configuration.lag')).toBe('Not part of this edit.');
    expect(await session.host.set('axis[1].configuration.lag', 1)).toMatchObject({ ok: false });
  });

  it('leaves everything else to the page\'s own host', () => {
    const seen: unknown[] = [];
    session.host.watch('slot:goal', ({ value }) => seen.push(value));
    fake.value('slot:goal', reading({ x: 1, y: 2 }));
    expect(seen).toEqual([{ x: 1, y: 2 }]);
  });
});

describe('the edit of this page', () => {
  it('is one for all views', () => {
    expect(EditSession.of(fake.core)).toBe(session);
    expect(EditSession.of(new FakeCore(cell).core)).not.toBe(session);
  });

  it('ends when the server takes it away', async () => {
    await session.flow.open(['axis[0]']);
    fake.says({ edit: { holder: you, components: ['axis[0]'], left_ms: 1000 } });
    expect(session.flow.left).toBeLessThanOrEqual(1000);
    fake.says({ edit: null });
    expect(session.flow.state.step).toBe('ended');
  });

  it('is not begun while another edits', () => {
    fake.says({ edit: { holder: { ...you, name: 'anna', you: false }, components: ['motor'], left_ms: 1000 } });
    expect(session.denied).toContain('anna');
    expect(session.denied).toContain('motor');
    expect(quiet.edit).toBeNull();
  });

  it('says what moves', async () => {
    fake.answer = () => ({ ok: false, problem: { title: 'Conflict', detail: 'motor may move', moving: ['motor'] } });
    await session.flow.open(['axis[0]']);
    expect(session.flow.state).toMatchObject({ step: 'denied', detail: 'motor may move', moving: ['motor'] });
  });
});
