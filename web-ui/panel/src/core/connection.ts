// The WebSocket: connects, comes back after a loss, answers, and notices silence. Knows nothing of what is said.
import type { LinkStatus } from './core';
import { decodeFrame, type Frame } from './decode';
import type { Answer, Hello, Problem, ServerEvent } from './protocol';

export const pingPeriod = 250;
export const staleAfter = 1000;
/** After this silence of the server, ms, the page connects anew. The server has closed the connection by then (after 3 s), which TCP may not tell. */
export const hopelessAfter = 4000;
const connectWithin = 5000; // ms
const tickPeriod = 100; // ms
const longestBackoff = 2000;
const requestTimeout = 10_000;

/** What of a WebSocket is used. */
export interface Socket {
  binaryType: BinaryType;
  readonly readyState: number;
  onopen: ((event: Event) => void) | null;
  onmessage: ((event: MessageEvent) => void) | null;
  onclose: ((event: CloseEvent) => void) | null;
  onerror: ((event: Event) => void) | null;
  send(text: string): void;
  close(code?: number): void;
}

export interface ConnectionOptions {
  readonly makeSocket: () => Socket;
  /** ms, monotonic. */
  readonly now?: () => number;
  /** 0..1, spreads what reconnects. */
  readonly random?: () => number;
  readonly onHello: (hello: Hello) => void;
  readonly onEvent: (event: Exclude<ServerEvent, Hello>) => void;
  readonly onFrame: (frame: Frame) => void;
  /** Phase, staleness or round trip changed. */
  readonly onStatus: () => void;
  /** A connection could not be made or was lost; the answer becomes the status' detail. */
  readonly explain?: () => Promise<string>;
}

type Listener = (answer: Answer) => void;

export const linkLost: Problem = { title: 'No connection', detail: 'The link to the application is lost; it was not done, or its answer did not arrive.' };

export class Connection {
  #socket: Socket | undefined;
  #phase: LinkStatus['phase'] = 'waiting';
  #detail = '';
  #stale = true;
  #roundTrip: number | undefined;
  #lastHeard = -Infinity;
  #lastPing = -Infinity;
  #lastTick = -Infinity;
  #began = 0;
  #failures = 0;
  #lastId = 0;
  #listeners = new Map<number, Listener>();
  #ticking: ReturnType<typeof setInterval> | undefined;
  #retry: ReturnType<typeof setTimeout> | undefined;
  #serverTime = 0;
  #serverTimeAt = 0;
  readonly #now: () => number;
  readonly #random: () => number;

  constructor(private readonly options: ConnectionOptions) {
    this.#now = options.now ?? (() => performance.now());
    this.#random = options.random ?? Math.random;
  }

  start(): void {
    if (this.#ticking !== undefined) return;
    this.#ticking = setInterval(() => this.#tick(), tickPeriod);
    this.#connect();
  }

  stop(): void {
    clearInterval(this.#ticking);
    clearTimeout(this.#retry);
    this.#ticking = undefined;
    this.#drop('', false);
  }

  /** Ends this connection and makes another at once: the session's role has changed. */
  restart(): void {
    clearTimeout(this.#retry);
    this.#drop('', false);
    this.#failures = 0;
    this.#connect();
  }

  /** Ends this connection, and makes another after a while: what came with it is of no use. */
  retry(detail: string): void {
    this.#drop(detail, true);
  }

  get status(): LinkStatus {
    return {
      phase: this.#phase, stale: this.#stale, roundTrip: this.#roundTrip, detail: this.#detail,
      silence: this.#now() - this.#lastHeard,
    };
  }

  /** The application's clock now, ns; 0 before it is known. */
  serverNow(): number {
    return this.#serverTime === 0 ? 0 : this.#serverTime + (this.#now() - this.#serverTimeAt) * 1e6;
  }

  nextId(): number {
    this.#lastId += 1;
    return this.#lastId;
  }

  /** Every answer to `id`, until the returned function is called or the link is lost (then a problem, once). */
  listen(id: number, listener: Listener): () => void {
    this.#listeners.set(id, listener);
    return () => this.#listeners.delete(id);
  }

  /** Whether it was given to an open socket. */
  send(message: { readonly op: string; readonly id: number; readonly [field: string]: unknown }): boolean {
    const socket = this.#openSocket;
    socket?.send(JSON.stringify(message));
    return socket !== undefined;
  }

  get #openSocket(): Socket | undefined {
    return this.#phase === 'open' && this.#socket?.readyState === 1 ? this.#socket : undefined;
  }

  request<Fields = object>(op: string, fields: object = {}, timeoutMs = requestTimeout): Promise<Answer<Fields>> {
    const id = this.nextId();
    return new Promise((resolve) => {
      const finish = (answer: Answer): void => {
        clearTimeout(timer);
        this.#listeners.delete(id);
        resolve(answer as Answer<Fields>);
      };
      const timer = setTimeout(() => finish({
        id, ok: false,
        problem: { title: 'No answer', detail: `The application did not answer "${op}" within ${timeoutMs / 1000} s.` },
      }), timeoutMs);
      this.#listeners.set(id, finish);
      const socket = this.#openSocket;
      if (socket) socket.send(JSON.stringify({ ...fields, op, id }));
      else finish({ id, ok: false, problem: linkLost });
    });
  }

  #connect(): void {
    this.#phase = 'connecting';
    this.#began = this.#now();
    this.options.onStatus();
    let socket: Socket;
    try {
      socket = this.options.makeSocket();
    } catch (error) {
      this.#drop(String(error), true);
      return;
    }
    this.#socket = socket;
    socket.binaryType = 'arraybuffer';
    socket.onmessage = (event) => {
      if (socket === this.#socket) this.#hear(event.data);
    };
    socket.onclose = (event) => {
      if (socket === this.#socket) this.#drop(event.reason, true);
    };
  }

  #hear(data: unknown): void {
    const now = this.#now();
    this.#lastHeard = now;
    if (typeof data === 'string') this.#hearText(data);
    else if (data instanceof ArrayBuffer) this.#hearFrame(data, now);
    if (this.#phase !== 'open') return;
    this.#setStale(false);
    this.#ping(now); // here too: timers of a hidden page are slow, its messages are not
  }

  #hearText(text: string): void {
    let message: unknown;
    try {
      message = JSON.parse(text);
    } catch {
      return this.#drop('The server said something that is no JSON.', true);
    }
    if (typeof message !== 'object' || message === null) return;
    if ('event' in message) {
      const event = message as ServerEvent;
      if (event.event !== 'hello') return this.options.onEvent(event);
      if (event.protocol !== 1) return this.#drop(`The server speaks version ${event.protocol} of the protocol, this page 1: load the page again.`, true);
      this.#phase = 'open';
      this.#detail = '';
      this.#failures = 0;
      this.#setServerTime(event.server_time_ns, this.#now());
      this.#setStale(false);
      this.options.onHello(event);
      this.options.onStatus();
    } else if ('id' in message && typeof message.id === 'number') {
      this.#listeners.get(message.id)?.(message as Answer);
    }
  }

  #hearFrame(buffer: ArrayBuffer, now: number): void {
    const frame = decodeFrame(buffer);
    if (!frame) return this.#drop('A frame of values was malformed.', true);
    this.#setServerTime(frame.serverTime, now);
    this.options.onFrame(frame);
  }

  #setServerTime(time: number, now: number): void {
    this.#serverTime = time;
    this.#serverTimeAt = now;
  }

  #tick(): void {
    const now = this.#now();
    // After a pause of the browser's own, what was said meanwhile waits behind this tick.
    const wasAway = now - this.#lastTick > 5 * tickPeriod;
    this.#lastTick = now;
    if (this.#phase === 'connecting') {
      if (wasAway) return;
      if (now - this.#began > connectWithin) this.#drop('The server does not answer.', true);
    } else if (this.#phase === 'open') {
      const silence = now - this.#lastHeard;
      if (silence > hopelessAfter && !wasAway) return this.#drop('The server fell silent.', true);
      if (silence > staleAfter) this.#setStale(true);
      this.#ping(now);
    }
  }

  #ping(now: number): void {
    if (now - this.#lastPing < pingPeriod) return;
    this.#lastPing = now;
    const id = this.nextId();
    const forget = this.listen(id, (answer) => {
      forget();
      if (!answer.ok) return;
      this.#roundTrip = this.#now() - now;
      this.options.onStatus();
    });
    if (!this.send({ op: 'ping', id, sent: now })) forget();
  }

  #setStale(stale: boolean): void {
    if (stale === this.#stale) return;
    this.#stale = stale;
    this.options.onStatus();
  }

  /** The link is gone: whoever waits for an answer is told, and unless it is over, another try follows. */
  #drop(detail: string, again: boolean): void {
    const socket = this.#socket;
    const wasOpen = this.#phase === 'open';
    this.#socket = undefined;
    if (socket) {
      socket.onmessage = socket.onclose = null;
      if (socket.readyState <= 1) socket.close();
    }
    this.#phase = 'waiting';
    // Of a try that failed once more what was explained last holds until it is explained anew: who reads it, or logs in
    // because of it, sees nothing come and go.
    if (wasOpen || !again || detail !== '') this.#detail = detail;
    this.#stale = true;
    this.#roundTrip = undefined;
    this.#lastPing = -Infinity;
    const waiting = [...this.#listeners];
    this.#listeners.clear();
    for (const [id, listener] of waiting) listener({ id, ok: false, problem: linkLost });
    this.options.onStatus();
    if (!again) return;
    const delay = Math.min(longestBackoff, 250 * 2 ** this.#failures) * (0.8 + 0.4 * this.#random());
    this.#failures += 1;
    clearTimeout(this.#retry);
    this.#retry = setTimeout(() => this.#connect(), delay);
    if (!wasOpen) void this.#explain(detail);
  }

  /** `reason`: what the lost connection itself said. */
  async #explain(reason: string): Promise<void> {
    const detail = (await this.options.explain?.()) || reason;
    if (this.#phase === 'open') return;
    this.#detail = detail;
    this.options.onStatus();
  }
}
