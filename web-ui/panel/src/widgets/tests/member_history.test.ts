import { describe, expect, it } from 'vitest';
import { FakeHost } from '../tests/fake_host';
import { historyOf, linePath, longest_line, PopulationHistory, type Judged } from '../member_history';

const member = (value: number, identity = 0, active = true): Judged => ({ value, identity, active });

describe('the history of a population', () => {
  it('keeps one value of each generation: the last', () => {
    const history = new PopulationHistory();
    history.note(1, [member(0.5), member(1)]);
    history.note(1, [member(0.75), member(1)]);
    history.note(3, [member(2), member(1)]);
    expect(history.lines[0]).toEqual([{ at: 1, value: 0.75 }, { at: 3, value: 2 }]);
    expect(history.range).toEqual([0, 2]);
    expect(history.span).toEqual([1, 3]);
  });

  it('begins a line anew with another member in its place, and drops that of one that is gone', () => {
    const history = new PopulationHistory();
    history.note(1, [member(1, 4), member(2, 5)]);
    history.note(2, [member(3, 9), member(2, 5, false)]);
    expect(history.lines).toEqual([[{ at: 2, value: 3 }], []]);
    history.note(3, [member(3, 9), member(2, 5)]);
    expect(history.lines[1]).toEqual([{ at: 3, value: 2 }]);
  });

  it('begins anew when generations go back, and forgets what is long ago', () => {
    const history = new PopulationHistory();
    history.note(7, [member(1)]);
    history.note(2, [member(5)]);
    expect(history.lines[0]).toEqual([{ at: 2, value: 5 }]);
    for (let at = 3; at < 500; ++at) history.note(at, [member(at)]);
    expect(history.lines[0]).toHaveLength(longest_line);
    expect(history.lines[0]!.at(-1)).toEqual({ at: 499, value: 499 });
  });

  it('takes no value that is no number, and no time that is none', () => {
    const history = new PopulationHistory();
    history.note(1, [member(Number.NaN), member(1)]);
    history.note(Number.NaN, [member(1), member(2)]);
    expect(history.lines).toEqual([[], [{ at: 1, value: 1 }]]);
  });

  it('is the same for each row as long as the page is open', () => {
    const host = new FakeHost();
    const history = historyOf(host, 'members');
    expect(historyOf(host, 'members')).toBe(history);
    expect(historyOf(host, 'others')).not.toBe(history);
    expect(historyOf(new FakeHost(), 'members')).not.toBe(history);
  });
});

describe('a line', () => {
  it('goes from the oldest to the newest between the ends of the range', () => {
    const line = [{ at: 10, value: 0 }, { at: 15, value: 4 }, { at: 20, value: 1 }];
    expect(linePath(line, [10, 20], [0, 4])).toBe('M0.0 100.0L50.0 0.0L100.0 75.0');
  });

  it('is a dot of one value, and nothing of none', () => {
    expect(linePath([{ at: 3, value: 0 }], [3, 3], [0, 0])).toBe('M100.0 100.0h0');
    expect(linePath([], [0, 1], [0, 1])).toBe('');
  });
});
