// One at a time, the newest next: for values that come faster than the other end takes them, as from a hand that drags.

/**
 * What is put while another is under way waits for its end; of those that wait only the newest is begun, and the last is
 * never lost. Each put is another object.
 */
export class Newest<Wanted extends object> {
  #underWay: Wanted | undefined;
  #waiting: Wanted | undefined;
  #begunAt = -Infinity;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(
    /** Calls `done` when it is over: that begins what waits. False: it was cancelled meanwhile. */
    private readonly begin: (wanted: Wanted, done: () => boolean) => void,
    /** ms that lie between two beginnings at least, as it is when one is to begin. */
    private readonly spacing: () => number = () => 0,
  ) {}

  /** Not begun yet: the next `put` takes its place. */
  get waiting(): Wanted | undefined {
    return this.#waiting;
  }
  /** One is under way, or waits. */
  get pending(): boolean {
    return (this.#underWay ?? this.#waiting) !== undefined;
  }

  put(wanted: Wanted): void {
    this.#waiting = wanted;
    this.#beginNext();
  }

  /** Nothing waits any longer, and nobody waits for what is under way: the next begins at once. */
  cancel(): void {
    clearTimeout(this.#timer);
    this.#timer = this.#underWay = this.#waiting = undefined;
  }

  #beginNext(): void {
    const wanted = this.#waiting;
    if (this.#underWay || this.#timer || !wanted) return;
    const now = performance.now();
    const early = this.#begunAt + this.spacing() - now;
    if (early > 0) {
      this.#timer = setTimeout(() => {
        this.#timer = undefined;
        this.#beginNext();
      }, early);
      return;
    }
    this.#waiting = undefined;
    this.#underWay = wanted;
    this.#begunAt = now;
    this.begin(wanted, () => {
      if (this.#underWay !== wanted) return false;
      this.#underWay = undefined;
      this.#beginNext();
      return true;
    });
  }
}
