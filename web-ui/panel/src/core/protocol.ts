// What the server says in JSON, as docs/panel-protocol.md has it.
import type { ListName, Role, Value } from '../contract';

/** RFC 9457. */
export interface Problem {
  readonly type?: string;
  readonly title: string;
  readonly status?: number;
  readonly detail?: string;
  readonly parameter?: string;
  readonly reason?: string;
  readonly moving?: readonly string[];
  /** Of an update: bytes that the PC has of it. */
  readonly received?: number;
}

/** Answer to an operation: what it brings along is beside `ok`. */
export type Answer<Fields = object> =
  | ({ readonly id: number; readonly ok: true } & Fields)
  | { readonly id: number; readonly ok: false; readonly problem: Problem };

export interface SessionInfo {
  readonly name: string;
  readonly role: Role;
  readonly local: boolean;
  readonly user: string;
  /** Its time is over: it sees, may stop motion, and has to log in for more. */
  readonly lapsed?: boolean;
}

/** By the device's name. */
export type Drivers = { readonly [device: string]: string };

export interface Hello {
  readonly event: 'hello';
  readonly protocol: number;
  readonly application: string;
  /** Differs after each start of the application. */
  readonly boot: string | number;
  /** Hash of descriptor.json, 16 hexadecimal digits. */
  readonly descriptor: string;
  /** Of each device the driver that was chosen at this start. */
  readonly drivers: Drivers;
  /** Words for the reason of each item that is NULL, by its number. */
  readonly null_reasons: readonly string[];
  readonly session: SessionInfo;
  readonly server_time_ns: number;
  /** It runs on a PC of which GET machine tells. */
  readonly machine?: boolean;
}

export type Mode = 'starting' | 'running' | 'finishing' | 'stopping' | 'safe' | 'ended';

export interface Fault {
  /** A unit, a device; a thread or the application that stood still. */
  readonly component: string;
  readonly kind: 'unit' | 'device' | 'thread' | 'process';
  readonly cause: string;
  /** When it was seen first, CLOCK_MONOTONIC of the application; a longer standstill is a new one. */
  readonly since_ns: number;
}

export interface ControlSession {
  readonly name: string;
  readonly user: string;
  readonly address: string;
  readonly local: boolean;
  readonly you: boolean;
}

/** Of the values that were set, and the configuration file. */
export interface SavedValues {
  /** The application has one. */
  readonly file: boolean;
  /** Written by itself after changes, or only on command. */
  readonly on: 'change' | 'command';
  /** Something was set that the file does not hold yet. */
  readonly unsaved: boolean;
  /** When it was last found to hold everything, since 1970; null: not since the start. */
  readonly saved_at_ms: number | null;
  /** How often the file was written since the start. */
  readonly writings: number;
  /** Why the last attempt failed; empty: it did not. */
  readonly failure: string;
}

export interface ApplicationState {
  readonly mode: Mode;
  readonly cause: string;
  readonly motion: {
    readonly stopped: boolean;
    readonly may_move: boolean;
    /** Why Start would be refused now; empty or none: it would not. */
    readonly start_refused?: string;
    /** Who stopped; at_ms since 1970. */
    readonly stopped_by?: { readonly who: string; readonly at_ms: number } | null;
  };
  readonly faults: readonly Fault[];
  readonly values: SavedValues;
  readonly control: {
    readonly holder: ControlSession | null;
    readonly wanted_by: ControlSession | null;
    readonly answer_within_ms?: number;
  };
  readonly edit: { readonly holder: ControlSession; readonly components: readonly string[]; readonly left_ms: number } | null;
  readonly server: {
    readonly connections: number;
    readonly places: number;
    readonly loop_delay_us: { readonly p99: number; readonly max: number };
  };
}

export interface LogLine {
  readonly number: number;
  readonly text: string;
}

export type TopicName = ListName | 'log';

export type ServerEvent =
  | Hello
  | ({ readonly event: 'state' } & ApplicationState)
  | { readonly event: 'topic'; readonly name: string; readonly body: unknown }
  | { readonly event: 'log'; readonly lines: readonly LogLine[] }
  | { readonly event: 'session'; readonly session: SessionInfo }
  | { readonly event: 'ended'; readonly text: string };

/** Values by parameter path, as requests and answers carry them. */
export type Values = { readonly [path: string]: Value };
