import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import '../blackboard';
import type { Blackboard } from '../blackboard';
import { cell } from '../../core/tests/cell';
import { FakeCore, FakeWidget, reading } from '../../core/tests/fake_core';

/** The test says which rows are seen. */
class Observer {
  static made: Observer[] = [];
  readonly observed: Element[] = [];
  constructor(readonly callback: (entries: { target: Element; isIntersecting: boolean }[]) => void) {
    Observer.made.push(this);
  }
  observe(element: Element): void {
    this.observed.push(element);
  }
  disconnect(): void {
    this.observed.length = 0;
  }
}

let fake: FakeCore;
let view: Blackboard;

async function shown(path: readonly string[] = []): Promise<void> {
  view = document.createElement('flexrf-blackboard') as Blackboard;
  Object.assign(view, { core: fake.core, host: fake.host, path });
  document.body.append(view);
  await view.updateComplete;
}

const rows = (): HTMLTableRowElement[] => [...view.shadowRoot!.querySelectorAll<HTMLTableRowElement>('#slots > tr')];
const row = (name: string): HTMLTableRowElement => rows().find((one) => one.querySelector('button')?.textContent === name)!;
const cells = (name: string): (string | null)[] => [...row(name).children].map((cell) => cell.textContent);
function see(name: string, isIntersecting = true): void {
  Observer.made.at(-1)!.callback([{ target: row(name), isIntersecting }]);
}

beforeEach(() => {
  Observer.made = [];
  vi.stubGlobal('IntersectionObserver', Observer);
  Element.prototype.scrollIntoView = () => undefined;
  fake = new FakeCore(cell);
});
afterEach(() => {
  view.remove();
  vi.unstubAllGlobals();
});

describe('the blackboard', () => {
  it('subscribes only what is seen', async () => {
    await shown();
    expect(fake.isWatched('slot:goal')).toBe(false);
    see('goal');
    expect(fake.isWatched('slot:goal')).toBe(true);
    expect(fake.isWatched('slot:ticks')).toBe(false);
    see('goal', false);
    expect(fake.isWatched('slot:goal')).toBe(false);
  });

  it('never asks for what is not observed', async () => {
    await shown();
    see('wide');
    expect(fake.isWatched('slot:wide')).toBe(false);
    expect(cells('wide')[1]).toBe('not observed');
  });

  it('writes values into the cells that are there', async () => {
    await shown();
    see('goal');
    const before = row('goal');
    const text = before.children[1]!.firstChild;
    fake.value('slot:goal', reading({ x: 0.5, y: 2 }));
    fake.value('slot:goal', reading({ x: 0.6, y: 2 }));
    expect(row('goal')).toBe(before);
    expect(before.children[1]!.firstChild).toBe(text);
    expect(cells('goal')[1]).toBe('x 600.0 mm · y 2000 mm');
    expect(cells('goal')[3]).toBe('now');
  });

  it('says why there is no value', async () => {
    await shown();
    see('goal');
    fake.value('slot:goal', reading(null, { reason: 'writer stopped' }));
    expect(cells('goal')[1]).toBe('NULL: writer stopped');
    expect(row('goal').children[1]!.className).toContain('abnormal');
  });

  it('counts what readers missed, and names writer and readers with links', async () => {
    await shown();
    fake.topic('slots', [{ name: 'goal', published: 5, readers: [{ name: 'axis[0].goal', read: 4, missed: 1 }, { name: 'axis[1].goal', read: 2, missed: 3 }] }]);
    expect(cells('goal')[7]).toBe('4');
    expect([...row('goal').querySelectorAll('a')].map((link) => link.getAttribute('href'))).toEqual([
      '#/units/axis%5B0%5D', '#/units/axis%5B1%5D',
    ]);
  });

  it('filters by name, type, writer and readers', async () => {
    await shown();
    const box = view.shadowRoot!.querySelector('input')!;
    box.value = 'place axis[1]';
    box.dispatchEvent(new Event('input'));
    await view.updateComplete;
    expect(rows().filter((one) => !one.hidden).map((one) => one.querySelector('button')!.textContent)).toEqual(['goal', 'wide']);
    expect(view.shadowRoot!.querySelector('[role=status]')!.textContent).toBe('2 of 5 slots');
  });

  it('opens a slot for all its fields, and the one in the address at once', async () => {
    await shown(['ticks']);
    await vi.waitFor(() => expect(view.shadowRoot!.querySelectorAll('fake-widget')).toHaveLength(2));
    const widgets = [...view.shadowRoot!.querySelectorAll<FakeWidget>('fake-widget')];
    expect(widgets.map((widget) => widget.item?.key)).toEqual(['slot:ticks.x', 'slot:ticks.y']);
    const button = row('ticks').querySelector('button')!;
    expect(button.getAttribute('aria-expanded')).toBe('true');
    button.click();
    expect(button.getAttribute('aria-expanded')).toBe('false');
    expect(view.shadowRoot!.querySelectorAll('fake-widget')).toHaveLength(0);
  });

  it('shows queues, a line for each writer, and what was dropped', async () => {
    await shown();
    fake.topic('queues', [
      { name: 'jobs', fill: 3, writers: [{ name: 'motor.jobs', pushed: 9, popped: 7, dropped: 0 }, { name: 'axis[1].more', pushed: 5, popped: 1, dropped: 4 }] },
    ]);
    await view.updateComplete;
    const lines = [...view.shadowRoot!.querySelectorAll('tbody:not(#slots) tr')].map((line) => line.textContent!.replace(/\s+/g, ' ').trim());
    expect(lines[0]).toMatch(/^jobs 3 4 drop oldest Place motor\.jobs/);
    expect(lines[1]).toContain('▲ 4');
    expect(view.shadowRoot!.querySelector('.scores-cell')).toBeNull(); // none is ordered by a score
  });

  it('shows the scores of what waits, of a queue that is ordered by them', async () => {
    fake = new FakeCore({ ...cell, queues: cell.queues.map((queue) => ({ ...queue, share: 'jobs', score: 'urgency' })) });
    await shown();
    const told = async (fill: number, scores: (number | null)[]): Promise<void> => {
      fake.topic('queues', [{ name: 'jobs', fill, scores, writers: [] }]);
      await view.updateComplete;
    };
    const cellOf = (): Element => view.shadowRoot!.querySelector('.scores-cell')!;
    expect(cellOf().textContent!.trim()).toBe('');
    await told(3, [2, 0.25, -1]);
    expect(cellOf().textContent!.trim()).toBe('2 to −1');
    expect(cellOf().querySelector('svg')!.getAttribute('aria-label')).toBe('urgency of what waits: 2 to −1');
    expect(cellOf().querySelector('svg')!.getAttribute('viewBox')).toBe('0 0 4 100');
    await told(70, [2, 1]);
    expect(cellOf().querySelector('svg')!.getAttribute('aria-label')).toBe('urgency of what waits, the highest 2: 2 to 1');
    await told(0, []);
    expect(cellOf().textContent!.trim()).toBe('');
  });

  it('ends everything it began, and begins anew', async () => {
    await shown();
    see('goal');
    view.remove();
    expect(fake.isWatched('slot:goal')).toBe(false);
    expect(fake.topics.get('slots')!.size).toBe(0);
    document.body.append(view);
    see('goal');
    expect(fake.isWatched('slot:goal')).toBe(true);
  });
});
