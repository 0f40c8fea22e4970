// Brings an update to the PC, part by part: a part that did not arrive is sent again, and one that did is not.
import type { Fetched } from '../core/http';

export const partSize = 60 * 1024;
/** ms before each attempt after one that failed; so many in a row, and a person has to look. */
export const pauses: readonly number[] = [1000, 2000, 4000, 8000, 8000, 8000, 8000];

/** Too much to do, too many attempts, no answer in time, nobody there. */
const passing = [0, 408, 429, 503, 504];
/** The session is over, or has another role: who logs in again goes on. */
const forbidden = [401, 403];

export type UploadState =
  | { readonly step: 'none' }
  /** `trouble`: why the last part has to be sent again; empty: it has not. */
  | { readonly step: 'sending'; readonly sent: number; readonly size: number; readonly trouble: string }
  | { readonly step: 'sent'; readonly size: number }
  | { readonly step: 'failed'; readonly sent: number; readonly size: number; readonly why: string; readonly resumable: boolean };

export interface BundleUploadOptions {
  readonly put: (token: string, offset: number, bytes: Blob) => Promise<Fetched<{ readonly received: number }>>;
  readonly pause: (ms: number) => Promise<void>;
  readonly changed: () => void;
}

export class BundleUpload {
  state: UploadState = { step: 'none' };
  #file: Blob | undefined;
  #token = '';
  /** Whoever began before this one is to end. */
  #turn = 0;

  constructor(private readonly options: BundleUploadOptions) {}

  get isSending(): boolean {
    return this.state.step === 'sending';
  }

  /** Ends with the file, with a failure, or with the next beginning. */
  begin(file: Blob, token: string): Promise<void> {
    this.#file = file;
    this.#token = token;
    return this.#send(0);
  }

  /** After a failure that allows it. */
  resume(): Promise<void> {
    return this.state.step === 'failed' && this.state.resumable ? this.#send(this.state.sent) : Promise.resolve();
  }

  cancel(): void {
    this.#turn += 1;
    this.#file = undefined;
    this.#become({ step: 'none' });
  }

  async #send(from: number): Promise<void> {
    const turn = (this.#turn += 1);
    const [file, token] = [this.#file!, this.#token];
    let sent = from;
    let failures = 0;
    this.#become({ step: 'sending', sent, size: file.size, trouble: '' });
    while (sent < file.size) {
      const answer = await this.options.put(token, sent, file.slice(sent, sent + partSize));
      if (turn !== this.#turn) return;
      const received = answer.ok ? answer.body.received : answer.problem?.received;
      const gotOn = received !== undefined && received > sent && received <= file.size;
      if (received !== undefined) sent = Math.min(received, file.size);
      if (gotOn) {
        failures = 0;
        this.#become({ step: 'sending', sent, size: file.size, trouble: '' });
        continue;
      }
      // Of a part that was lost it says where to go on; one that says the same again and again does not get on.
      const why = answer.ok ? 'The PC does not count what it gets.' : answer.detail;
      const again = received !== undefined || (!answer.ok && passing.includes(answer.status));
      if (!again || failures === pauses.length) {
        const resumable = again || (!answer.ok && forbidden.includes(answer.status));
        return this.#become({ step: 'failed', sent, size: file.size, why, resumable });
      }
      this.#become({ step: 'sending', sent, size: file.size, trouble: why });
      await this.options.pause(pauses[failures]!);
      failures += 1;
      if (turn !== this.#turn) return;
    }
    this.#file = undefined;
    this.#become({ step: 'sent', size: file.size });
  }

  #become(state: UploadState): void {
    this.state = state;
    this.options.changed();
  }
}
