// Lines of the application's log: their severity, and which of them a person wants to see.
import type { LogLine } from '../core/protocol';

export type LogSeverity = 'debug' | 'info' | 'warning' | 'error';

export const severities: readonly LogSeverity[] = ['debug', 'info', 'warning', 'error'];

/** A line is "[  12.345678] warning jog: ...", as runtime/log/log.hpp writes it. */
export function severityOf(text: string): LogSeverity {
  const word = /^\[[^\]]*\]\s+(\w+)/.exec(text)?.[1];
  return severities.find((severity) => severity === word) ?? 'info';
}

/** Lines of at least this severity that contain the text, in whatever case. */
export function filterLines(lines: readonly LogLine[], least: LogSeverity, wanted: string): readonly LogLine[] {
  const needle = wanted.toLowerCase();
  const from = severities.indexOf(least);
  return lines.filter((line) => severities.indexOf(severityOf(line.text)) >= from
    && (needle === '' || line.text.toLowerCase().includes(needle)));
}
