// The way of one parameter's value: from a person's hand to the unit, and back from the unit to the page.
import type { Outcome, Value } from '../contract';

/** Least time between two requests while a hand drags, ms: enough to tune by, little enough for log and audit. */
const spacing_ms = 100;

/**
 * What is shown is the value in force, except while a person drags or types, or a request is unanswered: then it is
 * the person's. One request is under way at a time; of those that wait for it only the newest is sent.
 */
export class Edit {
  /** Why the last request was refused; empty when it was not. */
  refusal = '';
  private force: Value | null = null;
  private own: Value | undefined;
  private next: Value | undefined;
  private hands = false;
  private busy = false;
  private sentAt = Number.NEGATIVE_INFINITY;
  private timer: ReturnType<typeof setTimeout> | undefined;
  /** Rises when requests that are under way no longer matter. */
  private generation = 0;

  constructor(
    private readonly send: (value: Value) => Promise<Outcome>,
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
    return this.busy || this.next !== undefined;
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
    this.next = value;
    this.launch();
    this.changed();
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
    if (this.timer !== undefined) clearTimeout(this.timer);
    this.timer = undefined;
    this.generation += 1;
    this.hands = false;
    this.busy = false;
    this.next = undefined;
    this.own = undefined;
    this.changed();
  }

  /** A request of another kind with the same answer: a reset to the default. */
  perform(request: () => Promise<Outcome>): void {
    this.cancel();
    this.refusal = '';
    void this.run(request);
  }

  private launch(): void {
    if (this.busy || this.timer !== undefined || this.next === undefined) return;
    const wait = this.hands ? this.sentAt + spacing_ms - performance.now() : 0;
    if (wait > 0) {
      this.timer = setTimeout(() => {
        this.timer = undefined;
        this.launch();
      }, wait);
      return;
    }
    const value = this.next;
    this.next = undefined;
    this.sentAt = performance.now();
    void this.run(() => this.send(value), value);
  }

  private async run(request: () => Promise<Outcome>, value?: Value): Promise<void> {
    const generation = this.generation;
    this.busy = true;
    this.changed();
    let outcome: Outcome;
    try {
      outcome = await request();
    } catch (failure) {
      outcome = { ok: false, detail: failure instanceof Error ? failure.message : String(failure) };
    }
    if (generation !== this.generation) return;
    this.busy = false;
    if (outcome.ok) {
      const answered = valueAt(outcome.values, this.path());
      if (answered !== undefined) this.force = answered;
      else if (value !== undefined) this.force = value;
    } else if (this.next === undefined) {
      this.refusal = outcome.detail;
    }
    this.launch();
    if (!this.pending && !this.hands) this.own = undefined;
    this.changed();
  }
}

/** The value of "limits.low" or "gains[2]" in an answer that has it so, or has the whole of "limits" or "gains". */
export function valueAt(values: { readonly [path: string]: Value } | undefined, path: string | undefined): Value | undefined {
  if (values === undefined || path === undefined) return undefined;
  if (path in values) return values[path];
  let value: Value | undefined;
  path.split(/[.[\]]+/).forEach((step, depth) => {
    if (step === '') return;
    if (depth === 0) value = values[step];
    else if (Array.isArray(value)) value = value[Number(step)];
    else if (typeof value === 'object') value = value[step];
    else value = undefined;
  });
  return value;
}
