// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { filterLines, severityOf } from '../log_lines';

describe('lines of the log', () => {
  it.each([
    ['[   0.000012] info    keyboard: starting', 'info'], ['[  12.345678] warning jog: target refused', 'warning'],
    ['[ 112.345678] error robot: drive 3', 'error'], ['[   1.000000] debug robot: step', 'debug'],
    ['error: of something else', 'info'], ['[   1.000000] strange robot: step', 'info'], ['', 'info'],
  ] as const)('%s is %s', (text, severity) => expect(severityOf(text)).toBe(severity));
  it('are filtered by severity and text', () => {
    const lines = ['[ 1.0] info robot: moved', '[ 2.0] warning Robot: slow', '[ 3.0] error jog: x'].map((text, number) => ({ number, text }));
    const found = (least: Parameters<typeof filterLines>[1], wanted: string): number[] =>
      filterLines(lines, least, wanted).map((line) => line.number);
    expect(found('debug', 'ROBOT')).toEqual([0, 1]);
    expect(found('warning', '')).toEqual([1, 2]);
    expect(found('error', 'robot')).toEqual([]);
  });
});
