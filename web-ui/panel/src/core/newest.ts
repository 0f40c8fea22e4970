// One at a time, the newest next: for values that come faster than the other end takes them, as from a hand that drags.
import type { SetOptions } from '../contract';

/** What is to be done while another is under way waits for its end; of those that wait only the newest is done, and the last is never lost. */
export class Newest<Result> {
  /** Resolves at its end, however that came about. */
  #underWay: Promise<void> | undefined;
  #begunAt = -Infinity;
  #waiting: { readonly act: () => Promise<Result>; readonly options: SetOptions } | undefined;
  #later: Promise<Result> | undefined;

  /** `withdrawn`: what comes of one that was withdrawn while it waited. */
  constructor(private readonly withdrawn: Result) {}

  /** Those that wait get the result of the newest. */
  run(act: () => Promise<Result>, options: SetOptions = {}): Promise<Result> {
    if (this.#underWay || this.#later || this.#early(options) > 0) {
      this.#waiting = { act, options };
      return (this.#later ??= this.#runLater());
    }
    this.#begunAt = performance.now();
    const result = act();
    const over = (): void => { this.#underWay = undefined; };
    this.#underWay = result.then(over, over);
    return result;
  }

  /** ms until it may begin. */
  #early({ spacing = 0 }: SetOptions): number {
    return this.#begunAt + spacing - performance.now();
  }

  async #runLater(): Promise<Result> {
    await this.#underWay;
    for (let early; (early = this.#early(this.#waiting!.options)) > 0;) await new Promise((resolve) => setTimeout(resolve, early));
    const { act, options } = this.#waiting!;
    this.#waiting = this.#later = undefined;
    return options.signal?.aborted ? this.withdrawn : this.run(act, options);
  }
}
