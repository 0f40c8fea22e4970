// What widgets and views may know of the page's core, and the contract of custom widgets.

/** As descriptor.json names scalars. */
export type Scalar =
  | 'bool' | 'i8' | 'u8' | 'i16' | 'u16' | 'i32' | 'u32' | 'i64' | 'u64' | 'f32' | 'f64'
  | 'text' | 'enumeration' | 'structure' | 'button' | 'hold';

/** A decoded value: 64-bit integers become numbers; arrays are flat, matrices row by row as number[][]. */
export type Value = number | boolean | string | Value[] | { [field: string]: Value };

export type Role = 'viewer' | 'operator' | 'engineer' | 'admin';

/** One value that a widget shows or edits: a parameter, or a field of a slot. */
export interface ItemInfo {
  /** "jog.step", "robot.feedback.pose", "slot:joints", "slot:joints.position": unique in the application. */
  readonly key: string;
  readonly label: string;
  readonly summary: string;
  readonly scalar: Scalar;
  readonly shape: readonly number[];
  /** Unit of measure, SI; empty where none applies, "1" for dimensionless; "rad|m" where elements have different ones. */
  readonly unit: string;
  /** Of each element, where they have different ones. */
  readonly units?: readonly string[];
  readonly range?: readonly [number, number];
  /** By what a button or key changes it, SI; without one steps follow the value. */
  readonly step?: number;
  /** Names of an enumeration's values, in order. */
  readonly values?: readonly string[];
  /** Members of a structure. */
  readonly members?: readonly ItemInfo[];
  readonly typeName?: string;
  readonly kind: 'runtime' | 'configuration' | 'feedback' | 'slot';
  /** Least role that may change it; undefined for what can only be read. */
  readonly role?: Role;
  readonly default?: Value;
  readonly widget?: string;
  /** What a person is asked before it is changed or pressed. */
  readonly confirm?: string;
  /** What a button or a hold needs to have an effect: all of it. Without `key` it is the permission to move; else this
   *  item, a bool (0, 1) or an enumeration, has one of these numbers. */
  readonly needs?: readonly { readonly reason: string; readonly key?: string; readonly numbers?: readonly number[] }[];
  readonly component?: string;
  /** The parameter's path in requests ("step"). */
  readonly path?: string;
}

/** What is known of an item's value now. */
export interface Reading {
  /** null: the NULL item. */
  readonly value: Value | null;
  /** Why it is null, in words; empty when it is not. */
  readonly reason: string;
  /** CLOCK_MONOTONIC of the application, ns. */
  readonly sampledAt: number;
  readonly sequence: number;
  /** Seconds since it was sampled, by the server's clock. */
  readonly age: number;
  /** A JPEG of an image slot. */
  readonly image?: Blob;
  /** By how much each of its sides is smaller than the slot's picture; without it: not. */
  readonly scaledBy?: number;
}

export type Outcome = { ok: true; values?: { [path: string]: Value } } | { ok: false; detail: string; parameter?: string };

/** Of a value that is set again and again, as while a hand drags. */
export interface SetOptions {
  /** ms that lie at least between the request before, if it is the same parameter's, and this one. */
  readonly spacing?: number;
  /** Once aborted, a value that still waits is not sent. */
  readonly signal?: AbortSignal;
}

/** A hold that lives: refreshed by the core every 100 ms until release() or until it is lost. */
export interface Hold {
  release(): void;
  /** Resolves when the lease is over, however it ended, with the reason. */
  readonly over: Promise<string>;
}

/** One joint of an arm. */
export interface Joint {
  readonly name: string;
  /** Turns (rad) or slides (m). */
  readonly unit: 'rad' | 'm';
  /** undefined: it turns without end. */
  readonly range?: readonly [number, number];
}

/** A unit, as descriptor.json has it: as much as widgets may use. */
export interface UnitTable {
  readonly name: string;
  readonly population?: string;
  readonly thread?: string;
  /** By output port the slot or the queue; null: it is not connected. */
  readonly outputs?: { readonly [port: string]: string | null | readonly string[] };
}

/** Lists of what the application counts, as docs/panel-protocol.md has them. */
export type ListName = 'components' | 'slots' | 'queues' | 'threads' | 'steps';

/** What a widget is given. The same for built-in and custom ones. */
export interface WidgetHost {
  /**
   * Calls back in an animation frame whenever the reading changed (at most `rate` times a second, default 30), and once
   * at once if there is one. Ends with the returned function.
   */
  watch(key: string, callback: (reading: Reading) => void, options?: { rate?: number; width?: number }): () => void;
  /** Sends a runtime parameter; the answer is the unit's. One value is under way: of those that follow before its answer
   *  only the newest is sent, and all get its answer. */
  set(key: string, value: Value, options?: SetOptions): Promise<Outcome>;
  press(key: string, count?: number): Promise<Outcome>;
  hold(key: string): Promise<Hold>;
  reset(key: string): Promise<Outcome>;
  item(key: string): ItemInfo | undefined;
  /** Why this item cannot be changed now ("no control", "needs engineer", "link lost"...); empty when it can. */
  locked(key: string): string;
  /** Calls back when locked() of anything may have changed, and when values turn stale or fresh. */
  watchAccess(callback: () => void): () => void;
  /** More than 1 s of silence: values are old, controls dead. */
  readonly stale: boolean;
  /** A file that the application brought along (its URDF, its meshes). */
  file(path: string): Promise<Response>;
  /** Of an arm, from base to tool: in the order in which slots carry their positions. */
  joints(device: string): readonly Joint[];
  /** All of the application, in the order of the tables; members of a population follow each other. */
  readonly units: readonly UnitTable[];
  /** The newest list, `rate` times a second (at most 10, default 2) if it is another; once at once if it is known. Ends with the
   *  returned function. */
  watchList(name: ListName, callback: (list: unknown) => void, rate?: number): () => void;
}

/** Things that a slot tells of, to be drawn. Fields are paths, as "region.left" or "pixel[0]": of a thing, but `count`. */
export interface Things {
  readonly name: string;
  readonly label?: string;
  /** Whether they are drawn as long as nobody chose. */
  readonly shown: boolean;
  /** Several: of the members of a population, all of one type. */
  readonly slots: readonly string[];
  /** Which field of the slot's value lists them; without one the value is the only thing. */
  readonly list?: string;
  /** A field beside the list: so many of it are in use, from its beginning. */
  readonly count?: string;
  /** A thing whose field has this value is none. */
  readonly empty?: { readonly field: string; readonly value: number | boolean | string };
  /** What is written beside each. */
  readonly text: readonly string[];
  /** A bool: of a thing of which it is false nobody knows whether it is there. */
  readonly certain?: string;
  /** A bool that says the contrary. */
  readonly doubtful?: string;
}

/** Rectangles over a picture: the row [widget.NAME.overlay.NAME]. */
export interface Overlay extends Things {
  /** Left, top, width and height, in pixels of the slot's picture. */
  readonly rectangle: readonly string[];
  /** An enumeration, a bool, or a whole number, of which `classes` are the names from 0 on. */
  readonly class?: string;
  readonly classes?: readonly string[];
  /** A number: the more, the thicker the line. */
  readonly weight?: string;
  /** Where it tells of which picture it is, ns; without it that is when the slot's item was sampled. */
  readonly time?: { readonly of: 'slot' | 'thing'; readonly field: string };
}

/** What bodies of one kind look like: upright prisms. */
export interface BodyKind {
  readonly name: string;
  /** Of the field `kind`. */
  readonly value: number | string;
  /** Corners about the body's place, counter-clockwise, m. */
  readonly outline?: readonly (readonly number[])[];
  /** Round instead, m; a text is the field that tells it. */
  readonly radius?: number | string;
  /** m. */
  readonly height: number;
  /** "#2850c8" */
  readonly colour: string;
}

/** Bodies around a robot, in its own frame: the row [widget.NAME.bodies.NAME]. */
export interface Bodies extends Things {
  /** x and y, m; or x, y and z of the lower face. */
  readonly position: string;
  /** By which the outline is turned about z, rad. */
  readonly angle?: string;
  readonly kind: string;
  readonly kinds: readonly BodyKind[];
}

/** A frame of reference beside a robot: the row [widget.NAME.frame.NAME]. */
export interface ReferenceFrame {
  readonly name: string;
  readonly label?: string;
  readonly shown: boolean;
  /** With `position` (m) and `orientation` (x, y, z, w), in the robot's own frame. */
  readonly slot?: string;
  /** Or of the robot. */
  readonly link?: string;
  /** Where it is in the slot's or the link's. */
  readonly mount?: { readonly position: readonly number[]; readonly orientation: readonly number[] };
  /** What a camera sees that looks along z: pixels, and up to which depth it is drawn, m. */
  readonly frustum?: { readonly width: number; readonly height: number; readonly focal_length: number; readonly depth: number };
}

/** Where the application's table placed a widget, and what it gave it: the row [widget.NAME]. */
export interface Placement {
  readonly name: string;
  readonly kind: string;
  readonly label: string;
  readonly place: string;
  readonly slots: { readonly [role: string]: string };
  readonly parameters: { readonly [role: string]: string };
  readonly device?: string;
  readonly options: { readonly [name: string]: Value };
  /** Of an image. */
  readonly overlays?: readonly Overlay[];
  /** Of a robot. */
  readonly bodies?: readonly Bodies[];
  readonly frames?: readonly ReferenceFrame[];
  /** The robot's link in whose frame bodies and frames are told. */
  readonly base?: string;
}

/** Every widget is a custom element with these properties; the core sets them before it is connected. */
export interface WidgetElement extends HTMLElement {
  host: WidgetHost;
  item?: ItemInfo;
  placement?: Placement;
}

/** Makes a kind of widget known under a name; throws when the name is taken. */
export type RegisterWidget = (kind: string, element: new () => WidgetElement) => void;
