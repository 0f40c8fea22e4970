import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import { sample } from '../../core/tests/sample';
import type { SavedValues } from '../../core/protocol';
import { standingOf, type ValuesSaver } from '../values_saver';
import { FakeCore } from '../../core/tests/fake_core';

const saved: SavedValues = { file: true, on: 'change', unsaved: false, saved_at_ms: 1_700_000_000_000, writings: 1, failure: '' };

describe('how it stands with the configuration file', () => {
  it('says when it was saved, that it is not, or why not', () => {
    const time = new Date(1_700_000_000_000).toLocaleTimeString();
    expect(standingOf(saved).text).toBe(`Saved at ${time}. The file was written once since the start.`);
    expect(standingOf({ ...saved, writings: 240 }).text).toBe(`Saved at ${time}. The file was written 240 times since the start.`);
    expect(standingOf({ ...saved, saved_at_ms: null }).text).toContain('Nothing was changed');
    expect(standingOf({ ...saved, unsaved: true })).toEqual({ text: 'Not saved yet: that follows by itself.', kind: '' });
    expect(standingOf({ ...saved, unsaved: true, on: 'command' }).kind).toBe('warning');
    expect(standingOf({ ...saved, unsaved: true, failure: 'disk full' })).toEqual({ text: '✕ Not saved: disk full', kind: 'alarm' });
  });
});

describe('the button Save now', () => {
  let fake: FakeCore;
  let view: ValuesSaver;
  const button = (): HTMLButtonElement => view.shadowRoot!.querySelector('button')!;
  const turn = async (): Promise<void> => {
    await Promise.resolve();
    await view.updateComplete;
  };
  beforeEach(async () => {
    fake = new FakeCore(sample);
    fake.says({ values: { ...saved, unsaved: true } });
    view = document.createElement('flexrf-values-saver') as ValuesSaver;
    Object.assign(view, { core: fake.core, host: fake.host });
    document.body.append(view);
    await view.updateComplete;
  });
  afterEach(() => view.remove());

  it('saves, and says that it is done', async () => {
    button().click();
    await turn();
    expect(fake.requests).toEqual([{ op: 'save_values', fields: {} }]);
    expect(fake.said).toEqual(['The values are saved.']);
  });
  it('says why it was not done', async () => {
    fake.answer = () => ({ ok: false, problem: { title: 'Not in this state', detail: 'The values were not saved: disk full.' } });
    button().click();
    await turn();
    expect(fake.said).toEqual(['The values were not saved: disk full.']);
  });
  it('is dead with a reason where it can do nothing', async () => {
    fake.denied = 'You have no control.';
    fake.says({ values: saved });
    await turn();
    expect(button().getAttribute('aria-disabled')).toBe('true');
    expect(view.shadowRoot!.querySelector('#why')!.textContent).toBe('You have no control.');
    button().click();
    await turn();
    expect(fake.requests).toEqual([]);
  });
  it('shows a failure as an alarm', async () => {
    fake.says({ values: { ...saved, unsaved: true, failure: 'disk full' } });
    await turn();
    expect(view.shadowRoot!.querySelector('[role=alert]')!.textContent).toContain('disk full');
  });
});
