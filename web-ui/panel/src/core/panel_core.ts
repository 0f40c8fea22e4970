// The core put together: connection, model, values, access; what shell, views and widgets stand on.
import type { ItemInfo, Placement, Role, WidgetElement } from '../contract';
import { deniedAction, deniedLink, deniedRole, hasControl, locked, nameOf, type Situation } from './access';
import { ConfigurationValues } from './configuration';
import { Connection, type Socket } from './connection';
import type { Core, LinkStatus, PasswordQuestion } from './core';
import { makeModel, type Model } from './descriptor';
import type { DescriptorJson } from './descriptor_json';
import { Holds } from './holds';
import { Host } from './host';
import { getJson } from './http';
import { inNextFrame } from './next_frame';
import type { Answer, ApplicationState, Drivers, Hello, LogLine, ServerEvent, SessionInfo, TopicName, Values } from './protocol';
import { textOfError } from './reasons';
import { Registry, type BuiltInWidgets } from './registry';
import { Store } from './store';
import { Subscriptions } from './subscriptions';
import { displayUnits } from './units';
import { added } from './watchers';

const linesKept = 2000;

export type Severity = 'info' | 'warning' | 'alarm';

export interface PanelCoreOptions {
  readonly makeSocket?: () => Socket;
  readonly loadBuiltIn: () => Promise<BuiltInWidgets>;
  /** Stands where a widget belongs that could not be had: says why, and offers a second try. */
  readonly makeMissing: (text: string, again: () => Promise<unknown>) => HTMLElement;
  /** Another descriptor than before or other drivers, or the first. */
  readonly onModel: (model: Model) => void;
  readonly onNotice: (text: string, severity: Severity) => void;
  /** Somebody has to be asked for his password. */
  readonly onPasswordWanted?: (question: PasswordQuestion) => void;
  /** The application said that it ends. */
  readonly onEnded?: (text: string) => void;
}

export class PanelCore implements Core {
  readonly units = displayUnits;
  readonly host: Host;
  readonly connection: Connection;
  readonly registry: Registry;
  state: ApplicationState | undefined;
  session: SessionInfo | undefined;
  hasMachine = false;
  /** Why this session did not get control when it asked last; empty once it asks anew, or somebody else has it. */
  controlRefused = '';
  /** When `state` arrived, ms of performance.now(): its countdowns run from there. */
  stateAt = 0;
  #model: Model | undefined;
  #boot: string | number | undefined;
  #store: Store;
  #subscriptions: Subscriptions;
  #configuration: ConfigurationValues;
  #holds: Holds;
  #stateWatchers = new Set<() => void>();
  #accessWatchers = new Set<() => void>();
  #topics = new Map<string, { body: unknown; watchers: Set<(body: unknown) => void> }>();
  #log: LogLine[] = [];
  #logWatchers = new Set<(lines: readonly LogLine[]) => void>();
  #telling = false;
  #access = '';

  constructor(private readonly options: PanelCoreOptions) {
    this.connection = new Connection({
      makeSocket: options.makeSocket ?? openSocket,
      onHello: (hello) => void this.#onHello(hello),
      onEvent: (event) => this.#onEvent(event),
      onFrame: (frame) => void this.#store.apply(frame),
      onStatus: () => this.#changed(),
      explain: explainRefusal,
    });
    this.registry = new Registry(options.loadBuiltIn);
    this.#store = new Store({ serverNow: () => this.connection.serverNow() });
    this.#subscriptions = new Subscriptions({
      request: (op, fields) => this.connection.request(op, fields),
      onSlotGone: (name) => {
        const slot = this.#model?.slotsByName.get(name);
        if (slot) this.#store.forgetSlot(slot.index);
      },
      onProblem: (text) => options.onNotice(text, 'warning'),
    });
    this.#configuration = new ConfigurationValues(fetchConfiguration);
    this.#holds = new Holds(this.connection);
    this.host = new Host({
      item: (key) => this.#model?.item(key),
      joints: (device) => this.#model?.joints(device) ?? [],
      units: () => this.#model?.json.units ?? [],
      watchList: (name, callback, rate) => this.watchTopic(name, callback, rate),
      store: this.#store,
      subscriptions: this.#subscriptions,
      configuration: this.#configuration,
      holds: this.#holds,
      request: (op, fields) => this.connection.request(op, fields),
      locked: (item) => locked(this.situation, item),
      stale: () => this.connection.status.stale,
      watchAccess: (callback) => added(this.#accessWatchers, callback),
    });
  }

  start(): void {
    this.#holds.guard(window);
    this.connection.start();
  }

  get model(): Model {
    if (!this.#model) throw new Error('no descriptor yet');
    return this.#model;
  }
  /** The application's name, as soon as it is known. */
  application = '';
  get link(): LinkStatus { return this.connection.status; }
  get situation(): Situation {
    return { link: this.connection.status, session: this.session, state: this.state };
  }

  endHolds(reason: string): void {
    this.#holds.endAll(reason);
  }

  deniedAction(role: Role): string {
    return deniedAction(this.situation, role);
  }

  deniedRole(role: Role): string {
    return deniedRole(this.situation, role);
  }

  askPassword(question: PasswordQuestion): void {
    this.options.onPasswordWanted?.(question);
  }

  request<Fields = object>(op: string, fields?: object, timeoutMs?: number): Promise<Answer<Fields>> {
    return this.connection.request<Fields>(op, fields, timeoutMs);
  }

  notify(text: string, severity: Severity = 'info'): void {
    this.options.onNotice(text, severity);
  }

  watchState(callback: () => void): () => void {
    return added(this.#stateWatchers, callback);
  }

  watchTopic(name: Exclude<TopicName, 'log'>, callback: (body: unknown) => void, rate = 2): () => void {
    const topic = this.#topics.get(name) ?? { body: undefined, watchers: new Set() };
    this.#topics.set(name, topic);
    topic.watchers.add(callback);
    if (topic.body !== undefined) callback(topic.body);
    const unsubscribe = this.#subscriptions.addTopic(name, rate);
    return () => {
      topic.watchers.delete(callback);
      if (topic.watchers.size === 0) topic.body = undefined;
      unsubscribe();
    };
  }

  watchLog(callback: (lines: readonly LogLine[]) => void): () => void {
    const forget = added(this.#logWatchers, callback);
    if (this.#log.length > 0) callback(this.#log);
    const unsubscribe = this.#subscriptions.addTopic('log', 10);
    return () => {
      forget();
      unsubscribe();
    };
  }

  async createWidget(what: { item: ItemInfo } | { placement: Placement }): Promise<WidgetElement> {
    try {
      return await this.#makeWidget(what);
    } catch (error) {
      const name = 'item' in what ? what.item.label : what.placement.label;
      const missing: WidgetElement = Object.assign(
        this.options.makeMissing(`${name} cannot be shown: ${textOfError(error)}`, async () => {
          const made = await this.createWidget(what);
          made.host = missing.host; // whoever asked for it may have put another there
          missing.replaceWith(made);
        }),
        { host: this.host }, what,
      );
      return missing;
    }
  }

  /** Rejects when there is none, and no other for the item either. */
  async #makeWidget(what: { item: ItemInfo } | { placement: Placement }): Promise<WidgetElement> {
    try {
      const kind = 'item' in what
        ? await this.registry.kindFor(what.item)
        : await this.registry.kindForRow(this.host, what.placement);
      const controls = 'item' in what
        ? what.item.role !== undefined || what.item.widget !== undefined
        : Object.keys(what.placement.parameters).length > 0;
      const element = await this.registry.create(kind, controls);
      return Object.assign(element, { host: this.host }, what);
    } catch (error) {
      if (!('item' in what) || what.item.widget === undefined) throw error;
      const { widget, ...usual } = what.item;
      const note = `The widget “${widget}” cannot be shown: ${textOfError(error)}`;
      return Object.assign(await this.#makeWidget({ item: usual }), { note });
    }
  }

  async #onHello(hello: Hello): Promise<void> {
    this.session = hello.session;
    this.application = hello.application;
    this.hasMachine = hello.machine === true;
    const restarted = this.#boot !== undefined && this.#boot !== hello.boot;
    this.#boot = hello.boot;
    this.state = undefined;
    this.#store.beginLink(hello.null_reasons);
    if (restarted) {
      this.#log = [];
      this.host.history.clear();
    }
    if (this.#model?.hash !== hello.descriptor || !sameDrivers(this.#model.drivers, hello.drivers)) {
      const json = await getJson<DescriptorJson>('/api/v1/descriptor');
      if (!json.ok) {
        return this.connection.retry(`The application's description could not be loaded: ${json.detail}`);
      }
      this.#model = makeModel(json.body, hello.drivers);
      this.#store.reset(this.#model);
      this.options.onModel(this.#model);
    }
    if (restarted) this.options.onNotice('The application was started anew.', 'info');
    this.#subscriptions.resubscribe();
    this.#configuration.refresh();
    this.#changed();
  }

  #onEvent(event: Exclude<ServerEvent, Hello>): void {
    switch (event.event) {
      case 'state': {
        const edited = this.state?.edit != null && event.edit === null;
        this.#noteRefusal(this.state?.control, event.control);
        this.state = event;
        this.stateAt = performance.now();
        if (edited) this.#configuration.refresh();
        this.#changed();
        break;
      }
      case 'topic': {
        const topic = this.#topics.get(event.name);
        if (!topic) break;
        topic.body = event.body;
        topic.watchers.forEach((watcher) => watcher(event.body));
        break;
      }
      case 'log': {
        const last = this.#log.at(-1)?.number ?? -1;
        const fresh = event.lines.filter((line) => line.number > last);
        this.#log = [...this.#log, ...fresh].slice(-linesKept);
        this.#logWatchers.forEach((watcher) => watcher(fresh));
        break;
      }
      case 'session':
        this.session = event.session;
        this.#changed();
        break;
      case 'ended':
        if (this.state) this.state = { ...this.state, mode: 'ended' };
        this.options.onEnded?.(event.text);
        this.#changed();
        break;
    }
  }

  /** A question that is over, and control still somebody else's. */
  #noteRefusal(before: ApplicationState['control'] | undefined, now: ApplicationState['control']): void {
    if (now.wanted_by?.you || now.holder?.name !== before?.holder?.name) this.controlRefused = '';
    if (!before?.wanted_by?.you || now.wanted_by?.you || !now.holder || now.holder.you) return;
    const other = now.wanted_by;
    this.controlRefused = other ? `${nameOf(other)} asks instead` : `${nameOf(now.holder)} keeps control`;
    this.options.onNotice(`You did not get control: ${this.controlRefused}.`, 'warning');
  }

  /** Holds end at once; who watches is told in the next frame. */
  #changed(): void {
    if (this.link.phase !== 'open' && this.link.detail === 'login') this.session = undefined; // logged out, or too long away
    const lost = deniedLink(this) !== '' ? 'the link is lost'
      : this.state && !hasControl(this.situation) ? 'control was lost'
      : this.state?.motion.stopped ? 'motion is stopped' : '';
    if (lost !== '' && this.#holds.alive > 0) this.#holds.endAll(lost);
    if (this.#telling) return;
    this.#telling = true;
    inNextFrame(() => {
      this.#telling = false;
      this.#stateWatchers.forEach((watcher) => watcher());
      const access = JSON.stringify([this.link.phase, this.link.stale, this.session?.role, this.state?.control, this.state?.motion, this.state?.mode]);
      if (access === this.#access) return;
      this.#access = access;
      this.#accessWatchers.forEach((watcher) => watcher());
    });
  }
}

/** The tables are the same, so the devices are. */
function sameDrivers(before: Drivers, now: Drivers): boolean {
  return Object.entries(now).every(([device, driver]) => before[device] === driver);
}

function openSocket(): Socket {
  const address = new URL('/api/v1/live', location.href);
  address.protocol = address.protocol.replace('http', 'ws');
  return new WebSocket(address, 'flexrf.v1');
}

/** A WebSocket that is refused does not say why; a request does. */
async function explainRefusal(): Promise<string> {
  const answer = await getJson('/api/v1/session');
  if (answer.ok) return '';
  return answer.status === 401 ? 'login' : answer.detail;
}

async function fetchConfiguration(component: string): Promise<Values | undefined> {
  const answer = await getJson<{ configuration: Values }>(`/api/v1/components/${encodeURIComponent(component)}/parameters`);
  return answer.ok ? answer.body.configuration : undefined;
}
