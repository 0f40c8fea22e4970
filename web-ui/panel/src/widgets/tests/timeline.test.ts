import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import type { Placement } from '../../contract';
import { FakeHost, makeItem, mount, settled, type Shown } from '../tests/fake_host';

const placement: Placement = {
  name: 'work', kind: 'timeline', label: 'Work', place: 'overview', slots: {}, parameters: {},
  options: { rows: 'runner, judge', frame: 'pulse', frames: 2, result: 'effort', list: 'last', count: 'count', fields: 'mood, entrant.number' },
};
let host: FakeHost;

beforeEach(() => {
  host = new FakeHost();
  host.units = [
    { name: 'pulse', thread: 'main', outputs: { beat: 'beat' } },
    ...[0, 1].map((index) => ({ name: `runner[${index}]`, population: 'runner', thread: 'running', outputs: { effort: `efforts[${index}]`, jobs: 'jobs' } })),
    { name: 'judge', thread: 'main', outputs: { standing: 'standing', effort: null } },
  ];
  for (const name of ['efforts[0]', 'efforts[1]', 'standing']) host.items.set(`slot:${name}`, makeItem({ key: `slot:${name}` }));
  host.items.set('slot:efforts[0].last[0].mood', makeItem({ key: 'slot:efforts[0].last[0].mood', label: 'Mood', scalar: 'enumeration' }));
  host.items.set('slot:efforts[0].last[0].entrant.number', makeItem({ key: 'slot:efforts[0].last[0].entrant.number', label: 'Number', scalar: 'u32', unit: '' }));
});
afterEach(() => document.body.replaceChildren());

const open = (): Promise<Shown> => mount('timeline', { placement }, host);
const rows = (shown: Shown): string[][] => [...shown.root.querySelectorAll('tbody > tr')].map((row) =>
  [...row.children].map((cell) => (cell.textContent ?? '').trim()));
const ms = 1e6;

describe('a timeline', () => {
  it('shows who worked when over the last frames, and how long in each', async () => {
    const shown = await open();
    expect(shown.text('caption')).toBe('Waits for steps of pulse');
    host.count('steps', [
      { thread: 'main', begin_ns: 1000 * ms, cut: false, steps: [0, 0, ms, 3, 5 * ms, 2 * ms, 0, 10 * ms, ms, 3, 15 * ms, 2 * ms, 0, 20 * ms, ms, 0, 30 * ms, ms] },
      { thread: 'running', begin_ns: 1012 * ms, cut: false, steps: [1, 0, 4 * ms] },
    ]);
    await settled(shown.widget);
    expect(shown.text('caption')).toBe('Last 2 frames, 20 ms: each begins with a step of pulse');
    expect(rows(shown)).toEqual([
      ['runner[0]', '', '2 ms', '—', '—'], ['runner[1]', '', '—', '—', '—'], ['judge', '', '1 ms', '—', '—'],
    ]);
    const drawn = [...shown.root.querySelectorAll('svg')];
    expect(drawn.map((one) => one.getAttribute('aria-label'))).toEqual([
      'runner[0]: 1 steps, 2 ms per frame', 'runner[1]: 0 steps, 0 ms per frame', 'judge: 1 steps, 1 ms per frame',
    ]);
    expect(drawn[0]!.querySelector('.busy')!.getAttribute('d')).toBe('M100.0 0H300.0V10H100.0z');
    expect(drawn[0]!.querySelector('.frame')!.getAttribute('d')).toBe('M0.0 0V10M500.0 0V10M1000.0 0V10');
    expect(shown.find('a').getAttribute('href')).toBe('#/units/runner%5B0%5D');
  });

  it('shows the newest result of each, of a list the one that came last', async () => {
    const shown = await open();
    expect(host.watches.map((watch) => watch.key)).toEqual(['slot:efforts[0]', 'slot:efforts[1]']);
    const last = ['fresh', 'tired'].map((mood, i) => ({ mood, entrant: { number: 10 + i } }));
    host.publish('slot:efforts[0]', { count: 4, last });
    host.publish('slot:efforts[1]', { count: 0, last });
    await settled(shown.widget);
    expect([...shown.root.querySelectorAll('thead th')].map((head) => head.textContent!.trim())).toEqual(['Unit', 'Work', 'Per frame', 'Mood', 'Number']);
    expect(rows(shown).map((row) => row.slice(3))).toEqual([['tired', '11'], ['—', '—'], ['—', '—']]);
    host.publish('slot:efforts[0]', { count: 5, last });
    host.publish('slot:efforts[1]', null, { reason: 'writer retired' });
    await settled(shown.widget);
    expect(rows(shown).map((row) => row.slice(3))).toEqual([['fresh', '10'], ['writer retired', '—'], ['—', '—']]);
  });

  it('shows what a thread learned of the time between arrivals', async () => {
    const shown = await open();
    const threads = (mean_ns: number): object[] => [{ name: 'main', backoff: null }, { name: 'running', backoff: { mean_ns, spread_ns: 0.25 * ms } }];
    host.count('threads', threads(0));
    await settled(shown.widget);
    expect(rows(shown).map((row) => row.at(-1))).toEqual(['not known yet', 'not known yet', '']);
    host.count('threads', threads(33.333 * ms));
    await settled(shown.widget);
    expect(rows(shown).map((row) => row.at(-1))).toEqual(['33.3 ms ± 0.25 ms', '33.3 ms ± 0.25 ms', '']);
    host.count('threads', threads(42_100));
    await settled(shown.widget);
    expect(rows(shown)[0]!.at(-1)).toBe('42.1 µs ± 0.25 ms');
  });

  it('says where steps are missing, and ends what it began', async () => {
    const shown = await open();
    host.count('steps', [{ thread: 'main', begin_ns: 0, cut: false, steps: [0, 0, 1] }, { thread: 'running', begin_ns: 0, cut: false, steps: [1, 1, 1] }]);
    host.count('steps', [{ thread: 'main', begin_ns: 10, cut: false, steps: [0, 0, 1, 0, 10, 1] }, { thread: 'running', begin_ns: 15, cut: true, steps: [1, 0, 1] }]);
    await settled(shown.widget);
    expect(shown.text('.missing')).toBe('▲ some steps are missing');
    shown.widget.remove();
    expect(host.watches).toEqual([]);
    expect(host.lists.get('steps')!.size + host.lists.get('threads')!.size).toBe(0);
  });
});
