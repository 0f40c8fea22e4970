// @vitest-environment node
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Outcome, SetOptions, Value } from '../../contract';
import { Newest } from '../../core/newest';
import { Edit } from '../edit';

/** A unit that answers when the test says so, behind what the page's host does with its values. */
class Unit {
  readonly sent: Value[] = [];
  private answers: ((outcome: Outcome) => void)[] = [];
  private readonly values = new Newest<Outcome>({ ok: false, detail: 'withdrawn' });
  readonly send = (value: Value, options: SetOptions): Promise<Outcome> =>
    this.values.run(() => {
      this.sent.push(value);
      return new Promise<Outcome>((resolve) => this.answers.push(resolve));
    }, options);
  async answer(outcome: Outcome): Promise<void> {
    this.answers.shift()!(outcome);
    await vi.advanceTimersByTimeAsync(0);
  }
}

describe('Edit', () => {
  let unit: Unit;
  let edit: Edit;
  beforeEach(() => {
    vi.useFakeTimers();
    unit = new Unit();
    edit = new Edit(unit.send, () => 'step', () => undefined);
    edit.echo(1);
  });
  afterEach(() => void vi.useRealTimers());

  it('shows what is in force', () => {
    expect(edit.shown).toBe(1);
    edit.echo(2);
    expect(edit.shown).toBe(2);
  });

  it('shows the hand while it drags, whatever the unit says', () => {
    edit.touch();
    edit.put(5);
    edit.echo(2);
    expect(edit.shown).toBe(5);
  });

  it('shows what was asked for until the answer, then what the unit answered', async () => {
    edit.put(5);
    edit.echo(1);
    expect(edit.shown).toBe(5);
    await unit.answer({ ok: true, values: { step: 4.5 } });
    expect(edit.shown).toBe(4.5);
    expect(edit.pending).toBe(false);
  });

  it('keeps the hand until it lets go, then shows the value in force', async () => {
    edit.touch();
    edit.put(5);
    await unit.answer({ ok: true, values: { step: 4.5 } });
    expect(edit.shown).toBe(5);
    edit.letGo();
    expect(edit.shown).toBe(4.5);
  });

  it('sends one at a time, the newest next, not too often while a hand drags', async () => {
    edit.touch();
    edit.put(2);
    edit.put(3);
    edit.put(4);
    expect(unit.sent).toEqual([2]);
    await unit.answer({ ok: true });
    expect(unit.sent).toEqual([2]);
    await vi.advanceTimersByTimeAsync(100);
    expect(unit.sent).toEqual([2, 4]);
  });

  it('loses nothing when the hand lets go while a value waits', async () => {
    edit.touch();
    edit.put(2);
    edit.put(3);
    edit.letGo();
    await unit.answer({ ok: true, values: { step: 2 } });
    await vi.advanceTimersByTimeAsync(100);
    expect(unit.sent).toEqual([2, 3]);
    await unit.answer({ ok: true, values: { step: 3 } });
    expect(edit.shown).toBe(3);
  });

  it('goes back to the value in force when refused, with the reason', async () => {
    edit.put(5);
    await unit.answer({ ok: false, detail: 'too fast' });
    expect(edit.shown).toBe(1);
    expect(edit.refusal).toBe('too fast');
    edit.put(2);
    expect(edit.refusal).toBe('');
  });

  it('takes a failed request for a refusal', async () => {
    edit = new Edit(() => Promise.reject(new Error('link lost')), () => 'step', () => undefined);
    edit.echo(1);
    edit.put(2);
    await vi.advanceTimersByTimeAsync(0);
    expect(edit.refusal).toBe('link lost');
    expect(edit.shown).toBe(1);
  });

  it('forgets everything when it is cancelled, and late answers too', async () => {
    edit.touch();
    edit.put(5);
    edit.put(6);
    edit.cancel();
    expect(edit.shown).toBe(1);
    await unit.answer({ ok: false, detail: 'too fast' });
    await vi.advanceTimersByTimeAsync(1000);
    expect(edit.refusal).toBe('');
    expect(unit.sent).toEqual([5]);
  });

  it('takes the default from the answer to a reset', async () => {
    edit.perform(async () => ({ ok: true, values: { step: 0.5 } }));
    await vi.advanceTimersByTimeAsync(0);
    expect(edit.shown).toBe(0.5);
  });
});
