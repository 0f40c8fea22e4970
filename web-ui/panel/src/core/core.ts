// What the shell and the views may use beyond a widget's host.
import type { ItemInfo, Outcome, Placement, WidgetElement, WidgetHost } from '../contract';
import type { Model } from './descriptor';
import type { History } from './history';
import type { Answer, ApplicationState, LogLine, SessionInfo, TopicName } from './protocol';
import type { DisplayUnits } from './units';

export interface LinkStatus {
  readonly phase: 'connecting' | 'open' | 'waiting';
  /** More than 1 s without a word from the server. */
  readonly stale: boolean;
  /** Of the last ping, ms; undefined before the first. */
  readonly roundTrip: number | undefined;
  /** ms since the server was last heard; Infinity before. */
  readonly silence: number;
  /** Why there is no connection, for people; empty while there is one. */
  readonly detail: string;
}

/** The page's own host: beside what widgets need, changes of several parameters at once, and taking changes back. */
export interface PanelHost extends WidgetHost {
  readonly history: History;
  resetAll(component: string, parameters: readonly string[]): Promise<Outcome>;
  undo(): Promise<Outcome>;
}

/** Something that the PC does only for an admin's password. */
export interface PasswordQuestion {
  readonly heading: string;
  /** What will happen, a paragraph each. */
  readonly says: readonly string[];
  /** On the button that does it. */
  readonly action: string;
  /** Why it was refused; empty: it is done. */
  act(password: string): Promise<string>;
}

export interface Core {
  readonly host: PanelHost;
  /** What descriptor.json says. Views live only while it is there; a new one makes new views. */
  readonly model: Model;
  /** Newest `state` event; undefined before the first. */
  readonly state: ApplicationState | undefined;
  readonly session: SessionInfo | undefined;
  readonly link: LinkStatus;
  /** SI inside, the person's units on display. */
  readonly units: DisplayUnits;

  /** Calls back when state, session or link changed, at most once per animation frame. Ends with the returned function. */
  watchState(callback: () => void): () => void;
  /** The body of a topic as its REST answer has it, `rate` times a second (at most 10); once at once if it is known. */
  watchTopic(name: Exclude<TopicName, 'log'>, callback: (body: unknown) => void, rate?: number): () => void;
  /** Lines that came since the last call, the recent ones first. */
  watchLog(callback: (lines: readonly LogLine[]) => void): () => void;

  /** One operation of the WebSocket. Never rejects: a lost link is a problem like any other. */
  request<Fields = object>(op: string, fields?: object, timeoutMs?: number): Promise<Answer<Fields>>;
  /** Why this session may not do something that needs `role` and the control token; empty when it may. */
  deniedAction(role: 'viewer' | 'operator' | 'engineer' | 'admin'): string;

  /** Why this session may not do something that needs `role`, whoever has control; empty when it may. */
  deniedRole(role: 'viewer' | 'operator' | 'engineer' | 'admin'): string;

  /** The application runs on a PC that it can tell of. */
  readonly hasMachine: boolean;
  /** Asks for the password of whoever is logged in, in a dialog. */
  askPassword(question: PasswordQuestion): void;

  /** A widget for an item, or for a row [widget.NAME]; ready to be put into the document. Never rejects: an unknown
   *  kind gives an element that says so. */
  createWidget(what: { item: ItemInfo } | { placement: Placement }): Promise<WidgetElement>;

  /** A short message to the person, spoken by screen readers too. */
  notify(text: string, severity?: 'info' | 'warning' | 'alarm'): void;
}
