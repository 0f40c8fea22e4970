// Age of a slot's value, or why it is NULL, as it goes on; written into one Text node.
import type { Reading, WidgetHost } from '../contract';
import { LiveText, setAttribute } from '../widgets/live_text';
import { absence } from '../widgets/value_text';
import { ageText } from './durations';

/** ms within which the next value comes, of a slot that is published often enough: until then none is missing. */
const next_is_due = 600;

/** How old a value is by now, s: its age when it came, and, when no other followed, the time since then. */
export function ageNow(reading: Reading, receivedAt: number, now: number): number {
  const since = now - receivedAt;
  return Math.max(0, reading.age + (since < next_is_due ? 0 : since / 1000));
}

export class SlotAge extends HTMLElement {
  host!: WidgetHost;
  slotName = '';
  private ends: (() => void)[] = [];
  private text: LiveText | undefined;
  private reading: Reading | undefined;
  private receivedAt = 0;

  connectedCallback(): void {
    this.text ??= new LiveText(this);
    const timer = setInterval(() => this.show(), 500);
    this.ends = [
      () => clearInterval(timer),
      this.host.watchAccess(() => this.show()),
      this.host.watch(
        `slot:${this.slotName}`,
        (reading) => {
          this.reading = reading;
          this.receivedAt = performance.now();
          this.show();
        },
        { rate: 4, width: 64 },
      ),
    ];
    this.show();
  }

  disconnectedCallback(): void {
    this.ends.forEach((end) => end());
    this.ends = [];
  }

  private show(): void {
    const { reading } = this;
    const missing = reading ? absence(reading) : '';
    if (reading === undefined) this.text!.text = 'nothing yet';
    else if (missing !== '') this.text!.text = `NULL: ${missing}`;
    else this.text!.text = ageText(ageNow(reading, this.receivedAt, performance.now()));
    setAttribute(this, 'class', this.host.stale ? 'stale' : missing !== '' ? 'alarm' : '');
  }
}

customElements.define('flexrf-slot-age', SlotAge);
