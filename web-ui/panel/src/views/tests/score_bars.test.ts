import { describe, expect, it } from 'vitest';
import { barsPath, scoresText } from '../score_bars';

describe('the bars of scores', () => {
  it('stand on zero, the highest as high as the box', () => {
    expect(barsPath([2, 1])).toBe('M0.1 100.0V0.0h0.8V100.0zM1.1 100.0V50.0h0.8V100.0z');
  });

  it('hang below zero where a score does', () => {
    expect(barsPath([1, -1])).toBe('M0.1 50.0V0.0h0.8V50.0zM1.1 50.0V100.0h0.8V50.0z');
  });

  it('leave out what is no number, and bear that all are zero', () => {
    expect(barsPath([0, null])).toBe('M0.1 0.0V0.0h0.8V0.0z');
    expect(barsPath([])).toBe('');
  });

  it('are told by the highest and the lowest', () => {
    expect(scoresText([1.8754, 1, 0.125])).toBe('1.88 to 0.125');
    expect(scoresText([1, 1])).toBe('1');
    expect(scoresText([0.5, null])).toBe('0.5');
    expect(scoresText([null])).toBe('');
  });
});
