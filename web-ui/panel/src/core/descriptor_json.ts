// descriptor.json as config-gen writes it (config-gen/emit/descriptor_emit.cpp).
import type { Placement, Role, Value } from '../contract';

export interface FieldJson {
  readonly name: string;
  /** A scalar of the tables ("f64", "boolean", "text"), or "enumeration", "structure", "button", "hold". */
  readonly scalar: string;
  readonly type?: string;
  readonly shape?: readonly number[];
  /** Of a text, bytes. */
  readonly capacity?: number;
  readonly offset: number;
  /** Of the whole field: all elements of an array. */
  readonly size: number;
  readonly unit?: string;
  readonly summary: string;
}

export interface TypeJson {
  readonly name: string;
  readonly summary: string;
  readonly hash: string;
  readonly size?: number;
  readonly image?: boolean;
  readonly fields?: readonly FieldJson[];
  /** Of an enumeration. */
  readonly values?: readonly { readonly name: string; readonly summary: string }[];
}

export interface ParameterJson {
  readonly name: string;
  readonly role?: Role;
  readonly default?: Value;
  readonly range?: readonly [number, number];
  readonly step?: number;
  readonly persist?: boolean;
  readonly widget?: string;
  readonly label?: string;
  readonly menu?: string;
  readonly needs?: readonly {
    readonly of: 'motion' | 'runtime' | 'feedback';
    readonly field?: string;
    readonly numbers?: readonly number[];
    readonly reason: string;
  }[];
}

export interface BlockJson {
  readonly type: string;
  readonly parameters: readonly ParameterJson[];
}

export interface PortJson {
  readonly name: string;
  readonly type?: string;
  readonly queue?: string;
  readonly interface?: string;
  readonly range?: boolean;
  readonly optional?: boolean;
  readonly max_age_ns?: number;
  readonly summary: string;
}

interface Blocks {
  readonly configuration?: BlockJson;
  readonly runtime?: BlockJson;
  readonly feedback?: BlockJson;
}

export interface UnitTypeJson extends Blocks {
  readonly name: string;
  readonly class: string;
  readonly summary: string;
  readonly inputs?: readonly PortJson[];
  readonly outputs?: readonly PortJson[];
  readonly devices?: readonly PortJson[];
}

export interface InterfaceJson extends Blocks {
  readonly name: string;
  readonly summary: string;
  readonly bus?: boolean;
  readonly outputs?: readonly PortJson[];
}

/**
 * Runtime and feedback only where it has some of its own: then its interface's come first, at the same places. Inputs and outputs
 * are its own.
 */
export interface DriverJson extends Blocks {
  readonly name: string;
  readonly driver: string;
  readonly interface: string;
  readonly inputs?: readonly PortJson[];
  readonly outputs?: readonly PortJson[];
  readonly kind: 'mock' | 'simulated' | 'real';
  readonly actuates: boolean;
  readonly virtual_time: boolean;
  readonly summary: string;
}

/** parameter.P = { ... } of the application's table. */
export interface OverrideJson {
  readonly parameter: string;
  readonly label?: string;
  readonly hidden?: boolean;
  readonly range?: readonly [number | null, number | null];
  readonly step?: number;
  readonly widget?: string;
  readonly menu?: string;
  readonly place?: string;
  /** What a person is asked before it is changed or pressed. */
  readonly confirm?: string;
}

type Connected = string | null | readonly string[];

export interface UnitJson {
  readonly name: string;
  readonly type: string;
  readonly thread?: string;
  readonly population?: string;
  readonly member?: number;
  readonly active?: boolean;
  readonly inputs?: { readonly [port: string]: Connected };
  readonly outputs?: { readonly [port: string]: Connected };
  readonly devices?: { readonly [port: string]: string };
  readonly values_slot?: string;
  readonly feedback_slot?: string;
  readonly configuration?: { readonly [name: string]: Value };
  readonly runtime?: { readonly [name: string]: Value };
  readonly overrides?: readonly OverrideJson[];
  readonly budget_ns?: number;
  readonly restart: string;
}

export interface DeviceJson {
  readonly name: string;
  /** What its row chose of the units that its interface leaves open: { "axis": "m" } makes a field's "axis/s" an "m/s". */
  readonly units?: { readonly [symbol: string]: string };
  readonly interface: string;
  readonly drivers: readonly {
    readonly driver: string;
    readonly type: string;
    readonly configuration?: { readonly [name: string]: Value };
    /** Of the driver's own, as the next two. */
    readonly runtime?: { readonly [name: string]: Value };
    readonly inputs?: { readonly [port: string]: Connected };
    readonly outputs?: { readonly [port: string]: Connected };
  }[];
  readonly on?: string;
  readonly unit?: string;
  readonly thread?: string;
  readonly outputs?: { readonly [port: string]: Connected };
  readonly values_slot?: string;
  readonly feedback_slot?: string;
  readonly runtime?: { readonly [name: string]: Value };
  readonly overrides?: readonly OverrideJson[];
  /** Its URDF among the application's files: "robots/arm.urdf". */
  readonly robot?: string;
  /** Of an arm, from base to tool. */
  readonly joints?: readonly JointJson[];
}

export interface JointJson {
  readonly name: string;
  /** Turns (rad) or slides (m). */
  readonly unit: 'rad' | 'm';
  /** undefined: it turns without end. */
  readonly range?: readonly [number, number];
}

export interface SlotJson {
  readonly name: string;
  readonly type: string;
  /** Of a device's parameters: what it carries with each driver that has more than `type` says. */
  readonly driver_types?: { readonly [driver: string]: string };
  readonly writer: string;
  /** Of what drivers write: the port of each. `writer` is the first. */
  readonly driver_writers?: { readonly [driver: string]: string };
  readonly readers: readonly string[];
  readonly buffers: number;
  readonly observe: boolean;
  readonly wall: boolean;
  readonly history: number;
  readonly summary: string;
}

export interface QueueJson {
  readonly name: string;
  readonly type: string;
  readonly capacity: number;
  readonly policy: string;
  readonly share: string;
  readonly score?: string;
  readonly wall: boolean;
  readonly writers: readonly string[];
  readonly readers: readonly string[];
  readonly summary: string;
}

export interface ThreadJson {
  readonly name: string;
  readonly trigger: { readonly kind: string; readonly period_ns?: number; readonly [key: string]: unknown };
  readonly priority: number;
  readonly role: string;
  readonly units: readonly string[];
  readonly devices: readonly string[];
  readonly budget_ns: number;
  readonly response_time_ns?: number;
  readonly stack: number;
  readonly summary: string;
}

/** A row [widget.NAME]. */
export interface WidgetJson extends Pick<Placement, 'overlays' | 'bodies' | 'frames' | 'base'> {
  readonly name: string;
  readonly kind: string;
  /** Made by widgets/KIND.js of the application. */
  readonly custom?: boolean;
  readonly label?: string;
  /** "overview", or a unit's or device's name. */
  readonly place?: string;
  readonly summary?: string;
  readonly slots?: { readonly [role: string]: string };
  readonly parameters?: { readonly [role: string]: string };
  readonly device?: string;
  readonly options?: { readonly [name: string]: Value };
}

export interface DescriptorJson {
  readonly hash: string;
  readonly format: number;
  readonly application: string;
  readonly summary: string;
  readonly autostart: boolean;
  readonly unit_types: readonly UnitTypeJson[];
  readonly interfaces: readonly InterfaceJson[];
  readonly drivers: readonly DriverJson[];
  readonly types: readonly TypeJson[];
  readonly devices: readonly DeviceJson[];
  readonly units: readonly UnitJson[];
  readonly populations: readonly { readonly name: string; readonly capacity: number; readonly active: number }[];
  readonly groups: readonly { readonly name: string; readonly table: string }[];
  readonly slots: readonly SlotJson[];
  readonly queues: readonly QueueJson[];
  readonly threads: readonly ThreadJson[];
  readonly widgets?: readonly WidgetJson[];
}
