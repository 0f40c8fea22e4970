// What widgets of configuration parameters are given as their host: they show the configuration in force, or the draft
// while it is being edited, and what they set goes into the draft. All else is the page's own host.
import type { Hold, ItemInfo, Joint, ListName, Outcome, Reading, SetOptions, UnitTable, Value, WidgetHost } from '../contract';
import { sameValue } from '../core/same_value';
import { partOf, partsOf } from '../core/value_path';
import { added } from '../core/watchers';
import type { EditFlow } from './edit_flow';
import { rootOf, withPart } from './value_parts';

interface Watcher {
  readonly item: ItemInfo;
  readonly callback: (reading: Reading) => void;
  /** What the server says is in force; undefined before it said anything. */
  inForce: Reading | undefined;
  shown: Value | null | undefined;
}

export class EditHost implements WidgetHost {
  private sequence = 0;
  private frame = 0;
  private readonly watchers = new Set<Watcher>();
  private readonly access = new Set<() => void>();

  constructor(
    private readonly base: WidgetHost,
    private readonly flow: () => EditFlow,
    /** Why this item's configuration cannot be edited at all; empty when Edit is what it takes. */
    private readonly before: () => string,
  ) {}

  /** The flow is at another step, or a value of its draft is another. */
  refresh(): void {
    if (this.frame === 0) this.frame = requestAnimationFrame(() => this.tellAll());
    this.access.forEach((callback) => callback());
  }

  watch(key: string, callback: (reading: Reading) => void, options?: { rate?: number; width?: number }): () => void {
    const item = this.configured(key);
    if (item === undefined) return this.base.watch(key, callback, options);
    const watcher: Watcher = { item, callback, inForce: undefined, shown: undefined };
    this.watchers.add(watcher);
    const end = this.base.watch(key, (reading) => {
      watcher.inForce = reading;
      this.tell(watcher);
    });
    this.tell(watcher);
    return () => {
      end();
      this.watchers.delete(watcher);
    };
  }

  async set(key: string, value: Value, options?: SetOptions): Promise<Outcome> {
    const item = this.configured(key);
    if (item === undefined) return this.base.set(key, value, options);
    const locked = this.locked(key);
    if (locked !== '') return { ok: false, detail: locked };
    const component = item.component!;
    const [root, ...rest] = partsOf(item.path!);
    const parameter = String(root);
    const whole = this.flow().value(component, parameter);
    if (whole === undefined) return { ok: false, detail: `${item.label} is not part of this edit` };
    this.flow().change(component, parameter, withPart(whole, rest, value));
    this.refresh();
    const invalid = this.flow().draft?.invalid[`${component}.${parameter}`];
    return invalid === undefined ? { ok: true } : { ok: false, detail: invalid, parameter };
  }

  async reset(key: string): Promise<Outcome> {
    const item = this.configured(key);
    if (item === undefined) return this.base.reset(key);
    if (item.default === undefined) return { ok: false, detail: `${item.label} has no default` };
    return this.set(key, item.default);
  }

  press(key: string, count?: number): Promise<Outcome> {
    return this.base.press(key, count);
  }

  hold(key: string): Promise<Hold> {
    return this.base.hold(key);
  }

  item(key: string): ItemInfo | undefined {
    return this.base.item(key);
  }

  locked(key: string): string {
    const item = this.configured(key);
    if (item === undefined) return this.base.locked(key);
    const { state } = this.flow();
    if (state.step === 'applying') return 'The changes are being applied.';
    if (state.step !== 'editing') return this.before() || 'Locked while initialised. Press Edit to change it.';
    if (state.draft.configuration[item.component!]?.[rootOf(item.path!)] === undefined) return 'Not part of this edit.';
    return this.base.stale ? 'No link to the application.' : '';
  }

  watchAccess(callback: () => void): () => void {
    const forget = added(this.access, callback);
    const end = this.base.watchAccess(callback);
    return () => {
      forget();
      end();
    };
  }

  get stale(): boolean {
    return this.base.stale;
  }

  joints(device: string): readonly Joint[] {
    return this.base.joints(device);
  }

  get units(): readonly UnitTable[] {
    return this.base.units;
  }

  watchList(name: ListName, callback: (list: unknown) => void, rate?: number): () => void {
    return this.base.watchList(name, callback, rate);
  }

  file(path: string): Promise<Response> {
    return this.base.file(path);
  }

  private configured(key: string): ItemInfo | undefined {
    const item = this.base.item(key);
    return item?.kind === 'configuration' && item.component !== undefined && item.path !== undefined ? item : undefined;
  }

  private tellAll(): void {
    this.frame = 0;
    this.watchers.forEach((watcher) => this.tell(watcher));
  }

  private tell(watcher: Watcher): void {
    const [root, ...rest] = partsOf(watcher.item.path!);
    const drafted = partOf(this.flow().value(watcher.item.component!, String(root)), rest);
    if (drafted === undefined && watcher.inForce === undefined) return;
    const value = drafted ?? watcher.inForce?.value ?? null;
    if (watcher.shown !== undefined && sameValue(watcher.shown, value, 'f64')) return;
    watcher.shown = value;
    const reason = value === null ? (watcher.inForce?.reason ?? 'not known yet') : '';
    watcher.callback({ value, reason, sampledAt: 0, sequence: ++this.sequence, age: 0 });
  }
}
