import { afterEach, expect, it } from 'vitest';
import '../threads';
import { triggerText, type Threads } from '../threads';
import { cell } from '../../core/tests/cell';
import { FakeCore } from '../../core/tests/fake_core';

const histogram = { count: 1000, p50_ns: 20_000, p99_ns: 60_000, 'p99.9_ns': 120_000, max_ns: 150_000, buckets: [200, 900, 240, 100] };
const row = {
  name: 'control', cycles: 1000, overruns: 3, skipped: 0, skipped_time_ns: 0, longest_standstill_ns: 0, allocations: 0, budget_ns: 100_000, response_estimate_ns: 250_000,
  cpu: 1, cpu_time_ns: 5, lateness: { ...histogram, count: 0, buckets: [] }, execution: histogram,
};

let view: Threads;
afterEach(() => view.remove());

it('shows durations, overruns and the budget against what was measured', async () => {
  const fake = new FakeCore(cell);
  view = document.createElement('flexrf-threads') as Threads;
  Object.assign(view, { core: fake.core, host: fake.host, path: [] });
  document.body.append(view);
  fake.topic('threads', [row]);
  await view.updateComplete;
  const text = view.shadowRoot!.textContent!.replace(/\s+/g, ' ');
  expect(text).toContain('▲ Over budget: Execution p99.9 is 120 µs, 120 % of the budget of 100 µs.');
  expect(text).toContain('Overruns ▲ 3');
  expect(text).toContain('number 1');
  const quantiles = [...view.shadowRoot!.querySelectorAll('tbody tr')].map((line) => line.textContent!.replace(/\s+/g, ' ').trim());
  expect(quantiles).toEqual(['Lateness ––––', 'Execution 20.0 µs60.0 µs120 µs150 µs']);
  const charts = [...view.shadowRoot!.querySelectorAll('svg[role=img]')];
  expect(charts.map((chart) => chart.querySelectorAll('.mark').length)).toEqual([0, 3]);
  expect(charts[1]!.getAttribute('aria-label')).toContain('longest 150 µs');
});

it('says what releases a thread', () => {
  const thread = cell.threads[0]!;
  expect(triggerText(thread)).toBe('its period of 1.00 ms');
  expect(triggerText({ ...thread, trigger: { kind: 'slots', sources: ['keys', 'target'], timeout_ns: 1e8 } })).toBe('slots keys, target, or after 100 ms');
  expect(triggerText({ ...thread, trigger: { kind: 'device', device: 'arm' } })).toBe('device arm');
});
