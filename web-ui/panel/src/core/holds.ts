// Hold parameters: a lease that lives while a person presses. The server ends what is not refreshed; this file makes sure
// that nothing is refreshed which nobody presses.
//
// The widget calls release() on pointerup, pointercancel, lostpointercapture and loss of focus. What no widget sees ends
// all holds here: the window without focus, a hidden or frozen page, a lost link, a lost control token, Stop motion.
import type { Hold } from '../contract';
import { linkLost, type Connection } from './connection';
import { listen } from './listen';
import { textOf } from './reasons';

export const refreshPeriod = 100;
const askingTimeout = 1000;

type Link = Pick<Connection, 'request' | 'send' | 'nextId' | 'listen'>;

interface Lease {
  end(reason: string): void;
}

export class Holds {
  #leases = new Set<Lease>();
  /** Rises with each endAll(): what was asked for before is not wanted any longer. */
  #ended = 0;
  #lastReason = '';

  constructor(private readonly link: Link) {}

  /** Ends all holds on what happens to the window. Undone by the returned function. */
  guard(page: Window): () => void {
    const leave = (): void => this.endAll('the page was left');
    const ends = [
      listen(page, 'blur', () => this.endAll('the window lost the focus')),
      listen(page, 'pagehide', leave),
      listen(page, 'pointercancel', () => this.endAll('the touch was cancelled'), true),
      listen(page.document, 'visibilitychange', () => {
        if (page.document.visibilityState === 'hidden') this.endAll('the page is hidden');
      }),
      listen(page.document, 'freeze', leave),
    ];
    return () => ends.forEach((end) => end());
  }

  get alive(): number { return this.#leases.size; }

  /** Rejects with the cause when there is no lease to be had. */
  async begin(component: string, parameter: string): Promise<Hold> {
    const before = this.#ended;
    const answer = await this.link.request<{ lease: string }>('hold', { component, parameter }, askingTimeout);
    if (!answer.ok) throw new Error(textOf(answer.problem));
    if (before === this.#ended) return this.#keep(answer.lease);
    this.link.send({ op: 'release', id: this.link.nextId(), lease: answer.lease });
    throw new Error(this.#lastReason);
  }

  endAll(reason: string): void {
    this.#ended += 1;
    this.#lastReason = reason;
    for (const lease of [...this.#leases]) lease.end(reason);
  }

  #keep(lease: string): Hold {
    let over = (_reason: string): void => undefined;
    const ended = new Promise<string>((resolve) => { over = resolve; });
    const id = this.link.nextId();
    const refresh = (): void => {
      if (!this.link.send({ op: 'refresh', id, lease })) finish('the link is lost');
    };
    const timer = setInterval(refresh, refreshPeriod);
    const finish = (reason: string): void => {
      if (!this.#leases.delete(entry)) return;
      clearInterval(timer);
      forget();
      over(reason);
    };
    const forget = this.link.listen(id, (answer) => {
      if (!answer.ok) finish(answer.problem === linkLost ? 'the link is lost' : textOf(answer.problem));
    });
    const release = (reason: string): void => {
      if (this.#leases.has(entry)) this.link.send({ op: 'release', id: this.link.nextId(), lease });
      finish(reason);
    };
    const entry: Lease = { end: release };
    this.#leases.add(entry);
    refresh();
    return { release: () => release('released'), over: ended };
  }
}
