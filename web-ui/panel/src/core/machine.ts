// The PC on which the application runs, as its helper tells of it: asked for again and again, there is nobody who would say it.
import type { Core } from './core';
import { getJson } from './http';
import { added } from './watchers';

export type BootWord = 'confirmed' | 'only' | 'trial' | 'fallback' | 'manual' | 'unknown';
export type SlotName = 'A' | 'B';
export type UpdatePhase = 'none' | 'receiving' | 'verifying' | 'verified' | 'installing' | 'installed' | 'failed';

/** Of a device, against the version that runs. Empty: there is no such device, or the version does not tell its driver. */
export interface DriverChange {
  readonly device: string;
  readonly from: string;
  readonly to: string;
}

export interface MachineSlot {
  readonly version: string;
  readonly driver_changes: readonly DriverChange[];
  /** It holds a version that can start. */
  readonly whole: boolean;
  /** It starts next. */
  readonly primary: boolean;
}

export interface MachineUpdate {
  readonly phase: UpdatePhase;
  /** Bytes. */
  readonly received: number;
  readonly size: number;
  /** Of what is under way. */
  readonly percent: number;
  readonly version: string;
  readonly application: string;
  readonly older: boolean;
  readonly driver_changes: readonly DriverChange[];
  /** Of a failure. */
  readonly why: string;
}

/** What decides an interface's address: the files of the version that runs, or an admin. */
export type NetworkSetting = 'image' | 'dhcp' | 'fixed';

export interface NetworkInterface {
  readonly interface: string;
  readonly mac: string;
  /** There is a cable with somebody at its other end. */
  readonly link: boolean;
  /** IPv4, each as "10.0.2.15/24", that it has now. */
  readonly addresses: readonly string[];
  readonly setting: NetworkSetting;
  /** Of a fixed one; "10.0.2.15/24" and "10.0.2.2". */
  readonly address: string;
  /** Empty: none. */
  readonly gateway: string;
}

/** An address that is taken back unless somebody keeps it. */
export interface NetworkTrial {
  /** Empty: nothing is on trial. */
  readonly interface: string;
  readonly remaining_s: number;
}

/** A version from which the PC fell back. */
export interface MachineFailure {
  readonly slot: SlotName;
  readonly version: string;
  /** That came to nothing. */
  readonly starts: number;
  /** Which of them left `reason`; 0: none. */
  readonly start: number;
  /** s since 1970, of that start; 0: unknown. */
  readonly began: number;
  readonly reason: string;
  /** Of its application, the newest last. */
  readonly lines: readonly string[];
  /** Empty: there are lines. */
  readonly why_no_lines: string;
}

/** Bytes on the partition for data, at most a minute old. */
export interface MachineData {
  readonly size: number;
  readonly used: number;
  /** For the application: the PC keeps the rest for updates and its journal. */
  readonly free: number;
  readonly configuration: number;
  readonly audit: number;
  readonly journal: number;
  /** Of the journal, what can be removed. */
  readonly old_logs: number;
  readonly updates: number;
  readonly other: number;
  /** False: there are more files than were counted. */
  readonly complete: boolean;
}

export interface MachineState {
  readonly application: string;
  readonly version: string;
  /** s since 1970. */
  readonly built: number;
  /** That runs. */
  readonly slot: SlotName;
  readonly boot: BootWord;
  readonly confirmed: boolean;
  readonly slots: { readonly [slot in SlotName]?: MachineSlot };
  /** "permitted", or why not. */
  readonly motion: string;
  readonly development_key: boolean;
  readonly notices: readonly string[];
  readonly healthy_for_s: number;
  readonly healthy_needed_s: number;
  readonly why_not_healthy: string;
  readonly update: MachineUpdate;
  /** The wired ones; undefined: an older helper, which can set none. */
  readonly network?: readonly NetworkInterface[];
  readonly network_trial?: NetworkTrial;
  /** Undefined: an older helper, or not measured yet. */
  readonly data?: MachineData;
  /** Until an admin dismisses it, or another version is installed in its slot. */
  readonly last_failure?: MachineFailure;
  /** Declared: further names and IPv4 addresses at which the panel answers; undefined: an older helper, which declares none. */
  readonly hosts?: readonly string[];
}

/** ms; the first while somebody looks or something is under way. */
const soon = 1000;
const later = 5000;

const watches = new WeakMap<MachineCore, MachineWatch>();

type MachineCore = Pick<Core, 'hasMachine' | 'link' | 'watchState'>;

/** From the first who needs it on, for as long as the page is there. */
export class MachineWatch {
  /** As it was when it was heard last. */
  state: MachineState | undefined;
  /** Why nothing newer is known; empty: it is. */
  trouble = '';
  #watchers = new Set<() => void>();
  #lookers = new Set<object>();
  #timer: ReturnType<typeof setTimeout> | undefined;
  #asked: Promise<void> | undefined;
  #wasLinked = false;

  static of(core: MachineCore): MachineWatch {
    let watch = watches.get(core);
    if (watch === undefined) watches.set(core, (watch = new MachineWatch(core)));
    return watch;
  }

  private constructor(private readonly core: MachineCore) {
    const asLinked = (): void => {
      const before = this.#wasLinked;
      this.#wasLinked = this.#isLinked;
      if (this.#wasLinked && !before) void this.refresh();
    };
    core.watchState(asLinked);
    asLinked();
  }

  /** Calls back when it changed, until the returned function is called. */
  watch(callback: () => void): () => void {
    return added(this.#watchers, callback);
  }

  /** Somebody looks closely, until the returned function is called. */
  look(): () => void {
    const forget = added(this.#lookers, {});
    void this.refresh();
    return forget;
  }

  /** Asks now: what is under way already may be older than what was just done. */
  async refresh(): Promise<void> {
    if (this.#asked) await this.#asked;
    this.#asked ??= this.#ask().finally(() => { this.#asked = undefined; });
    await this.#asked;
  }

  /** There is a PC, and somebody who could be asked. */
  get #isLinked(): boolean {
    return this.core.hasMachine && this.core.link.phase === 'open';
  }

  async #ask(): Promise<void> {
    clearTimeout(this.#timer);
    if (!this.#isLinked) return; // with the link it goes on
    const answer = await getJson<MachineState>('/api/v1/machine');
    const before = JSON.stringify([this.state, this.trouble]);
    if (answer.ok) this.state = answer.body;
    this.trouble = answer.ok ? '' : answer.detail;
    this.#timer = setTimeout(() => void this.refresh(), this.#lookers.size > 0 || isBusy(this.state) ? soon : later);
    if (JSON.stringify([this.state, this.trouble]) !== before) this.#watchers.forEach((watcher) => watcher());
  }
}

/** What is on trial; undefined: nothing. */
export function trialOf(state: MachineState | undefined): NetworkTrial | undefined {
  return state?.network_trial?.interface ? state.network_trial : undefined;
}

function isBusy(state: MachineState | undefined): boolean {
  return state !== undefined
    && (!state.confirmed || trialOf(state) !== undefined || ['receiving', 'verifying', 'installing'].includes(state.update.phase));
}
