// A button that takes the place of another is dead for a moment: who presses twice means the first one only.
import type { ReactiveController, ReactiveControllerHost } from 'lit';

const settling = 1000; // ms

export class Settled implements ReactiveController {
  readonly #host: ReactiveControllerHost;
  #shown: string | undefined;
  #settled = true;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(host: ReactiveControllerHost) {
    this.#host = host;
    host.addController(this);
  }
  hostConnected(): void {}
  hostDisconnected(): void {
    clearTimeout(this.#timer);
  }

  /** In render(): whether the button at this place has had this meaning for long enough to be meant. */
  is(meaning: string): boolean {
    if (meaning !== this.#shown) {
      if (this.#shown !== undefined) {
        this.#settled = false;
        clearTimeout(this.#timer);
        this.#timer = setTimeout(() => {
          this.#settled = true;
          this.#host.requestUpdate();
        }, settling);
      }
      this.#shown = meaning;
    }
    return this.#settled;
  }
}
