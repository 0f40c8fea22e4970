// The way of one parameter's value: from a person's hand to the unit, and back from the unit to the page.
import type { Outcome, SetOptions, Value } from '../contract';
import { textOfError } from '../core/reasons';
import { valueAt } from '../core/value_path';

/** Least time between two requests while a hand drags, ms: enough to tune by, little enough for log and audit. */
const spacing_ms = 100;

/**
 * What is shown is the value in force, except while a person drags or types, or a request is unanswered: then it is
 * the person's.
 */
export class Edit {
  /** Why the last request was refused; empty when it was not. */
  refusal = '';
  private force: Value | null = null;
  private own: Value | undefined;
  private hands = false;
  /** The newest request, until it is answered. */
  private asked: Promise<Outcome> | undefined;
  /** Aborted with cancel(): what was asked for before is not wanted any longer. */
  private wanted = new AbortController();

  constructor(
    /** One at a time, as WidgetHost.set(). */
    private readonly send: (value: Value, options: SetOptions) => Promise<Outcome>,
    private readonly path: () => string | undefined,
    /** Called whenever `shown`, `refusal`, `pending` or `inForce` may have changed. */
    private readonly changed: () => void,
  ) {}

  get inForce(): Value | null {
    return this.force;
  }
  /** A person's hand is on it. */
  get touched(): boolean {
    return this.hands;
  }
  /** Sent, and not answered yet. */
  get pending(): boolean {
    return this.asked !== undefined;
  }
  get shown(): Value | null {
    return (this.hands || this.pending) && this.own !== undefined ? this.own : this.force;
  }

  /** From the unit. */
  echo(value: Value | null): void {
    this.force = value;
    if (!this.hands && !this.pending) this.changed();
  }

  /** A drag or typing begins: echoes are ignored until letGo() or cancel(). */
  touch(): void {
    if (this.hands) return;
    this.hands = true;
    this.own = undefined;
    this.changed();
  }

  /** The person's, but not sent yet: a question is open. */
  propose(value: Value): void {
    this.hands = true;
    this.own = value;
    this.changed();
  }

  letGo(): void {
    if (!this.hands) return;
    this.hands = false;
    this.changed();
  }

  put(value: Value): void {
    this.own = value;
    this.refusal = '';
    void this.follow(this.send(value, { spacing: this.hands ? spacing_ms : 0, signal: this.wanted.signal }), value);
  }

  /** What was typed makes no sense: nothing is sent. */
  refuse(reason: string): void {
    this.hands = false;
    this.own = undefined;
    this.refusal = reason;
    this.changed();
  }

  /** The person gave up, or may not any more: back to the value in force. */
  cancel(): void {
    this.wanted.abort();
    this.wanted = new AbortController();
    this.asked = undefined;
    this.hands = false;
    this.own = undefined;
    this.changed();
  }

  /** A request of another kind with the same answer: a reset to the default. */
  perform(make: () => Promise<Outcome>): void {
    this.cancel();
    this.refusal = '';
    void this.follow(make());
  }

  /** `value`: what was asked for; undefined: the unit knows. */
  private async follow(asked: Promise<Outcome>, value?: Value): Promise<void> {
    const { signal } = this.wanted;
    this.asked = asked;
    this.changed();
    const outcome = await asked.catch((failure): Outcome => ({ ok: false, detail: textOfError(failure) }));
    if (signal.aborted) return;
    if (this.asked === asked) this.asked = undefined;
    if (outcome.ok) {
      const answered = valueAt(outcome.values, this.path());
      if (answered !== undefined) this.force = answered;
      else if (value !== undefined) this.force = value;
    } else if (!this.pending) {
      this.refusal = outcome.detail;
    }
    if (!this.pending && !this.hands) this.own = undefined;
    this.changed();
  }
}
