import { describe, expect, it } from 'vitest';
import { filterLines, severityOf } from './log_lines';

describe('lines of the log', () => {
  it.each([
    ['12.3 robot: moved', 'information'], ['warning: no real-time rights', 'warning'], ['[3.2] error: port in use', 'error'],
    ['robot: fault: drive 3', 'error'], ['no errors so far', 'information'],
  ] as const)('%s is %s', (text, severity) => expect(severityOf(text)).toBe(severity));
  it('are filtered by severity and text', () => {
    const lines = ['robot moved', 'warning: Robot slow', 'error: jog'].map((text, number) => ({ number, text }));
    const texts = (...[least, wanted]: [Parameters<typeof filterLines>[1], string]): string[] =>
      filterLines(lines, least, wanted).map((line) => line.text);
    expect(texts('information', 'ROBOT')).toEqual(['robot moved', 'warning: Robot slow']);
    expect(texts('warning', '')).toEqual(['warning: Robot slow', 'error: jog']);
    expect(texts('error', 'robot')).toEqual([]);
  });
});
