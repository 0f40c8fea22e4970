// Newest value of everything that is subscribed, and who wants to be told: in one animation frame for all of them.
import type { Reading, Value } from '../contract';
import { decodeField, decodeStructure, type Frame, type FrameItem } from './decode';
import type { Item, Model, Source } from './descriptor';
import { partOf } from './value_path';

interface SlotState {
  item: FrameItem;
  image: Blob | undefined;
}

interface Watcher {
  readonly source: Source;
  readonly callback: (reading: Reading) => void;
  /** ms between two calls. */
  readonly period: number;
  last: number;
  dirty: boolean;
}

export interface StoreOptions {
  /** The application's clock, ns. */
  readonly serverNow: () => number;
  readonly requestFrame?: (callback: (time: number) => void) => void;
}

// Frames of the screen do not come to the microsecond: one that is a little early counts.
const tolerance = 4;

export class Store {
  #model: Model | undefined;
  #nullReasons: readonly string[] = [];
  #slots = new Map<number, SlotState>();
  #watchers = new Map<number, Set<Watcher>>();
  #scheduled = false;
  readonly #requestFrame: (callback: (time: number) => void) => void;

  constructor(private readonly options: StoreOptions) {
    this.#requestFrame = options.requestFrame ?? ((callback) => requestAnimationFrame(callback));
  }

  /** Forgets everything: the application is another. */
  reset(model: Model): void {
    this.#model = model;
    this.#slots.clear();
    this.#watchers.clear();
  }

  /**
   * Forgets all values: they are from before a loss of the link. Those who watch keep the last until there is a new one.
   * nullReasons: words for the reasons of items that are NULL, by their numbers.
   */
  beginLink(nullReasons: readonly string[]): void {
    this.#nullReasons = nullReasons;
    this.#slots.clear();
  }

  forgetSlot(index: number): void {
    this.#slots.delete(index);
  }

  /** Whether the frame is of this model; one of another application's start is left alone. */
  apply(frame: Frame): boolean {
    if (frame.hash !== this.#model?.hash) return false;
    for (const item of frame.items) {
      this.#slots.set(item.slot, { item, image: undefined });
      for (const watcher of this.#watchers.get(item.slot) ?? []) watcher.dirty = true;
    }
    if (frame.items.length > 0) this.#schedule();
    return true;
  }

  /** What is known now; undefined: nothing yet. */
  reading(item: Item): Reading | undefined {
    return item.source && this.#read(item.source);
  }

  watch(item: Item, callback: (reading: Reading) => void, rate = 30): () => void {
    const source = item.source;
    if (!source) return () => undefined;
    const watcher: Watcher = { source, callback, period: 1000 / rate, last: -Infinity, dirty: true };
    const all = this.#watchers.get(source.slot.index) ?? new Set<Watcher>();
    this.#watchers.set(source.slot.index, all.add(watcher));
    const reading = this.#read(source);
    if (reading) {
      watcher.dirty = false;
      callback(reading);
    }
    return () => all.delete(watcher);
  }

  #schedule(): void {
    if (this.#scheduled) return;
    this.#scheduled = true;
    this.#requestFrame((time) => this.#deliver(time));
  }

  #deliver(time: number): void {
    this.#scheduled = false;
    let waiting = false;
    for (const [index, watchers] of this.#watchers) {
      if (!this.#slots.has(index)) continue;
      for (const watcher of watchers) {
        if (!watcher.dirty) continue;
        if (time - watcher.last < watcher.period - tolerance) {
          waiting = true;
          continue;
        }
        watcher.dirty = false;
        watcher.last = time;
        const reading = this.#read(watcher.source);
        if (reading) this.#tell(watcher, reading);
      }
    }
    if (waiting) this.#schedule();
  }

  /** One widget that throws must not keep the others from their values. */
  #tell(watcher: Watcher, reading: Reading): void {
    try {
      watcher.callback(reading);
    } catch (error) {
      console.error(error);
    }
  }

  #read(source: Source): Reading | undefined {
    const state = this.#slots.get(source.slot.index);
    if (!state) return undefined;
    const { item } = state;
    const age = Math.max(0, this.options.serverNow() - item.sampledAt) / 1e9;
    const base = { sampledAt: item.sampledAt, sequence: item.sequence, age };
    if (item.reason !== 0 || item.bytes.byteLength === 0) {
      // Of a picture that is there but cannot be encoded, the log has the cause.
      const otherwise = item.jpeg ? 'the picture cannot be shown: the log says why' : 'no value';
      // Of a slot whose driver was not chosen all else is said by the drivers that there are.
      const reason = item.reason === 0 ? otherwise : (this.#nullReasons[item.reason] ?? `unknown reason ${item.reason}`);
      return { ...base, value: null, reason: source.slot.unwritten ?? reason };
    }
    if (item.jpeg) {
      state.image ??= new Blob([item.bytes as DataView<ArrayBuffer>], { type: 'image/jpeg' });
      return { ...base, value: null, reason: '', image: state.image, scaledBy: item.scaledBy };
    }
    const value = this.#decode(source, item.bytes);
    return value === undefined ? { ...base, value: null, reason: 'wrong type' } : { ...base, value, reason: '' };
  }

  #decode(source: Source, bytes: DataView): Value | undefined {
    const types = this.#model?.types;
    const type = types?.get(source.slot.json.type);
    if (!types || !type || bytes.byteLength < type.size) return undefined;
    const last = source.fields.at(-1);
    let value: Value | undefined;
    if (last) {
      let base = 0;
      for (const field of source.fields) if (field !== last) base += field.offset;
      value = decodeField(bytes, base, last, types);
    } else {
      value = decodeStructure(bytes, 0, type, types);
    }
    return partOf(value, source.steps);
  }
}
