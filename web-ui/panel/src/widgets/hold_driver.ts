// From a finger or key on an element to a hold, and to its end, whatever ends it.
import type { Hold } from '../contract';
import { listen } from '../core/listen';
import { textOfError } from '../core/reasons';
import { setAttribute } from './live_text';

/** asked: pressed, and no lease yet. held: the lease lives. */
export type HoldPhase = 'idle' | 'asked' | 'held';

/** A finger that rolls a little at the edge still holds, px. */
const slack = 8;

/** On the button, for the eye and for screen readers. */
export function showPhase(button: Element, phase: HoldPhase): void {
  setAttribute(button, 'data-phase', phase);
  setAttribute(button, 'aria-pressed', String(phase === 'held'));
}

export class HoldDriver {
  private current: HoldPhase = 'idle';
  private hold: Hold | undefined;
  /** Rises with every beginning and end: an answer to an older one comes too late. */
  private attempt = 0;
  private pointer: number | undefined;
  private key: string | undefined;
  private endings: (() => void)[] = [];

  constructor(
    private readonly begin: () => Promise<Hold>,
    /** `reason`: why it ended other than by the person's hand; empty otherwise. */
    private readonly changed: (phase: HoldPhase, reason: string) => void,
  ) {}

  get phase(): HoldPhase {
    return this.current;
  }

  /** Listens to an element; the returned function ends the hold and the listening. */
  attach(element: HTMLElement, mayBegin: () => boolean): () => void {
    const on = (target: EventTarget, name: string, listener: (event: never) => void): void => {
      this.endings.push(listen(target, name, listener));
    };
    on(element, 'pointerdown', (event: PointerEvent) => {
      if (event.button !== 0 || !event.isPrimary || this.current !== 'idle' || !mayBegin()) return;
      this.pointer = event.pointerId;
      try {
        element.setPointerCapture(event.pointerId);
      } catch {
        // The finger is gone already: its pointerup is heard at the window, as every one is.
      }
      this.press();
    });
    const lift = (event: PointerEvent): void => {
      if (event.pointerId === this.pointer) this.release();
    };
    // Who slides off has let go, though the captured pointer is still down.
    on(element, 'pointermove', (event: PointerEvent) => {
      if (event.pointerId !== this.pointer) return;
      const { left, top, right, bottom } = element.getBoundingClientRect();
      const { clientX: x, clientY: y } = event;
      if (x < left - slack || x > right + slack || y < top - slack || y > bottom + slack) this.release();
    });
    on(element, 'lostpointercapture', lift);
    on(window, 'pointerup', lift);
    on(window, 'pointercancel', lift);

    on(element, 'keydown', (event: KeyboardEvent) => {
      if (event.key !== ' ' && event.key !== 'Enter') return;
      event.preventDefault();
      if (event.repeat || this.current !== 'idle' || !mayBegin()) return;
      this.key = event.key;
      this.press();
    });
    on(window, 'keyup', (event: KeyboardEvent) => {
      if (event.key === this.key) this.release();
    });

    on(element, 'blur', () => this.release());
    on(window, 'blur', () => this.release());
    on(window, 'pagehide', () => this.release());
    on(document, 'visibilitychange', () => document.hidden && this.release());
    // A long touch opens a menu, and then the finger's end is never heard.
    on(element, 'contextmenu', (event: Event) => event.preventDefault());
    return () => {
      this.release();
      this.endings.splice(0).forEach((end) => end());
    };
  }

  /** By the person's hand, or because the page wants it. */
  release(): void {
    if (this.current === 'idle') return;
    this.end('');
  }

  private press(): void {
    this.attempt += 1;
    this.current = 'asked';
    this.changed('asked', '');
    void this.run(this.attempt);
  }

  private async run(attempt: number): Promise<void> {
    let hold: Hold;
    try {
      hold = await this.begin();
    } catch (failure) {
      if (attempt === this.attempt) this.end(textOfError(failure));
      return;
    }
    if (attempt !== this.attempt) {
      hold.release(); // let go before it had begun
      return;
    }
    this.hold = hold;
    this.current = 'held';
    this.changed('held', '');
    const reason = await hold.over;
    if (attempt === this.attempt) this.end(reason);
  }

  private end(reason: string): void {
    this.attempt += 1;
    const hold = this.hold;
    this.hold = undefined;
    this.pointer = this.key = undefined;
    this.current = 'idle';
    hold?.release();
    this.changed('idle', reason);
  }
}
