// A button is dead, and says why, while it could do nothing.
import { afterEach, expect, it } from 'vitest';
import type { ItemInfo } from '../../contract';
import { FakeHost, settled, show } from '../tests/fake_host';

const state: ItemInfo = {
  key: 'sequence.feedback.state', label: 'State', summary: '', scalar: 'enumeration', shape: [], unit: '', kind: 'feedback',
  values: ['off', 'ready', 'held'],
};
const start: ItemInfo = {
  key: 'sequence.start', label: 'Start', summary: 'Begins.', scalar: 'button', shape: [], unit: '', kind: 'runtime', role: 'operator',
  needs: [
    { reason: 'needs motion to be permitted; give Start' },
    { reason: 'needs state to be ready or held', key: state.key, numbers: [1, 2] },
    { reason: 'needs enabled to be on', key: 'sequence.enabled', numbers: [1] },
  ],
};

afterEach(() => document.body.replaceChildren());

it('follows what it needs', async () => {
  const host = new FakeHost();
  host.items.set(state.key, state);
  const { widget, root, find } = await show(start, {}, 'button', host);
  const control = (): HTMLButtonElement => find<HTMLButtonElement>('#control');
  const reason = (): string | undefined => root.querySelector('.need')?.textContent ?? undefined; // its line is always there
  expect(control().disabled).toBe(false); // nothing is known yet: the application judges
  host.publish(state.key, 'off');
  host.publish('sequence.enabled', false);
  await settled(widget);
  expect(control().disabled).toBe(true);
  expect(reason()).toBe('needs state to be ready or held');
  control().click();
  expect(host.press).not.toHaveBeenCalled();
  host.publish(state.key, 'held');
  await settled(widget);
  expect(reason()).toBe('needs enabled to be on');
  host.publish('sequence.enabled', true);
  await settled(widget);
  expect(control().disabled).toBe(false);
  expect(reason()).toBe('');
  // The unit is gone, and its feedback with it.
  host.publish(state.key, null);
  await settled(widget);
  expect(control().disabled).toBe(true);
});

it('says in the same line what else is in the way', async () => {
  const host = new FakeHost();
  const { widget, root } = await show(start, {}, 'button', host);
  for (const reason of ['anna has control', 'needs motion to be permitted; give Start']) {
    host.lock(reason);
    await settled(widget);
    expect(root.querySelector('.need')?.textContent).toBe(reason);
  }
});

it('has no such line where nothing is needed', async () => {
  const host = new FakeHost();
  const { needs: _, ...plain } = start;
  const { root } = await show(plain, {}, 'button', host);
  expect(root.querySelector('.need')).toBeNull();
});
