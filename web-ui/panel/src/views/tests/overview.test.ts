import { afterEach, describe, expect, it, vi } from 'vitest';
import { makeModel } from '../../core/descriptor';
import { sample } from '../../core/tests/sample';
import { chosenFeedback, type Overview } from '../overview';
import { FakeCore } from '../../core/tests/fake_core';

describe('the overview without anything placed', () => {
  it('shows feedback that is not hidden', () => {
    const keys = chosenFeedback(makeModel(sample)).map((item) => item.key);
    expect(keys).toEqual(['mode', 'note', 'moving', 'offset'].map((name) => `jog.feedback.${name}`));
  });
  it('gives each component its first values before any gets its last', () => {
    const units = Array.from({ length: 10 }, (_, index) => ({ ...sample.units[0]!, name: `jog_${index}` }));
    const keys = chosenFeedback(makeModel({ ...sample, units })).map((item) => item.key);
    expect(keys).toHaveLength(24);
    expect(units.every((unit) => keys.includes(`${unit.name}.feedback.mode`))).toBe(true);
    expect(keys.indexOf('jog_0.feedback.note')).toBe(keys.indexOf('jog_0.feedback.mode') + 1);
  });
});

describe('the overview without a word from the application', () => {
  let view: Overview;
  afterEach(() => view.remove());
  it('shows faults and state in grey', async () => {
    const fake = new FakeCore(sample);
    fake.says({ faults: [{ component: 'jog', kind: 'unit', since_ns: 1, cause: 'too hot' }] });
    view = document.createElement('flexrf-overview') as Overview;
    Object.assign(view, { core: fake.core, host: fake.host, path: [] });
    document.body.append(view);
    const old = (): string[] => [...view.shadowRoot!.querySelectorAll('.stale')].map((one) => one.localName);
    await view.updateComplete;
    expect(old()).toEqual([]);
    fake.turns(true);
    await view.updateComplete;
    expect(old()).toEqual(['dl', 'section']);
    expect(view.shadowRoot!.querySelector('section.stale')!.getAttribute('role')).toBe('alert');
  });
  it('tells what becomes of values, with a button where there is a file', async () => {
    const fake = new FakeCore(sample);
    const values = { file: false, on: 'change', unsaved: true, saved_at_ms: null, writings: 0, failure: '' } as const;
    fake.says({ values });
    view = document.createElement('flexrf-overview') as Overview;
    Object.assign(view, { core: fake.core, host: fake.host, path: [] });
    document.body.append(view);
    await view.updateComplete;
    expect(view.shadowRoot!.textContent).toContain('without --config FILE');
    expect(view.shadowRoot!.querySelector('flexrf-values-saver')).toBeNull();
    fake.says({ values: { ...values, file: true } });
    await view.updateComplete;
    await vi.waitFor(() => expect(view.shadowRoot!.querySelector('flexrf-values-saver')!.shadowRoot!.textContent).toContain('Save now'));
  });
});
