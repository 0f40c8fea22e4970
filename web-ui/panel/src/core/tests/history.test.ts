import { describe, expect, it, vi } from 'vitest';
import { chosen, History } from '../history';

const change = (path: string, before: number, after: number, component = 'jog') => ({ component, before: { [path]: before }, after: { [path]: after } });

describe('the history', () => {
  it('takes what a hand does in one go for one change', () => {
    const history = new History();
    history.note(change('step', 1, 2), 0);
    history.note(change('step', 2, 3), 100);
    history.note(change('step', 3, 4), 900);
    expect(history.last).toEqual(change('step', 1, 4));
    history.note(change('step', 4, 5), 2000);
    expect(history.last).toEqual(change('step', 4, 5));
    history.drop(history.last!);
    expect(history.last).toEqual(change('step', 1, 4));
  });

  it('keeps parameters and components apart', () => {
    const history = new History();
    history.note(change('step', 1, 2), 0);
    history.note(change('speed', 7, 8), 10);
    history.note(change('speed', 5, 6, 'arm'), 20);
    expect(history.last?.component).toBe('arm');
    history.drop(history.last!);
    expect(history.last).toEqual(change('speed', 7, 8));
  });

  it('does not join what follows a change that was taken back', () => {
    const history = new History();
    history.note(change('step', 1, 2), 0);
    history.note(change('speed', 1, 2), 10);
    history.drop(history.last!);
    history.note(change('step', 2, 9), 20);
    expect(history.last).toEqual(change('step', 2, 9));
  });

  it('says when it is another, and forgets', () => {
    const history = new History();
    const watcher = vi.fn();
    const end = history.watch(watcher);
    history.note(change('step', 1, 2), 0);
    history.clear();
    expect(history.last).toBeUndefined();
    end();
    history.note(change('step', 1, 2), 0);
    expect(watcher).toHaveBeenCalledTimes(2);
  });

  it('chooses values by path, all or none', () => {
    expect(chosen({ a: 1, b: 0, c: 3 }, ['a', 'b'])).toEqual({ a: 1, b: 0 });
    expect(chosen({ a: 1 }, ['a', 'b'])).toBeUndefined();
    expect(chosen(undefined, ['a'])).toBeUndefined();
  });
});
