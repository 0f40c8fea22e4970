import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import type { ItemInfo, Placement, Value } from '../../contract';
import { FakeHost, makeItem, makeParameter, mount, settled, type Shown } from '../tests/fake_host';

const field = (name: string, more: Partial<ItemInfo> = {}): ItemInfo =>
  makeItem({ key: `slot:standing.entrants[0].${name}`, label: name, kind: 'slot', ...more });
const placement: Placement = {
  name: 'contest', kind: 'population', label: 'Contest', place: 'overview', slots: { members: 'standing' },
  parameters: { freeze: 'judge.frozen', save: 'judge.save' },
  options: {
    population: 'runner', list: 'entrants', generation: 'round', active: 'active', state: 'trial, is_safe, mood', fitness: 'score',
    cost: 'price', identity: 'number', parent: 'parent', weights: 'habits', weight_names: 'pace, rest', columns: 'heats',
  },
};

let host: FakeHost;

beforeEach(() => {
  host = new FakeHost();
  const members = [
    field('active', { scalar: 'bool' }), field('trial', { scalar: 'bool' }), field('is_safe', { scalar: 'bool' }),
    field('mood', { scalar: 'enumeration' }), field('number', { scalar: 'u32' }), field('parent', { scalar: 'u32' }),
    field('score', { label: 'Score' }), field('price', { label: 'Price', scalar: 'u32' }), field('heats', { label: 'Heats', scalar: 'u32' }),
    field('habits', { shape: [2] }),
    field('tempers', { scalar: 'structure', members: [field('tempers.calm', { label: 'Calm' }), field('tempers.bold', { label: 'Bold' })] }),
  ];
  host.items.set('slot:standing', makeItem({ key: 'slot:standing', label: 'standing', scalar: 'structure', kind: 'slot' }));
  host.items.set('slot:standing.entrants', makeItem({ key: 'slot:standing.entrants', scalar: 'structure', shape: [4], kind: 'slot' }));
  host.items.set('slot:standing.entrants[0]', makeItem({ key: 'slot:standing.entrants[0]', scalar: 'structure', members, kind: 'slot' }));
  host.items.set('judge.frozen', makeParameter({ key: 'judge.frozen', label: 'Freeze', scalar: 'bool' }));
  host.items.set('judge.save', makeParameter({ key: 'judge.save', label: 'Save them', scalar: 'button' }));
  host.items.set('runner[0].pace', makeParameter({ key: 'runner[0].pace', label: 'Pace', range: [0, 2] }));
  host.items.set('runner[0].rest', makeParameter({ key: 'runner[0].rest', label: 'Rest', range: [-1, 1] }));
  host.units = [0, 1, 2].map((index) => ({ name: `runner[${index}]`, population: 'runner', thread: 'running' }));
});
afterEach(() => document.body.replaceChildren());

const entrant = (more: { [field: string]: Value } = {}): Value => ({
  active: true, trial: false, is_safe: false, mood: 'fresh', number: 1, parent: 1, score: 1.5, price: 200, heats: 7, habits: [1, -0.5],
  tempers: { calm: 1, bold: 2 }, ...more,
});
const tell = (round: number, ...entrants: Value[]): void => host.publish('slot:standing', { round, entrants });
const open = (options: Placement['options'] = placement.options): Promise<Shown> =>
  mount('population', { placement: { ...placement, options } }, host);
const rows = (shown: Shown): HTMLElement[] => [...shown.root.querySelectorAll<HTMLElement>('tbody > tr')];
const cells = (row: HTMLElement): string[] => [...row.children].map((cell) => (cell.textContent ?? '').replace(/\s+/g, ' ').trim());

describe('a population', () => {
  it('has a row for each member, with its state, what it is worth and costs, and its weights', async () => {
    const shown = await open();
    tell(1, entrant({ trial: true, is_safe: true }), entrant({ number: 5, parent: 2, score: 0.25 }), entrant({ active: false }), entrant());
    expect(rows(shown).map(cells)).toEqual([
      ['runner[0] no. 1', 'trial, safe, fresh', '1.500', '', '200', '7', '1.00', '−0.50'],
      ['runner[1] no. 5, child of 2', 'fresh', '0.250', '', '200', '7', '1.00', '−0.50'],
      ['runner[2]', 'not active', '—', '', '—', '—', '', ''],
    ]);
    expect([...shown.root.querySelectorAll('thead th')].map((head) => head.textContent!.trim())).toEqual([
      'Member', 'State', 'Score', 'Over generations', 'Price', 'Heats', 'Pace', 'Rest',
    ]);
    expect(rows(shown).map((row) => row.className)).toEqual(['', '', 'free']);
    expect(shown.find('a').getAttribute('href')).toBe('#/units/runner%5B0%5D');
  });

  it('draws weights against the ranges of the parameters that they are', async () => {
    const shown = await open();
    tell(1, entrant());
    const bars = [...rows(shown)[0]!.querySelectorAll<HTMLElement>('.bar > i')].map((bar) => bar.style.transform);
    expect(bars).toEqual(['translateX(0.0%) scaleX(0.500)', 'translateX(25.0%) scaleX(0.250)']);
  });

  it('draws the lines of all members on one scale, and goes on with them when it is shown again', async () => {
    const shown = await open();
    tell(1, entrant({ score: 1 }), entrant({ score: 2 }));
    tell(2, entrant({ score: 2 }), entrant({ score: 1 }));
    const lines = (one: Shown): (string | null)[] => rows(one).map((row) => row.querySelector('path')!.getAttribute('d'));
    expect(lines(shown)).toEqual(['M0.0 50.0L100.0 0.0', 'M0.0 0.0L100.0 50.0', '']);
    const { widget } = shown;
    widget.remove();
    expect(host.watches).toHaveLength(0);
    document.body.append(widget);
    tell(3, entrant({ score: 2 }), entrant({ score: 1, number: 9 }));
    expect(lines(shown)).toEqual(['M0.0 50.0L50.0 0.0L100.0 0.0', 'M100.0 50.0h0', '']);
  });

  it('has the controls that the row names', async () => {
    const shown = await open();
    const [freeze, save] = [...shown.find('.actions').children];
    expect([freeze!.localName, save!.localName]).toEqual(['flexrf-widget-toggle', 'flexrf-widget-button']);
    await settled(save!);
    save!.shadowRoot!.querySelector('button')!.click();
    await settled(save!);
    expect(host.press).toHaveBeenCalledWith('judge.save');
  });

  it('goes by the members of a structure of weights, and without a population by places', async () => {
    const shown = await open({ list: 'entrants', fitness: 'score', weights: 'tempers' });
    host.publish('slot:standing', { entrants: [entrant(), entrant({ tempers: { calm: 0.5, bold: -2 } })] }, { sampledAt: 5e9 });
    expect([...shown.root.querySelectorAll('thead th')].map((head) => head.textContent!.trim())).toEqual([
      'Member', 'State', 'Score', 'Lately', 'Calm', 'Bold',
    ]);
    expect(rows(shown).map((row) => cells(row)[0])).toEqual(['0', '1', '2', '3']);
    expect(cells(rows(shown)[1]!)).toEqual(['1', 'active', '1.500', '', '0.50', '−2.00']);
    // Against the largest that was seen.
    expect([...rows(shown)[1]!.querySelectorAll<HTMLElement>('.bar > i')].map((bar) => bar.style.transform)).toEqual([
      'translateX(0.0%) scaleX(0.500)', 'translateX(0.0%) scaleX(0.500)',
    ]);
    expect(cells(rows(shown)[2]!)[1]).toBe('—');
  });

  it('says why there are none', async () => {
    const shown = await open();
    host.publish('slot:standing', null, { reason: 'the unit that writes it was stopped' });
    expect(shown.text('#absence')).toBe('the unit that writes it was stopped');
    expect(cells(rows(shown)[0]!)[1]).toBe('—');
  });

  it('says of controls why they are dead, and of values that they are old', async () => {
    const shown = await open();
    host.lock('no control');
    host.grow(true);
    expect(shown.widget.hasAttribute('stale')).toBe(true);
    const save = shown.find('.actions').children[1]!;
    await settled(save);
    expect(save.shadowRoot!.querySelector('button')!.disabled).toBe(true);
  });
});
