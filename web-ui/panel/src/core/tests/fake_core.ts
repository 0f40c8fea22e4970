// A core without a server: the test says what is subscribed, in force and answered.
import type { ItemInfo, Placement, Reading, Value, WidgetElement, WidgetHost } from '../../contract';
import type { Core, LinkStatus, PanelHost, PasswordQuestion } from '../core';
import { makeModel } from '../descriptor';
import type { DescriptorJson } from '../descriptor_json';
import type { ApplicationState, Drivers, SessionInfo } from '../protocol';
import { History } from '../history';
import { DisplayUnits } from '../units';

/** Records what a widget was given. */
export class FakeWidget extends HTMLElement implements WidgetElement {
  host!: WidgetHost;
  item?: ItemInfo;
  placement?: Placement;
}
customElements.define('fake-widget', FakeWidget);

export function reading(value: Value | null, more: Partial<Reading> = {}): Reading {
  return { value, reason: '', sampledAt: 1, sequence: 1, age: 0, ...more };
}

export const quiet: ApplicationState = {
  mode: 'running', cause: '', motion: { stopped: true, may_move: false }, faults: [],
  values: { file: false, on: 'change', unsaved: false, saved_at_ms: null, writings: 0, failure: '' },
  control: { holder: null, wanted_by: null }, edit: null,
  server: { connections: 1, places: 8, loop_delay_us: { p99: 1, max: 2 } },
};

export class FakeCore {
  readonly watched = new Map<string, Set<(reading: Reading) => void>>();
  readonly topics = new Map<string, Set<(body: unknown) => void>>();
  readonly requests: { op: string; fields: object }[] = [];
  readonly said: string[] = [];
  readonly units = new DisplayUnits();
  readonly model;
  state: ApplicationState | undefined = quiet;
  denied = '';
  session: SessionInfo | undefined;
  /** Of deniedRole(). */
  roleDenied = '';
  readonly questions: PasswordQuestion[] = [];
  hasMachine = false;
  link: LinkStatus = { phase: 'open', stale: false, roundTrip: 1, silence: 0, detail: '' };
  answer: (op: string, fields: object) => object = () => ({ ok: true });
  private readonly states = new Set<() => void>();
  private readonly access = new Set<() => void>();

  readonly host: PanelHost = {
    history: new History(),
    resetAll: async (component, parameters) => {
      this.requests.push({ op: 'reset', fields: { component, parameters } });
      return { ok: true };
    },
    undo: async () => {
      this.requests.push({ op: 'undo', fields: {} });
      return { ok: true };
    },
    watch: (key, callback) => added(this.watched, key, callback),
    set: async () => ({ ok: true }),
    press: async () => ({ ok: true }),
    hold: async () => ({ release: () => undefined, over: new Promise(() => undefined) }),
    reset: async () => ({ ok: true }),
    item: (key) => this.model.item(key),
    joints: (device) => this.model.joints(device),
    units: [],
    watchList: (name, callback) => this.watchTopic(name, callback),
    locked: () => this.denied,
    watchAccess: (callback) => {
      this.access.add(callback);
      return () => this.access.delete(callback);
    },
    stale: false,
    file: async () => new Response('', { status: 404 }),
  };

  constructor(json: DescriptorJson, drivers: Drivers = {}) {
    this.model = makeModel(json, drivers);
  }

  get core(): Core {
    return this as unknown as Core;
  }

  watchState(callback: () => void): () => void {
    this.states.add(callback);
    return () => this.states.delete(callback);
  }
  watchTopic(name: string, callback: (body: unknown) => void): () => void {
    return added(this.topics, name, callback);
  }
  request(op: string, fields: object = {}): Promise<object> {
    this.requests.push({ op, fields });
    return Promise.resolve({ id: 1, ...this.answer(op, fields) });
  }
  deniedAction(): string {
    return this.denied;
  }
  deniedRole(): string {
    return this.roleDenied;
  }
  askPassword(question: PasswordQuestion): void {
    this.questions.push(question);
  }
  createWidget(what: { item: ItemInfo } | { placement: Placement }): Promise<WidgetElement> {
    return Promise.resolve(Object.assign(new FakeWidget(), { host: this.host }, what));
  }
  notify(text: string): void {
    this.said.push(text);
  }

  /** What comes from the server. */
  value(key: string, what: Reading): void {
    this.watched.get(key)?.forEach((callback) => callback(what));
  }
  topic(name: string, body: unknown): void {
    this.topics.get(name)?.forEach((callback) => callback(body));
  }
  says(state: Partial<ApplicationState>): void {
    this.state = { ...quiet, ...state };
    this.states.forEach((callback) => callback());
    this.access.forEach((callback) => callback());
  }
  /** Nothing was heard for too long, or something is heard again. */
  turns(stale: boolean): void {
    Object.assign(this.host, { stale });
    this.access.forEach((callback) => callback());
  }
  isWatched(key: string): boolean {
    return (this.watched.get(key)?.size ?? 0) > 0;
  }
}

function added<Callback>(all: Map<string, Set<Callback>>, key: string, callback: Callback): () => void {
  const callbacks = all.get(key) ?? new Set<Callback>();
  all.set(key, callbacks.add(callback));
  return () => callbacks.delete(callback);
}
