// Lines of the application's log: their severity, and which of them a person wants to see.
import type { LogLine } from '../core/protocol';

export type LogSeverity = 'information' | 'warning' | 'error';

/** The application writes "error: ..." and "warning: ...", after a time or a name or at the beginning. */
export function severityOf(text: string): LogSeverity {
  const word = /(?:^|[\s\]:])(fatal|error|fault|warning)\b/i.exec(text)?.[1]?.toLowerCase();
  if (word === undefined) return 'information';
  return word === 'warning' ? 'warning' : 'error';
}

export const severities: readonly LogSeverity[] = ['information', 'warning', 'error'];

/** Lines of at least this severity that contain the text, in whatever case. */
export function filterLines(lines: readonly LogLine[], least: LogSeverity, wanted: string): readonly LogLine[] {
  const needle = wanted.toLowerCase();
  const from = severities.indexOf(least);
  return lines.filter((line) => severities.indexOf(severityOf(line.text)) >= from
    && (needle === '' || line.text.toLowerCase().includes(needle)));
}
