// A host whose every side the test holds in its hands.
import { vi } from 'vitest';
import type {
  Hold, ItemInfo, ListName, Outcome, Reading, RegisterWidget, SetOptions, UnitTable, Value, WidgetElement, WidgetHost,
} from '../../contract';
import { kindOf, registerBuiltIn } from '..';
import { Newest } from '../../core/newest';
import { tagOf } from '../../core/registry';
import { registerFurther } from '../further';
import { Population } from '../population';
import { Timeline } from '../timeline';

const registerApart = (register: RegisterWidget): void => {
  register('population', Population);
  register('timeline', Timeline);
};

for (const registerAll of [registerBuiltIn, registerFurther, registerApart]) {
  registerAll((kind, element) => {
    if (!customElements.get(tagOf(kind))) customElements.define(tagOf(kind), element);
  });
}

interface Watch {
  readonly key: string;
  readonly callback: (reading: Reading) => void;
  readonly options: { rate?: number; width?: number };
}

/** A lease that the test can take away. */
export interface FakeHold extends Hold {
  released: boolean;
  lose(reason: string): void;
}

export function makeHold(): FakeHold {
  let lose = (_reason: string): void => undefined;
  const over = new Promise<string>((resolve) => (lose = resolve));
  const hold: FakeHold = {
    released: false,
    over,
    lose,
    release: () => {
      hold.released = true;
      lose('released');
    },
  };
  return hold;
}

export class FakeHost implements WidgetHost {
  stale = false;
  reason = '';
  readonly items = new Map<string, ItemInfo>();
  readonly watches: Watch[] = [];
  private readonly access = new Set<() => void>();
  private sequence = 0;

  readonly set = vi.fn<(key: string, value: Value) => Promise<Outcome>>(async () => ({ ok: true }));
  readonly press = vi.fn<(key: string, count?: number) => Promise<Outcome>>(async () => ({ ok: true }));
  readonly reset = vi.fn<(key: string) => Promise<Outcome>>(async () => ({ ok: true }));
  readonly hold = vi.fn<(key: string) => Promise<Hold>>(async () => makeHold());
  readonly file = vi.fn(async () => new Response());
  readonly joints = () => [];
  units: readonly UnitTable[] = [];
  readonly lists = new Map<ListName, Set<(list: unknown) => void>>();

  watch(key: string, callback: (reading: Reading) => void, options: { rate?: number; width?: number } = {}): () => void {
    const watch = { key, callback, options };
    this.watches.push(watch);
    return () => this.watches.splice(this.watches.indexOf(watch), 1);
  }

  /** The unit says so. */
  publish(key: string, value: Value | null, more: Partial<Reading> = {}): void {
    this.sequence += 1;
    const reading: Reading = { value, reason: '', sampledAt: 0, sequence: this.sequence, age: 0, ...more };
    this.watches.filter((watch) => watch.key === key).forEach((watch) => watch.callback(reading));
  }

  watchList(name: ListName, callback: (list: unknown) => void): () => void {
    const watchers = this.lists.get(name) ?? new Set<(list: unknown) => void>();
    this.lists.set(name, watchers.add(callback));
    return () => watchers.delete(callback);
  }
  /** The application counts so. */
  count(name: ListName, list: unknown): void {
    this.lists.get(name)?.forEach((callback) => callback(list));
  }

  item(key: string): ItemInfo | undefined {
    return this.items.get(key);
  }
  locked(): string {
    return this.reason;
  }
  watchAccess(callback: () => void): () => void {
    this.access.add(callback);
    return () => this.access.delete(callback);
  }

  /** Empty: everything may be changed. */
  lock(reason: string): void {
    this.reason = reason;
    this.access.forEach((callback) => callback());
  }
  grow(stale: boolean): void {
    this.stale = stale;
    this.access.forEach((callback) => callback());
  }
}

/** As a widget sees it: of the values that it sets, those come to `host.set` that the page's host would send. */
function seenByWidgets(host: FakeHost): WidgetHost {
  const settings = new Map<string, Newest<Outcome>>();
  const set = async (key: string, value: Value, options?: SetOptions): Promise<Outcome> => {
    const setting = settings.get(key) ?? new Newest<Outcome>({ ok: false, detail: 'withdrawn' });
    settings.set(key, setting);
    return setting.run(() => host.set(key, value), options);
  };
  return Object.create(host, { set: { value: set } }) as WidgetHost;
}

export function makeItem(more: Partial<ItemInfo> = {}): ItemInfo {
  return {
    key: 'jog.step', label: 'Step', summary: 'How far one press moves.', scalar: 'f64', shape: [], unit: '1',
    kind: 'feedback', ...more,
  };
}

/** A runtime parameter that an operator may change. */
export function makeParameter(more: Partial<ItemInfo> = {}): ItemInfo {
  return makeItem({ kind: 'runtime', role: 'operator', component: 'jog', path: 'step', ...more });
}

export interface Shown {
  readonly host: FakeHost;
  readonly widget: WidgetElement;
  readonly root: ShadowRoot;
  find<E extends Element>(selector: string): E;
  /** Text of an element; of the first that matches. */
  text(selector: string): string;
}

/** The item's widget in the document, rendered. */
export async function show(item: ItemInfo, more: Partial<WidgetElement> = {}, kind = kindOf(item), host = new FakeHost()): Promise<Shown> {
  host.items.set(item.key, item);
  return mount(kind, Object.assign(more, { item }), host);
}

export async function mount(kind: string, properties: Partial<WidgetElement>, host: FakeHost): Promise<Shown> {
  const widget = Object.assign(document.createElement(tagOf(kind)) as WidgetElement, { host: seenByWidgets(host) }, properties);
  document.body.append(widget);
  await settled(widget);
  const root = widget.shadowRoot!;
  const find = <E extends Element>(selector: string): E => {
    const found = root.querySelector<E>(selector);
    if (!found) throw new Error(`no ${selector} in ${root.innerHTML}`);
    return found;
  };
  return { host, widget, root, find, text: (selector) => (find(selector).textContent ?? '').trim() };
}

/** After promises and renderings. */
export async function settled(widget?: Element): Promise<void> {
  for (let i = 0; i < 8; ++i) await Promise.resolve();
  await (widget as { updateComplete?: Promise<unknown> } | undefined)?.updateComplete;
  for (let i = 0; i < 8; ++i) await Promise.resolve();
}

/** What a finger or mouse does; jsdom has no pointer of its own. */
export function pointer(
  target: EventTarget, name: string,
  more: { pointerId?: number; button?: number; isPrimary?: boolean; clientX?: number; clientY?: number } = {},
): void {
  const { button = 0, clientX = 0, clientY = 0 } = more;
  const event = new MouseEvent(name, { bubbles: true, composed: true, cancelable: true, button, clientX, clientY });
  Object.defineProperties(event, {
    pointerId: { value: more.pointerId ?? 1 },
    isPrimary: { value: more.isPrimary ?? true },
  });
  target.dispatchEvent(event);
}

export function key(target: EventTarget, name: 'keydown' | 'keyup', value: string, more: KeyboardEventInit = {}): KeyboardEvent {
  const event = new KeyboardEvent(name, { key: value, bubbles: true, composed: true, cancelable: true, ...more });
  target.dispatchEvent(event);
  return event;
}

/** A person's input: the field has this text, or the slider this position. */
export function type(field: HTMLInputElement | HTMLSelectElement, value: string, event = 'input'): void {
  field.value = value;
  field.dispatchEvent(new Event(event, { bubbles: true, composed: true }));
}
