// What the application's states are called, and what one does about them.
import { deniedLink } from './access';
import type { LinkStatus } from './core';
import type { ApplicationState, Fault, Mode } from './protocol';
import { addressOfRoute } from './route';

const modes: { readonly [mode in Mode]: string } = {
  starting: 'Starting', running: 'Running', finishing: 'Finishing', stopping: 'Stopping', safe: 'Made safe', ended: 'Ended',
};

export function modeText(mode: Mode | 'unknown'): string {
  return mode === 'unknown' ? 'Not known' : modes[mode];
}

/** What the page knows of the application now. */
export interface Known {
  readonly state: ApplicationState | undefined;
  readonly link: Pick<LinkStatus, 'phase' | 'stale'>;
}

/** What it does; once nothing is heard of it, only that it ended is still so. */
export function modeOf(known: Known): Mode | 'unknown' {
  const { state } = known;
  if (state?.mode === 'ended') return 'ended';
  return !state || deniedLink(known) !== '' ? 'unknown' : state.mode;
}

export type MotionState = 'stopped' | 'inhibited' | 'enabled' | 'ending' | 'ended' | 'unknown';

/** Whether it may move: the last word of an application that is silent since says nothing of that. */
export function motionOf(known: Known): MotionState {
  const mode = modeOf(known);
  if (mode === 'unknown' || !known.state) return 'unknown';
  if (mode === 'safe' || mode === 'ended') return 'ended';
  if (mode === 'stopping') return 'ending';
  if (known.state.motion.stopped) return 'stopped';
  return known.state.motion.may_move ? 'enabled' : 'inhibited';
}

export const motionText: { readonly [state in MotionState]: string } = {
  stopped: 'Motion stopped', inhibited: 'Motion inhibited', enabled: 'Motion enabled', ending: 'Motion is coming to rest',
  ended: 'Motion ended', unknown: 'Motion not known',
};

const two = (part: number): string => String(part).padStart(2, '0');
const dayOf = (at: Date): string => [at.getFullYear(), two(at.getMonth() + 1), two(at.getDate())].join('-');
const timeOf = (at: Date): string => [at.getHours(), at.getMinutes(), at.getSeconds()].map(two).join(':');

/** "14:32:07" of today, "2026-11-22 14:32:07" of another day, and without `now` of each; by the clock of whoever looks. */
export function clockText(at: Date, now?: Date): string {
  return now && dayOf(at) === dayOf(now) ? timeOf(at) : `${dayOf(at)} ${timeOf(at)}`;
}

/** "by anna (192.168.0.7) at 15:40:28", with the day when it was another one; empty: nobody said who. */
export function stopText(state: ApplicationState | undefined, now = new Date()): string {
  const by = state?.motion.stopped ? state.motion.stopped_by : undefined;
  if (!by) return '';
  return `by ${by.who} at ${clockText(new Date(by.at_ms), now)}`;
}

/** The page that tells most of what is in fault. */
export function addressOfFault(fault: Fault): string {
  if (fault.kind === 'process') return addressOfRoute({ view: 'threads', path: [] });
  return addressOfRoute({ view: `${fault.kind}s`, path: [fault.component] });
}

/** The fault that was seen last; undefined: there is none. */
export function newestFault(faults: readonly Fault[]): Fault | undefined {
  return faults.reduce<Fault | undefined>((newest, fault) => (newest && newest.since_ns >= fault.since_ns ? newest : fault), undefined);
}

export function faultCount(count: number): string {
  return count === 1 ? '1 fault' : `${count} faults`;
}

/** The browser's tab is all that is seen of a page that lies behind others. */
export function titleOf(application: string, known: Known): string {
  const { state } = known;
  const name = `${application} – FlexRF panel`;
  if (state?.mode === 'ended') return `Ended · ${name}`;
  if (deniedLink(known) !== '') return `⚠ No connection · ${name}`;
  return state && state.faults.length > 0 ? `✕ ${faultCount(state.faults.length)} · ${name}` : name;
}

/** What to do about a fault, beside what its cause says. */
export function remedyOf(fault: Omit<Fault, 'since_ns'>): string {
  if (fault.kind === 'thread' || fault.kind === 'process')
    return 'Find out what kept it from its work: a debugger, another program of high priority, a machine without real time. Then clear the stop and give Start.';
  return `Remove the cause, then initialise ${fault.component} on its page. What it moves waits for the next Start motion.`;
}
