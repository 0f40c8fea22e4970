// The one edit of this page: outlives views, so that a person may look elsewhere while values are being edited.
import { deniedLink, nameOf } from '../core/access';
import type { Core } from '../core/core';
import type { Item } from '../core/descriptor';
import { textOf } from '../core/reasons';
import { added } from '../core/watchers';
import { checkValue } from './check_value';
import type { ComponentRow } from './component_actions';
import { EditFlow, type ApplyAnswer, type BeginAnswer, type Change, type Configuration, type Editor, type Outcome } from './edit_flow';
import { EditHost } from './edit_host';

/** Initialising takes as long as its time-outs say; the server's answer comes at the end. */
const apply_timeout = 180_000;

interface Begun {
  readonly edit: string;
  readonly reinitialised: readonly string[];
  readonly configuration: Configuration;
}

interface Applied {
  readonly outcome: Outcome;
  readonly causes?: readonly string[];
  readonly owners?: readonly string[];
}

const sessions = new WeakMap<Core, EditSession>();

export class EditSession {
  readonly flow: EditFlow;
  readonly host: EditHost;
  /** The driver of each device, as the server said when it was last asked. */
  private readonly drivers = new Map<string, string>();
  private readonly watchers = new Set<() => void>();
  private timer: ReturnType<typeof setInterval> | undefined;

  static of(core: Core): EditSession {
    let session = sessions.get(core);
    if (session === undefined) sessions.set(core, (session = new EditSession(core)));
    return session;
  }

  private constructor(private readonly core: Core) {
    this.flow = new EditFlow({
      link: {
        begin: (components) => this.begin(components),
        apply: (edit, changes) => this.apply(edit, changes),
        discard: (edit) => void core.request('edit_discard', { edit }),
      },
      check: (component, parameter, value) => {
        const item = this.items(component).find((one) => one.path === parameter);
        return item === undefined ? '' : checkValue(item, value);
      },
      now: () => performance.now(),
      changed: () => this.changed(),
    });
    this.host = new EditHost(core.host, () => this.flow, () => this.denied);
    core.watchState(() => {
      if (core.state !== undefined) this.flow.serverSays(this.editor, core.state.edit?.left_ms);
      this.host.refresh();
      this.tell();
    });
  }

  /** Calls back at every step, edited value, and second of the countdown. Ends with the returned function. */
  watch(callback: () => void): () => void {
    return added(this.watchers, callback);
  }

  /** What topic "components" says; whether one has another driver than was known. */
  learnDrivers(rows: Iterable<ComponentRow>): boolean {
    let other = false;
    for (const { name, driver } of rows) {
      if (driver === undefined || this.drivers.get(name) === driver) continue;
      this.drivers.set(name, driver);
      other = true;
    }
    return other;
  }

  /** Configuration parameters of a unit, or of a device with the driver that it has. */
  items(component: string): readonly Item[] {
    const known = this.core.model.components.get(component);
    return known?.driverConfiguration.get(this.drivers.get(component) ?? '') ?? known?.configuration ?? [];
  }

  /** Who edits now, as the server says. */
  get editor(): Editor {
    const edit = this.core.state?.edit;
    if (edit == null) return 'nobody';
    return edit.holder.you ? 'you' : 'other';
  }

  /** Why this session cannot begin an edit; empty when it can ask for one. */
  get denied(): string {
    const edit = this.core.state?.edit;
    if (edit != null && !edit.holder.you) {
      return `${nameOf(edit.holder)} edits ${edit.components.join(', ')}.`;
    }
    return this.core.deniedAction('engineer');
  }

  /** Why what is being edited can neither be applied nor given up; empty when it can. */
  get unlinked(): string {
    return deniedLink(this.core);
  }

  private async begin(components: readonly string[]): Promise<BeginAnswer> {
    const answer = await this.core.request<Begun>('edit_begin', { components });
    if (!answer.ok) {
      return { ok: false, detail: textOf(answer.problem), moving: answer.problem.moving ?? [] };
    }
    return answer;
  }

  private async apply(edit: string, changes: readonly Change[]): Promise<ApplyAnswer> {
    const answer = await this.core.request<Applied>('edit_apply', { edit, changes }, apply_timeout);
    if (!answer.ok) return { ok: false, detail: textOf(answer.problem) };
    return { ok: true, outcome: answer.outcome, causes: answer.causes ?? [], owners: answer.owners ?? [] };
  }

  private changed(): void {
    const running = this.flow.state.step === 'editing';
    if (running && this.timer === undefined) {
      this.timer = setInterval(() => {
        this.flow.tick();
        this.tell();
      }, 1000);
    } else if (!running && this.timer !== undefined) {
      clearInterval(this.timer);
      this.timer = undefined;
    }
    this.host.refresh();
    this.tell();
  }

  private tell(): void {
    this.watchers.forEach((callback) => callback());
  }
}
