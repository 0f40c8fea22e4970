// What the PC's helper tells, in sentences for people.
import type { BootWord, DriverChange, MachineData, MachineFailure, MachineSlot, MachineState, MachineUpdate, SlotName } from '../core/machine';
import { clockText } from '../core/words';

const why: { readonly [word in BootWord]: string } = {
  confirmed: 'it is the slot that is meant to start, and its version has found itself healthy here.',
  only: 'it is the slot that is meant to start, and the other one holds nothing that could.',
  trial: 'its version is new and on trial. If it does not find itself healthy, the PC goes back to the other slot.',
  fallback: 'the slot that is meant to start could not, or did not find itself healthy. This one stands in for it.',
  manual: 'somebody chose it at the PC’s screen.',
  unknown: 'which slot is meant to start cannot be read from the disk, so that both are tried in turn.',
};

/** "Slot A: it is the slot that is meant to start, ..." */
export function bootSentence(state: MachineState): string {
  return `Slot ${state.slot}: ${why[state.boot] ?? why.unknown}`;
}

export function confirmedSentence(state: MachineState): string {
  if (state.confirmed) return 'Yes: it found itself healthy, and starts from now on.';
  const lack = state.why_not_healthy ? ` It is not healthy now: ${state.why_not_healthy}.` : '';
  return `Not yet: healthy for ${state.healthy_for_s} of ${state.healthy_needed_s} s.${lack}`;
}

export function motionSentence(state: MachineState): string {
  return state.motion === 'permitted' ? 'Permitted by this PC.' : `Not permitted: ${state.motion}.`;
}

export function slotSentence(state: MachineState, name: SlotName, slot: MachineSlot): string {
  const parts = [
    name === state.slot ? 'runs' : '',
    slot.primary ? 'starts next' : '',
    slot.whole ? '' : 'holds nothing that could start',
  ].filter((part) => part !== '');
  return parts.join(', ') || 'could start';
}

/** "123 MB", as disks and files are counted. */
export function bytesText(bytes: number): string {
  if (bytes < 1000) return `${bytes} B`;
  const units = ['kB', 'MB', 'GB'];
  let value = bytes / 1000;
  let unit = 0;
  for (; value >= 999.5 && unit < units.length - 1; ++unit) value /= 1000;
  return `${value < 9.95 ? value.toFixed(1) : value.toFixed(0)} ${units[unit]}`;
}

export type Age = 'older' | 'same' | 'newer';

export function ageOf(state: MachineState, update: MachineUpdate): Age {
  if (update.older) return 'older';
  return update.version === state.version ? 'same' : 'newer';
}

const ages: { readonly [age in Age]: string } = {
  older: '⚠ older than what runs', same: 'the same as what runs', newer: 'newer than what runs',
};

/** "pick-station 20261201T1: newer than what runs". */
export function updateSentence(state: MachineState): string {
  const { update } = state;
  const other = update.application === state.application ? '' : ` ⚠ This PC runs ${state.application}: it would become another cell.`;
  const drivers = update.driver_changes.length === 0 ? '' : ` ⚠ ${driversSentence(update.driver_changes)}`;
  return `${update.application} ${update.version}: ${ages[ageOf(state, update)]}.${other}${drivers}`;
}

/** "It changes drivers: axis_x from canopen to simulated; valve is new, with gpio." Empty: it changes none. */
export function driversSentence(changes: readonly DriverChange[]): string {
  if (changes.length === 0) return '';
  const parts = changes.map(({ device, from, to }) =>
    to === '' ? `${device} had ${from}, and has none that is known`
      : from === '' ? `${device} is new, with ${to}`
        : `${device} from ${from} to ${to}`);
  return `It changes drivers: ${parts.join('; ')}.`;
}

/** By driver, of the application that runs: "canopen: axis_x, axis_z; simulated: camera". */
export function chosenDrivers(drivers: { readonly [device: string]: string }): string {
  const devices = new Map<string, string[]>();
  for (const [device, driver] of Object.entries(drivers)) devices.set(driver, [...(devices.get(driver) ?? []), device]);
  return [...devices].map(([driver, names]) => `${driver}: ${names.join(', ')}`).join('; ') || 'There are no devices.';
}

export function builtText(state: MachineState): string {
  return clockText(new Date(state.built * 1000));
}

/** The other of the two. */
export function otherSlot(state: MachineState): SlotName {
  return state.slot === 'A' ? 'B' : 'A';
}

/** "Why version 20261201T1 in slot B failed" */
export function failureHeading({ version, slot }: MachineFailure): string {
  return `Why ${version ? `version ${version}` : 'the version'} in slot ${slot} failed`;
}

/** "Start 2 of 3, begun 2026-12-01 08:00:12"; of starts that left nothing "3 starts". */
export function failedStartText({ starts, start, began }: MachineFailure): string {
  if (start === 0) return starts === 1 ? '1 start' : starts === 0 ? 'The boot loader could not start it' : `${starts} starts`;
  return `Start ${start} of ${Math.max(start, starts)}${began > 0 ? `, begun ${clockText(new Date(began * 1000))}` : ''}`;
}

/** Of starts after the one that left a reason; empty: there were none. */
export function silentStartsSentence({ starts, start }: MachineFailure): string {
  if (start === 0 || starts <= start) return '';
  const which = starts === start + 1 ? `Start ${starts}` : `Starts ${start + 1} to ${starts}`;
  return `${which} stopped before the services ran: the kernel, the disk or the root failed, or the power was cut.`;
}

/** With a capital letter and a full stop. */
export function sentence(text: string): string {
  return text === '' ? '' : `${text[0]!.toUpperCase()}${text.slice(1)}${/[.!?]$/.test(text) ? '' : '.'}`;
}

const parts: readonly (readonly ['configuration' | 'audit' | 'journal' | 'updates' | 'other', string])[] = [
  ['journal', 'Logs of the PC'], ['updates', 'Updates'], ['audit', 'Audit'], ['configuration', 'Configuration'], ['other', 'Other files'],
];

/** What fills the partition, the largest first: ["Logs of the PC", 64000000]. */
export function dataParts(data: MachineData): readonly (readonly [string, number])[] {
  return parts.map(([part, name]) => [name, data[part]] as const).filter(([, bytes]) => bytes > 0).sort((one, two) => two[1] - one[1]);
}

/** "180 MB of 250 MB used, 32 MB free for the application." */
export function dataSentence({ used, size, free }: MachineData): string {
  return `${bytesText(used)} of ${bytesText(size)} used, ${bytesText(free)} free for the application.`;
}

/** Less than a tenth of what the application could have is free. */
export function isNearlyFull({ used, free }: MachineData): boolean {
  return free * 10 < used + free;
}
