// The PC on which the application runs, as its helper tells of it: asked for again and again, there is nobody who would say it.
import { getJson, type Fetched } from './http';
import { added } from './watchers';

export type BootWord = 'confirmed' | 'only' | 'trial' | 'fallback' | 'manual' | 'unknown';
export type SlotName = 'A' | 'B';
export type UpdatePhase = 'none' | 'receiving' | 'verifying' | 'verified' | 'installing' | 'installed' | 'failed';

export interface MachineSlot {
  readonly version: string;
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
  /** Of a failure. */
  readonly why: string;
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
}

/** ms; the first while somebody looks or something is under way. */
const soon = 1000;
const later = 5000;

export interface MachineWatchOptions {
  /** Nobody is asked while the link to the application is lost. */
  readonly isLinked: () => boolean;
  readonly changed: () => void;
}

export class MachineWatch {
  /** There is a PC; the application said so. */
  isThere = false;
  /** As it was when it was heard last. */
  state: MachineState | undefined;
  /** Why nothing newer is known; empty: it is. */
  trouble = '';
  #lookers = new Set<object>();
  #timer: ReturnType<typeof setTimeout> | undefined;
  #asked: Promise<void> | undefined;

  constructor(private readonly options: MachineWatchOptions) {}

  /** With each connection. */
  begin(isThere: boolean): void {
    this.isThere = isThere;
    if (!isThere) this.state = undefined;
    this.end();
    if (isThere) void this.refresh();
  }

  end(): void {
    clearTimeout(this.#timer);
  }

  /** Somebody looks, until the returned function is called. */
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

  async #ask(): Promise<void> {
    this.end();
    if (this.isThere && this.options.isLinked()) this.#heard(await getJson<MachineState>('/api/v1/machine'));
    this.end();
    if (!this.isThere) return;
    this.#timer = setTimeout(() => void this.refresh(), this.#lookers.size > 0 || isBusy(this.state) ? soon : later);
  }

  #heard(answer: Fetched<MachineState>): void {
    const before = JSON.stringify([this.state, this.trouble]);
    if (answer.ok) this.state = answer.body;
    this.trouble = answer.ok ? '' : answer.detail;
    if (JSON.stringify([this.state, this.trouble]) !== before) this.options.changed();
  }
}

function isBusy(state: MachineState | undefined): boolean {
  return state !== undefined && (!state.confirmed || ['receiving', 'verifying', 'installing'].includes(state.update.phase));
}

/** What every view says of the PC, as long as it is so. */
export function lastingLines(state: MachineState | undefined): readonly string[] {
  if (!state) return [];
  const { update } = state;
  const percent = update.phase === 'receiving' ? Math.floor((100 * update.received) / Math.max(update.size, 1)) : update.percent;
  const phases: { readonly [phase in UpdatePhase]?: string } = {
    receiving: `An update is being uploaded: ${percent} %`,
    verifying: 'An update is being verified',
    installing: `Version ${update.version} is being installed: ${percent} %. Nothing may move meanwhile`,
    installed: `Version ${update.version} is installed: it starts with the next restart`,
  };
  return [
    state.development_key ? 'Signed with the development key: anyone can make an update for this PC' : '',
    state.confirmed ? '' : `Version ${state.version} has not confirmed itself: healthy for ${state.healthy_for_s} of ${state.healthy_needed_s} s`,
    phases[update.phase] ?? '',
  ].filter((line) => line !== '');
}
