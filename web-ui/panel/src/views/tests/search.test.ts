import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import '../search';
import { sample } from '../../core/tests/sample';
import type { Search } from '../search';
import { cell } from '../../core/tests/cell';
import { FakeCore, FakeWidget, reading } from '../../core/tests/fake_core';

let fake: FakeCore;
let view: Search;

async function settled(): Promise<void> {
  for (let i = 0; i < 4; ++i) await new Promise((resolve) => setTimeout(resolve, 0));
}
async function shown(path: readonly string[] = []): Promise<void> {
  view = document.createElement('flexrf-search') as Search;
  Object.assign(view, { core: fake.core, host: fake.host, path });
  document.body.append(view);
  fake.value('jog.step', reading(0.02));
  fake.value('jog.configuration.lag', reading(0.75));
  await settled();
}
const root = (): ShadowRoot => view.shadowRoot!;
const found = (): (string | undefined)[] => [...root().querySelectorAll<FakeWidget>('fake-widget')].map((widget) => widget.item?.key);
async function press(label: string, from: ParentNode = root()): Promise<void> {
  [...from.querySelectorAll('button')].find((one) => (one.getAttribute('aria-label') ?? one.textContent!).trim() === label)!.click();
  await settled();
}
async function type(text: string): Promise<void> {
  const field = root().querySelector('input')!;
  field.value = text;
  field.dispatchEvent(new Event('input'));
  await settled();
}
const group = (): ShadowRoot => root().querySelector('flexrf-group-reset')!.shadowRoot!;

beforeEach(() => {
  localStorage.clear();
  fake = new FakeCore(sample);
});
afterEach(() => {
  view.remove();
  location.hash = '';
});

describe('search', () => {
  it('shows all that is declared and not hidden', async () => {
    await shown();
    expect(found()).toContain('jog.step');
    expect(found()).toContain('jog.configuration.lag');
    expect(found()).toContain('jog.feedback.mode');
    expect(found()).not.toContain('jog.feedback.presses');
    expect(root().querySelector('[role=status]')!.textContent).toBe(`${found().length} found`);
  });

  it('finds by the name that tables and scripts use, too', async () => {
    await shown();
    await type('jog.lag');
    expect(found()).toEqual(['jog.configuration.lag']);
    await type('jog.mode');
    expect(found()).toEqual(['jog.feedback.mode']);
  });

  it('keeps what is asked for in the address, and begins with that', async () => {
    await shown();
    await type('jog.lag 50%/x');
    expect(location.hash).toBe('#/search/all/jog.lag%2050%25%2Fx');
    await type('');
    expect(location.hash).toBe('#/search');
    await press('Modified');
    expect(location.hash).toBe('#/search/modified');
    view.remove();
    await shown(['modified', 'lag']);
    expect(root().querySelector('input')!.value).toBe('lag');
    expect(found()).toEqual(['jog.configuration.lag']);
    view.path = [];
    await settled();
    expect(root().querySelector('input')!.value).toBe('');
    expect(found()).toContain('jog.feedback.mode');
  });

  it('finds by name, label, summary and value, all words at once', async () => {
    await shown();
    for (const text of ['STEP', 'schritt', 'how far', '20.00 mm', 'jog far schritt']) {
      await type(text);
      expect(found(), text).toEqual(['jog.step']);
    }
    await type('step nowhere');
    expect(found()).toEqual([]);
    expect(root().textContent).toContain('Nothing has all these words');
  });

  it('shows what is modified, and keeps a row that is set back until something else is asked for', async () => {
    await shown();
    await press('Modified');
    expect(found()).toEqual(['jog.configuration.lag']);
    fake.value('jog.step', reading(0.03));
    await settled();
    expect(found()).toEqual(['jog.step', 'jog.configuration.lag']);
    fake.value('jog.step', reading(0.02));
    await settled();
    expect(found()).toContain('jog.step');
    await press('All');
    await press('Modified');
    expect(found()).toEqual(['jog.configuration.lag']);
  });

  it('remembers favourites for this application, on this computer', async () => {
    await shown();
    await press('Favourite: Schritt of jog');
    view.remove();
    await shown();
    await press('Favourites');
    expect(found()).toEqual(['jog.step']);
    await press('Favourite: Schritt of jog');
    await press('All');
    await press('Favourites');
    expect(root().textContent).toContain('Nothing is marked yet');
    localStorage.setItem('flexrf.favourites.sample', '{');
    view.remove();
    await shown();
    expect(found().length).toBeGreaterThan(0);
  });

  it('sets a group back after a question: runtime parameters only, in one request', async () => {
    await shown();
    expect(group().querySelector('button')).toBeNull();
    fake.value('jog.step', reading(0.03));
    fake.value('jog.gains', reading([[9, 2, 3], [4, 5, 6]]));
    await settled();
    await press('Reset 2 modified of jog', group());
    expect(group().textContent).toContain('Schritt, Gains');
    expect(fake.requests).toEqual([]);
    await press('No', group());
    expect(fake.requests).toEqual([]);
    await press('Reset 2 modified of jog', group());
    await press('Yes', group());
    expect(fake.requests).toEqual([{ op: 'reset', fields: { component: 'jog', parameters: ['step', 'gains'] } }]);
  });

  it('takes the newest change back, where it may', async () => {
    await shown();
    const undo = (): HTMLButtonElement => root().querySelector('flexrf-undo')!.shadowRoot!.querySelector('button')!;
    expect(undo().disabled).toBe(true);
    fake.host.history.note({ component: 'jog', before: { step: 0.02 }, after: { step: 0.03 } });
    await settled();
    expect(undo().getAttribute('aria-label')).toBe('Undo: Schritt of jog from 30.00 mm back to 20.00 mm');
    undo().click();
    expect(fake.requests).toEqual([{ op: 'undo', fields: {} }]);
    fake.denied = 'take control first';
    fake.says({});
    await settled();
    expect(undo().disabled).toBe(true);
    expect(undo().title).toBe('take control first');
  });

  it('shows of a device the configuration of the driver that it has', async () => {
    fake = new FakeCore(cell);
    await shown();
    const ofMotor = (): unknown[] => found().filter((key) => key?.startsWith('motor.configuration'));
    expect(ofMotor()).toEqual(['motor.configuration.gear']);
    fake.topic('components', [{ name: 'motor', kind: 'device', driver: 'can' }]);
    await settled();
    expect(ofMotor()).toEqual(['motor.configuration.gear', 'motor.configuration.node']);
    expect(fake.isWatched('motor.configuration.node')).toBe(true);
    fake.topic('components', [{ name: 'motor', kind: 'device', driver: 'model' }]);
    await settled();
    expect(ofMotor()).toEqual(['motor.configuration.gear']);
    expect(fake.isWatched('motor.configuration.node')).toBe(false);
  });

  it('watches nothing when it is gone', async () => {
    await shown();
    expect(fake.isWatched('jog.step')).toBe(true);
    view.remove();
    expect(fake.isWatched('jog.step')).toBe(false);
    expect(fake.isWatched('jog.configuration.lag')).toBe(false);
  });
});
