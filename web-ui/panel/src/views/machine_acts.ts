// What an admin does to the PC: each with what it will do, the password asked for anew, and why it cannot be done now.
import type { Core } from '../core/core';
import { postJson, putBytes } from '../core/http';
import { MachineWatch, type MachineData, type MachineFailure, type MachineState, type SlotName } from '../core/machine';
import { added } from '../core/watchers';
import { BundleUpload } from './bundle_upload';
import { ageOf, bytesText, driversSentence, otherSlot } from './machine_words';

/** The PC's helper has 10 s for a part. */
const partWithin = 15_000;

const acts = new WeakMap<Core, MachineActs>();

/** Outlives views: an upload goes on while a person looks elsewhere. */
export class MachineActs {
  readonly upload: BundleUpload;
  readonly #watchers = new Set<() => void>();
  readonly #machine: MachineWatch;

  static of(core: Core): MachineActs {
    let one = acts.get(core);
    if (one === undefined) acts.set(core, (one = new MachineActs(core)));
    return one;
  }

  private constructor(private readonly core: Core) {
    this.#machine = MachineWatch.of(core);
    this.upload = new BundleUpload({
      put: (token, offset, bytes) => putBytes(`/api/v1/machine/bundle?upload=${token}&offset=${offset}`, bytes, partWithin),
      pause: (ms) => new Promise((resolve) => setTimeout(resolve, ms)),
      changed: () => {
        if (this.upload.state.step !== 'sending') void this.#machine.refresh();
        this.#watchers.forEach((watcher) => watcher());
      },
    });
  }

  watch(callback: () => void): () => void {
    return added(this.#watchers, callback);
  }

  /** Why this session may do nothing to the PC; empty: it may. */
  get denied(): string {
    const denied = this.core.deniedRole('admin');
    if (denied !== '') return denied;
    return this.core.session?.user ? '' : 'needs a log-in with a password';
  }

  /** Why nothing that needs a cell at rest can be done now. */
  deniedByMotion(state: MachineState): string {
    if (state.update.phase === 'installing') return 'an update is being installed';
    return this.core.state?.motion.may_move ? 'the cell may move: give Stop motion first' : '';
  }

  askUpload(file: File): void {
    this.core.askPassword({
      heading: 'Upload this update?',
      says: [`${file.name}, ${bytesText(file.size)}. The PC checks who signed it before it can be installed. The cell goes on meanwhile.`],
      action: 'Upload',
      act: async (password) => {
        const answer = await postJson<{ readonly upload: string }>('/api/v1/machine/upload', { password, size: file.size });
        if (!answer.ok) return answer.detail;
        void this.upload.begin(file, answer.body.upload);
        return '';
      },
    });
  }

  askInstall(state: MachineState): void {
    const { update } = state;
    const older = ageOf(state, update) === 'older';
    const drivers = driversSentence(update.driver_changes);
    this.core.askPassword({
      heading: older ? 'Install this older version?' : 'Install this version?',
      says: [
        `${update.application} ${update.version} is written into slot ${otherSlot(state)}; what is there now is lost. Slot ${state.slot}, which runs, stays as it is.`,
        ...(older ? [`It is older than ${state.version}, which runs: faults that were mended since may come back.`] : []),
        ...(drivers === '' ? [] : [drivers, 'A simulated driver moves no machine, and a real one does: install it only where you mean this change.']),
        ...(update.application === state.application ? [] : [`This PC runs ${state.application}: by this update it becomes another cell.`]),
        'Nothing may move while it is written, and until somebody gives Start motion again. It starts with the next restart, on trial: if it does not find itself healthy, the PC goes back.',
      ],
      action: drivers !== '' ? 'Install, with other drivers' : older ? 'Install the older version' : 'Install',
      act: (password) => this.post('install', { password, older, other_drivers: drivers !== '' }),
    });
  }

  askChoose(state: MachineState, slot: SlotName): void {
    const drivers = slot === state.slot ? '' : driversSentence(state.slots[slot]?.driver_changes ?? []);
    this.core.askPassword({
      heading: `Start slot ${slot} next?`,
      says: [
        `Slot ${slot} holds ${state.slots[slot]?.version || 'a version without a name'}. It starts with the next restart, on trial: if it does not find itself healthy, the PC goes back to slot ${state.slot}.`,
        ...(drivers === '' ? [] : [drivers]),
        'Until the restart what runs goes on.',
      ],
      action: `Start slot ${slot} next`,
      act: (password) => this.post('choose', { password, slot, other_drivers: drivers !== '' }),
    });
  }

  askRemoveLogs({ old_logs }: MachineData): void {
    this.core.askPassword({
      heading: 'Remove the old logs?',
      says: [
        `${bytesText(old_logs)} of closed log files of this PC are removed; what happened then cannot be looked up any more. The newest file, the audit and the configuration stay.`,
        'The last lines of a version that failed go, too, if they are in these files.',
      ],
      action: 'Remove old logs',
      act: (password) => this.post('make-room', { password, what: 'logs' }),
    });
  }

  askDismissFailure({ slot, version }: MachineFailure): void {
    this.core.askPassword({
      heading: 'Dismiss this failure?',
      says: [`Why ${version ? `version ${version}` : 'the version'} in slot ${slot} failed is shown no more, to nobody. The version stays in its slot.`],
      action: 'Dismiss',
      act: (password) => this.post('dismiss-failure', { password, slot }),
    });
  }

  askRestart(): void {
    this.core.askPassword({
      heading: 'Restart the PC now?',
      says: [
        'The application ends and the whole PC restarts; this page is back when it runs again, after a minute or so.',
        'After it nothing moves before somebody gives Start motion.',
      ],
      action: 'Restart now',
      act: (password) => this.post('restart', { password }),
    });
  }

  /** Why it was refused; empty: it is done. */
  async post(what: string, body: object): Promise<string> {
    const answer = await postJson(`/api/v1/machine/${what}`, body);
    void this.#machine.refresh();
    return answer.ok ? '' : answer.detail;
  }
}
