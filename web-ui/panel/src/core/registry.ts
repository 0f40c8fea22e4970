// Which element shows what: the widgets that come with the panel, and those that an application brings along.
//
// A custom widget is one file, `widgets/KIND.js`, in the application's folder: plain JavaScript (a module) that the browser
// loads as /application/widgets/KIND.js when a row [widget.NAME] has this kind. It needs no build and no library:
//
//     export default class extends HTMLElement {
//       connectedCallback() { this.end = this.host.watch(`slot:${this.placement.slots.pose}`, (reading) => ...); }
//       disconnectedCallback() { this.end(); }
//     }
//
// The module's default export is the element's class, and its kind is the file's name. A module that brings several kinds
// exports `register(register)` instead and calls register('KIND', class) for each. A class is defined as the custom element
// <flexrf-widget-KIND>; it never calls customElements.define itself. `host`, `item` or `placement` are set before it is
// connected. What it may use is in contract.ts.
import type { ItemInfo, Placement, RegisterWidget, WidgetElement, WidgetHost } from '../contract';
import { loadPart } from './parts';

type WidgetClass = new () => WidgetElement;
/** A kind of the panel's that comes by itself; undefined: there is none. */
export type LoadWidget = (kind: string) => Promise<WidgetClass | undefined>;

/** What src/widgets/index.ts exports. */
export interface BuiltInWidgets {
  /** Those that a first view needs. */
  registerBuiltIn(register: RegisterWidget): void;
  /** All others, in a chunk of their own; gives what loads those that come by themselves. */
  registerFurther(register: RegisterWidget): Promise<LoadWidget>;
  /** `item.widget` where it fits or is none of the built-in ones, or else what suits the item's type. */
  kindOf(item: ItemInfo): string;
  /** The kind of a row [widget.NAME] where that fits its item, or else what suits the item's type. */
  placedKind(host: WidgetHost, placement: Placement): string;
}

interface CustomModule {
  readonly default?: WidgetClass;
  readonly register?: (register: RegisterWidget) => void;
}

/** Name of the custom element of a kind. */
export function tagOf(kind: string): string {
  return `flexrf-widget-${kind.replaceAll('_', '-')}`;
}

export const kindPattern = /^[a-z][a-z0-9_-]*$/;

export class Registry {
  #kinds = new Map<string, string>();
  #builtIn: Promise<BuiltInWidgets> | undefined;
  #further: Promise<LoadWidget> | undefined;
  #loading = new Map<string, Promise<void>>();

  constructor(
    private readonly loadBuiltIn: () => Promise<BuiltInWidgets>,
    private readonly loadCustom: (address: string) => Promise<CustomModule> = (address) => import(/* @vite-ignore */ address),
  ) {}

  readonly register: RegisterWidget = (kind, element) => {
    if (!kindPattern.test(kind)) throw new Error(`"${kind}" is no name of a widget: use a-z, 0-9, _ and -`);
    if (this.#kinds.has(kind)) throw new Error(`a widget "${kind}" is registered already`);
    const tag = tagOf(kind);
    if (!customElements.get(tag)) customElements.define(tag, element);
    this.#kinds.set(kind, tag);
  };

  /**
   * A new element of the kind; loads the application's own if there is no built-in one. Rejects with the cause.
   * `controls`: what it shows can be changed, so it may make any other of the built-in ones.
   */
  async create(kind: string, controls = false): Promise<WidgetElement> {
    await this.#builtIns();
    if (controls || !this.#kinds.has(kind)) await this.#furtherOnes();
    if (!this.#kinds.has(kind)) await this.#load(kind);
    const tag = this.#kinds.get(kind);
    if (!tag) throw new Error(`/application/widgets/${kind}.js registers no widget "${kind}"`);
    return document.createElement(tag) as WidgetElement;
  }

  /** The widget that the tables name, or else the one that suits the item. */
  async kindFor(item: ItemInfo): Promise<string> {
    const builtIn = await this.#builtIns();
    return builtIn.kindOf(item);
  }

  async kindForRow(host: WidgetHost, placement: Placement): Promise<string> {
    const builtIn = await this.#builtIns();
    return builtIn.placedKind(host, placement);
  }

  #builtIns(): Promise<BuiltInWidgets> {
    this.#builtIn ??= loadPart(this.loadBuiltIn).then((module) => {
      module.registerBuiltIn(this.register);
      return module;
    });
    this.#builtIn.catch(() => { this.#builtIn = undefined; });
    return this.#builtIn;
  }

  async #furtherOnes(): Promise<LoadWidget> {
    const builtIn = await this.#builtIns();
    this.#further ??= loadPart(() => builtIn.registerFurther(this.register));
    this.#further.catch(() => { this.#further = undefined; });
    return this.#further;
  }

  #load(kind: string): Promise<void> {
    if (!kindPattern.test(kind)) return Promise.reject(new Error(`"${kind}" is no name of a widget`));
    let loading = this.#loading.get(kind);
    if (!loading) {
      loading = this.#furtherOnes().then((load) => load(kind)).then((element) => element
        ? this.register(kind, element)
        : this.loadCustom(`/application/widgets/${kind}.js`).then((module) => {
          if (module.register) module.register(this.register);
          else if (module.default) this.register(kind, module.default);
        }));
      this.#loading.set(kind, loading);
      loading.catch(() => this.#loading.delete(kind)); // another try, once the file is there
    }
    return loading;
  }
}
