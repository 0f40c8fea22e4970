// The declared hosts of the PC, further names and addresses at which its panel answers: the check of what an admin types, and what it will do.
import type { MachineState } from '../core/machine';
import { numberOf } from './network_words';

const mostHosts = 8;

/** What was typed, each once; the helper compares without case, too. */
export function hostsIn(text: string): readonly string[] {
  return [...new Set(text.toLowerCase().split(/[\s,]+/).filter((host) => host !== ''))];
}

/** "cell7.example.org, 203.0.113.7". */
export function hostsText(hosts: readonly string[]): string {
  return hosts.join(', ') || 'none';
}

/** Why these cannot be declared in place of those that are; empty: they can. */
export function hostsFault(declared: readonly string[], next: readonly string[]): string {
  const wrong = next.find((host) => !isHost(host));
  if (wrong !== undefined) return `“${wrong}” is no host: type a name as cell7.example.org or an address as 203.0.113.7, without https:// and port`;
  if (next.length > mostHosts) return `at most ${mostHosts} can be set`;
  return isSame(declared, next) ? 'they are set so already' : '';
}

/** What will happen, a paragraph each; `here`: the host by which this page was opened. */
export function hostsConsequences(state: MachineState, next: readonly string[], here: string): readonly string[] {
  const declared = state.hosts ?? [];
  const removed = declared.filter((host) => !next.includes(host));
  const answers = next.length > 0 ? `The panel answers at ${hostsText(next)}, too, in a second or two.`
    : 'The panel answers at this PC’s own addresses and names only, in a second or two.';
  return [
    removed.length > 0 ? `${answers} It no longer answers at ${hostsText(removed)}.` : answers,
    ...(removed.includes(here) && !isOwn(state, here) ? [`⚠ You opened this page by ${here}; after this change it no longer answers there.`] : []),
  ];
}

function isSame(one: readonly string[], other: readonly string[]): boolean {
  return one.length === other.length && one.every((host) => other.includes(host));
}

/** The PC itself has this address. */
function isOwn({ network }: MachineState, host: string): boolean {
  return host === 'localhost' || (network ?? []).some(({ addresses }) => addresses.some((address) => address.startsWith(`${host}/`)));
}

/** As the helper checks it; `host` in lower case. */
function isHost(host: string): boolean {
  const labels = host.split('.');
  if (host.length > 253 || labels.some((label) => !/^[a-z0-9_-]+$/.test(label))) return false;
  // Browsers take it for an IPv4 address and for nothing else.
  return !/^\d+$/.test(labels.at(-1)!) || numberOf(host) !== undefined;
}
