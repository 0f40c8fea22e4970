// What the application's states are called, and what one does about them.
import type { ApplicationState, ControlSession, Fault, Mode } from '../core/protocol';

const modes: { readonly [mode in Mode]: string } = {
  starting: 'Starting', running: 'Running', finishing: 'Finishing', stopping: 'Stopping', safe: 'Made safe', ended: 'Ended',
};

export function modeText(mode: Mode): string {
  return modes[mode];
}

export type MotionState = 'stopped' | 'inhibited' | 'enabled' | 'unknown';

export function motionOf(state: ApplicationState | undefined): MotionState {
  if (!state) return 'unknown';
  if (state.motion.stopped) return 'stopped';
  return state.motion.may_move ? 'enabled' : 'inhibited';
}

export const motionText: { readonly [state in MotionState]: string } = {
  stopped: 'Motion stopped', inhibited: 'Motion inhibited', enabled: 'Motion enabled', unknown: 'Motion unknown',
};

/** "by anna (192.168.0.7) at 15:40:28", with the day when it was another one; empty: nobody said who. */
export function stopText(state: ApplicationState | undefined, now = new Date()): string {
  const by = state?.motion.stopped ? state.motion.stopped_by : undefined;
  if (!by) return '';
  const time = new Date(by.at_ms);
  const two = (number: number): string => String(number).padStart(2, '0');
  const clock = `${two(time.getHours())}:${two(time.getMinutes())}:${two(time.getSeconds())}`;
  const day = time.toDateString() === now.toDateString() ? '' : `${time.getFullYear()}-${two(time.getMonth() + 1)}-${two(time.getDate())} `;
  return `by ${by.who} at ${day}${clock}`;
}

/** "anna at 192.168.0.7". */
export function nameOf(session: ControlSession): string {
  const name = session.user || session.name;
  return session.local ? `${name} at the machine` : `${name} at ${session.address}`;
}

/** What to do about a fault, when it does not say so itself. */
export function remedyOf(fault: Fault): string {
  if (fault.kind === 'thread' || fault.kind === 'process')
    return 'Find out what kept it from its work: a debugger, another program of high priority, a machine without real time. Then clear the stop and give Start.';
  return fault.remedy ?? `Remove the cause, then initialise ${fault.component} on its page. What it moves waits for the next Start motion.`;
}
