// One slot's row in the blackboard's table: made once; what changes is written into its Text nodes.
import type { Reading, WidgetHost } from '../contract';
import type { Core } from '../core/core';
import type { Component, Model, Slot } from '../core/descriptor';
import { LiveText, setAttribute } from '../widgets/live_text';
import { absence } from '../widgets/value_text';
import { compactText } from './compact_value';
import { ageText, countText, rateText } from './durations';
import { ageNow } from './slot_age';
import { addressOf } from './view_base';
import { hasAll } from './wanted_words';

/** A row of topic "slots". */
export interface SlotCounters {
  readonly name: string;
  readonly published: number;
  readonly readers: readonly { readonly name: string; readonly read: number; readonly missed: number }[];
}

/** Columns of the table, with what their cells hold beside text. */
export const slotColumns = ['Slot', 'Value', 'Rate', 'Age', 'Type', 'Writer', 'Readers', 'Missed'] as const;

const rate_of_values = 4;

/** The component that a port belongs to: "axis[0].drive.out" is one of "axis[0].drive". */
export function ownerOf(model: Model, port: string): Component | undefined {
  return model.components.get(port.slice(0, Math.max(0, port.lastIndexOf('.'))));
}

/** Who writes a slot: a port, or the executive on behalf of a component whose values or feedback it holds. */
export function writerOf(model: Model, slot: Slot): { readonly text: string; readonly component: Component | undefined } {
  if (slot.json.writer !== '') return { text: slot.json.writer, component: ownerOf(model, slot.json.writer) };
  for (const component of model.components.values()) {
    const row = component.unit ?? component.device;
    if (row?.values_slot === slot.name || row?.feedback_slot === slot.name) return { text: component.name, component };
  }
  return { text: '', component: undefined };
}

export class SlotRow {
  readonly element = document.createElement('tr');
  private readonly button = document.createElement('button');
  private readonly value: LiveText;
  private readonly rate: LiveText;
  private readonly age: LiveText;
  private readonly missed: LiveText;
  private readonly valueCell: HTMLElement;
  private readonly haystack: string;
  private detail: HTMLTableRowElement | undefined;
  private readonly detailCounts = new Map<string, LiveText>();
  private counters: SlotCounters | undefined;
  private end: (() => void) | undefined;
  private reading: Reading | undefined;
  private receivedAt = 0;

  constructor(
    readonly slot: Slot,
    private readonly core: Core,
    private readonly host: WidgetHost,
  ) {
    const { json } = slot;
    this.haystack = [slot.name, json.type, json.writer, json.summary, ...json.readers].join(' ');

    const name = this.cell('th');
    name.scope = 'row';
    this.button.className = 'expand';
    this.button.textContent = slot.name;
    this.button.setAttribute('aria-expanded', 'false');
    this.button.addEventListener('click', () => this.toggle());
    name.append(this.button);

    this.valueCell = this.cell('td', 'value-cell');
    this.value = new LiveText(this.valueCell, json.observe ? '' : 'not observed');
    this.rate = new LiveText(this.cell('td', 'number'), '–');
    this.age = new LiveText(this.cell('td', 'number'), '–');
    this.cell('td').textContent = json.type;
    const writer = writerOf(core.model, slot);
    this.cell('td').append(link(writer.text, writer.component));
    const readers = this.cell('td');
    json.readers.forEach((reader, i) => readers.append(i > 0 ? ', ' : '', link(reader, ownerOf(core.model, reader))));
    this.missed = new LiveText(this.cell('td', 'number'), '–');
  }

  matches(words: readonly string[]): boolean {
    return hasAll(this.haystack, words);
  }

  set hidden(hidden: boolean) {
    this.element.hidden = hidden;
    if (this.detail) this.detail.hidden = hidden;
  }

  /** Subscribes while the row is seen. */
  set visible(visible: boolean) {
    if (visible === (this.end !== undefined) || !this.slot.json.observe) return;
    if (!visible) {
      this.end?.();
      this.end = undefined;
      return;
    }
    this.end = this.host.watch(this.slot.item.key, (reading) => this.take(reading), { rate: rate_of_values, width: 64 });
  }

  count(counters: SlotCounters, rate: number | null): void {
    this.counters = counters;
    this.rate.text = rateText(rate);
    this.missed.text = countText(counters.readers.reduce((sum, reader) => sum + reader.missed, 0));
    this.countDetails();
  }

  /** Ages go on without new values. */
  tick(now: number): void {
    if (this.end !== undefined && this.reading !== undefined && this.reading.sampledAt !== 0) {
      this.age.text = ageText(ageNow(this.reading, this.receivedAt, now));
    }
  }

  expand(): void {
    if (this.detail === undefined) this.toggle();
  }

  focus(): void {
    this.element.scrollIntoView({ block: 'start' });
    this.button.focus();
  }

  close(): void {
    this.visible = false;
    this.detail?.remove();
    this.detail = undefined;
  }

  private take(reading: Reading): void {
    this.reading = reading;
    this.receivedAt = performance.now();
    const missing = absence(reading);
    setAttribute(this.valueCell, 'class', missing === '' ? 'value-cell' : 'value-cell abnormal');
    if (reading.image !== undefined) this.value.text = 'image';
    else if (reading.value === null) this.value.text = `NULL: ${missing}`;
    else this.value.text = compactText(this.slot.item, reading.value, this.core.units);
    setAttribute(this.valueCell, 'title', missing === '' ? '' : this.value.text); // cut where it is long: a second line would move the rows
    this.tick(this.receivedAt);
  }

  private toggle(): void {
    if (this.detail !== undefined) {
      this.detail.remove();
      this.detail = undefined;
      this.detailCounts.clear();
    } else {
      this.detail = this.makeDetail();
      this.element.after(this.detail);
      this.countDetails();
    }
    this.button.setAttribute('aria-expanded', String(this.detail !== undefined));
  }

  private makeDetail(): HTMLTableRowElement {
    const row = document.createElement('tr');
    const cell = document.createElement('td');
    const inside = document.createElement('div');
    cell.colSpan = slotColumns.length;
    row.className = 'detail';
    inside.className = 'inside';
    cell.append(inside);
    row.append(cell);
    if (this.slot.json.summary !== '') inside.append(paragraph(this.slot.json.summary));
    if (!this.slot.json.observe) inside.append(paragraph('Not observed: the application\'s table leaves this slot out.'));
    else void this.fill(inside);
    for (const reader of this.slot.json.readers) {
      const line = paragraph(`${reader}: `);
      this.detailCounts.set(reader, new LiveText(line));
      inside.append(line);
    }
    return row;
  }

  /** All fields, each as its widget shows it. */
  private async fill(cell: HTMLElement): Promise<void> {
    const { item } = this.slot;
    const items = this.slot.image || !item.members?.length ? [item] : item.members;
    const place = document.createElement('div');
    cell.append(place);
    const widgets = await Promise.all(items.map((one) => this.core.createWidget({ item: one })));
    place.append(...widgets);
  }

  private countDetails(): void {
    for (const reader of this.counters?.readers ?? []) {
      const text = this.detailCounts.get(reader.name);
      if (text) text.text = `${countText(reader.read)} read, ${countText(reader.missed)} missed`;
    }
  }

  private cell<Name extends 'td' | 'th'>(name: Name, className = ''): HTMLElementTagNameMap[Name] {
    const cell = document.createElement(name);
    cell.className = className;
    this.element.append(cell);
    return cell;
  }
}

function link(text: string, component: Component | undefined): Node {
  if (component === undefined) return document.createTextNode(text);
  const anchor = document.createElement('a');
  anchor.href = addressOf(`${component.kind}s`, component.name);
  anchor.textContent = text;
  return anchor;
}

function paragraph(text: string): HTMLParagraphElement {
  const element = document.createElement('p');
  element.textContent = text;
  return element;
}
