// What is shown is what is asked for: one `subscribe` for everything, at the highest rate that anybody wants of it.
import type { Answer } from './protocol';

export const longestMessage = 16_000; // bytes; the server takes 16 KiB
const highestRate = 60;
const highestTopicRate = 10;
const lowestRate = 0.01;
const widestImage = 4096;

interface Wish {
  readonly rate: number;
  readonly width: number;
}

export interface SubscriptionsOptions {
  readonly request: (op: string, fields: object) => Promise<Answer<{ unknown?: readonly string[] }>>;
  /** Nobody shows the slot any longer: what is known of it grows old unnoticed. */
  readonly onSlotGone: (slot: string) => void;
  /** Something that was asked for is not delivered, and why. */
  readonly onProblem: (text: string) => void;
}

export class Subscriptions {
  #slots = new Map<string, Set<Wish>>();
  #topics = new Map<string, Set<Wish>>();
  #timer: ReturnType<typeof setTimeout> | undefined;
  #sent = '';

  constructor(private readonly options: SubscriptionsOptions) {}

  /** `width` in pixels, of an image; 0 for others. Ends with the returned function. */
  addSlot(slot: string, rate: number, width = 0): () => void {
    const wish = { rate: within(rate, highestRate), width: Math.min(Math.ceil(width), widestImage) };
    return this.#add(this.#slots, slot, wish, this.options.onSlotGone);
  }

  addTopic(topic: string, rate: number): () => void {
    return this.#add(this.#topics, topic, { rate: within(rate, highestTopicRate), width: 0 });
  }

  /** A new connection knows of nothing. */
  resubscribe(): void {
    this.#sent = '';
    this.#send();
  }

  #add(wishes: Map<string, Set<Wish>>, name: string, wish: Wish, onGone?: (name: string) => void): () => void {
    const known = wishes.get(name) ?? new Set<Wish>();
    wishes.set(name, known.add(wish));
    this.#schedule();
    return () => {
      if (!known.delete(wish)) return;
      if (known.size === 0 && wishes.get(name) === known) {
        wishes.delete(name);
        onGone?.(name);
      }
      this.#schedule();
    };
  }

  /** A view that is drawn asks for many things at once. */
  #schedule(): void {
    this.#timer ??= setTimeout(() => this.#send(), 20);
  }

  #send(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    const slots = [...this.#slots].map(([name, wishes]) => {
      const width = highest(wishes, (wish) => wish.width);
      return { name, rate: highest(wishes, (wish) => wish.rate), ...(width > 0 && { width }) };
    });
    const topics = [...this.#topics].map(([name, wishes]) => ({ name, rate: highest(wishes, (wish) => wish.rate) }));
    let text = JSON.stringify({ slots, topics });
    const asked = slots.length;
    while (text.length > longestMessage && slots.length > 0) {
      slots.splice(Math.floor(slots.length * 0.9));
      text = JSON.stringify({ slots, topics });
    }
    if (text === this.#sent) return;
    this.#sent = text;
    if (slots.length < asked) this.options.onProblem(`Too much is shown at once: ${asked - slots.length} of ${asked} slots get no values.`);
    void this.options.request('subscribe', { slots, topics }).then((answer) => {
      if (answer.ok && answer.unknown?.length) this.options.onProblem(`The application does not know ${answer.unknown.join(', ')}.`);
    });
  }
}

function within(rate: number, most: number): number {
  return Math.min(Math.max(rate, lowestRate), most);
}

function highest(wishes: ReadonlySet<Wish>, of: (wish: Wish) => number): number {
  let most = 0;
  for (const wish of wishes) most = Math.max(most, of(wish));
  return most;
}
