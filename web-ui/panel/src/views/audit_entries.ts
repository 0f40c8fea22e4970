// Entries of the audit in words.
import type { Value } from '../contract';
import { clockText } from '../core/words';
import { hasAll, wordsOf } from './wanted_words';

export interface AuditEntry {
  readonly number: number;
  /** RFC 3339, UTC. */
  readonly at: string;
  readonly who: string;
  readonly did: string;
  readonly what?: string;
  readonly before?: Value | null;
  readonly after?: Value | null;
  readonly count?: number;
}

/** In the person's own time: "2026-11-23 15:40:28". */
export function timeOf(at: string): string {
  const time = new Date(at);
  return Number.isNaN(time.getTime()) ? at : clockText(time);
}

function textOf(value: Value | null | undefined): string {
  return typeof value === 'string' ? value : JSON.stringify(value ?? null);
}

/** "changed jog.step: 0.01 → 0.02". */
export function actOf(entry: AuditEntry): string {
  const what = entry.what ? ` ${entry.what}` : '';
  const values = entry.after === undefined ? '' : `: ${textOf(entry.before)} → ${textOf(entry.after)}`;
  const count = entry.count === undefined ? '' : ` (${entry.count} times)`;
  return `${entry.did}${what}${values}${count}`;
}

/** Those with all of these words, in any order and case. */
export function filterEntries(entries: readonly AuditEntry[], wanted: string): readonly AuditEntry[] {
  const words = wordsOf(wanted);
  return words.length === 0 ? entries : entries.filter((entry) => hasAll(`${timeOf(entry.at)} ${entry.who} ${actOf(entry)}`, words));
}
