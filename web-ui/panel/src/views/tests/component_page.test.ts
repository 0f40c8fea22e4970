import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import '../components';
import type { ComponentButtons } from '../component_buttons';
import type { ComponentPage } from '../component_page';
import type { ViewBase } from '../view_base';
import { cell, driven } from '../../core/tests/cell';
import { FakeCore, quiet, reading } from '../../core/tests/fake_core';

const alive = (name: string, more: object = {}) => ({
  name, kind: 'unit', type: 'drive', life: 'running', fault: '', restraint: '', restraints: 0, budget_overruns: 0, active: true, member: { population: 'axis', index: Number(name.at(-2)) },
  steps: 10, execution: { mean_ns: 1500, max_ns: 9000 }, ...more,
});

let fake: FakeCore;
let view: ViewBase;

async function shown(tag: 'flexrf-units' | 'flexrf-devices', path: readonly string[]): Promise<void> {
  view = document.createElement(tag) as ViewBase;
  Object.assign(view, { core: fake.core, host: fake.host, path });
  document.body.append(view);
  await settled();
}
async function settled(): Promise<void> {
  for (let i = 0; i < 4; ++i) await new Promise((resolve) => setTimeout(resolve, 0));
}

const page = (): ComponentPage => view.shadowRoot!.querySelector('flexrf-component-page')!;
const buttons = (): ComponentButtons => page().shadowRoot!.querySelector('flexrf-component-buttons')!;
const button = (label: string): HTMLButtonElement =>
  [...buttons().shadowRoot!.querySelectorAll('button')].find((one) => one.textContent!.trim() === label)!;
const dead = (one: Element): boolean => one.getAttribute('aria-disabled') === 'true';
const text = (element: Element): string => element.shadowRoot!.textContent!.replace(/\s+/g, ' ');

beforeEach(() => (fake = new FakeCore(cell)));
afterEach(() => view.remove());

describe('the list', () => {
  it('shows each with its state, faults first', async () => {
    await shown('flexrf-units', []);
    fake.topic('components', [alive('axis[0]', { life: 'fault', fault: 'too hot' }), alive('axis[1]', { active: false })]);
    await settled();
    const list = view.shadowRoot!.querySelector('flexrf-component-list')!;
    expect(text(list)).toContain('is in fault: too hot');
    expect(text(list)).toContain('ready, not active');
    expect(list.shadowRoot!.querySelector('tbody a')!.getAttribute('href')).toBe('#/units/axis%5B0%5D');
  });

  it('turns grey with all that it says, also when it is opened then', async () => {
    await shown('flexrf-units', []);
    fake.topic('components', [alive('axis[0]', { life: 'fault', fault: 'too hot' })]);
    const list = (): ShadowRoot => view.shadowRoot!.querySelector('flexrf-component-list')!.shadowRoot!;
    const old = (): number => [...list().querySelectorAll('.scroll, .box')].filter((one) => one.classList.contains('stale')).length;
    await settled();
    expect(old()).toBe(0);
    fake.turns(true);
    await settled();
    expect(old()).toBe(2);
    view.remove();
    await shown('flexrf-units', []);
    expect(old()).toBe(1);
    fake.turns(false);
    await settled();
    expect(old()).toBe(0);
  });

  it('says that a name is none', async () => {
    await shown('flexrf-devices', ['axis[0]']);
    expect(text(view)).toContain('no device of this name');
  });
});

describe('the page of a unit', () => {
  beforeEach(async () => {
    await shown('flexrf-units', ['axis[0]']);
    fake.topic('components', [alive('axis[0]'), alive('axis[1]', { active: false })]);
    await settled();
  });

  it('locks what its state does not permit, with the reason', () => {
    expect(dead(button('Start'))).toBe(true);
    expect(button('Start').parentElement!.textContent).toContain('It is running.');
    expect(dead(button('Stop'))).toBe(false);
    expect(dead(button('Retire'))).toBe(false);
    button('Start').click();
    expect(fake.requests).toEqual([]);
  });

  it('locks everything without role or token, and says so once', async () => {
    fake.denied = 'needs engineer';
    fake.says({});
    await settled();
    expect(['Stop', 'Initialise', 'Retire'].every((label) => dead(button(label)))).toBe(true);
    expect(text(buttons()).match(/needs engineer/g)).toHaveLength(1);
  });

  it('acts, and tells what was refused', async () => {
    fake.answer = () => ({ ok: false, problem: { title: 'Conflict', detail: 'it does not stop' } });
    button('Stop').click();
    await settled();
    expect(fake.requests).toEqual([{ op: 'action', fields: { component: 'axis[0]', action: 'stop' } }]);
    expect(fake.said).toEqual(['axis[0]: Stop failed: it does not stop']);
  });

  it('shows cause and remedy of a fault', async () => {
    fake.says({ faults: [{ component: 'axis[0]', kind: 'unit', since_ns: 1, cause: 'too hot' }] });
    fake.topic('components', [alive('axis[0]', { life: 'fault', fault: 'too hot' })]);
    await settled();
    expect(page().shadowRoot!.querySelector('[role=alert]')!.textContent!.replace(/\s+/g, ' ')).toContain('Cause too hot Remedy Remove the cause, then initialise axis[0]');
  });

  // [exec-25]
  it('says what holds it back, and that something did', async () => {
    const text = (): string => page().shadowRoot!.textContent!.replace(/\s+/g, ' ');
    fake.topic('components', [alive('axis[0]', { restraint: 'a velocity above `fastest` is not taken: 3 was asked for, 1 is done', restraints: 1 })]);
    await settled();
    expect(text()).toContain('▲ Restrained: a velocity above `fastest` is not taken: 3 was asked for, 1 is done');
    fake.topic('components', [alive('axis[0]', { restraints: 2 })]);
    await settled();
    expect(text()).toContain('Restrained 2 times: the log says by what.');
  });

  it('says how often a step exceeded its budget', async () => {
    const text = (): string => page().shadowRoot!.textContent!.replace(/\s+/g, ' ');
    fake.topic('components', [alive('axis[0]', {})]);
    await settled();
    expect(text()).toContain('Budget50.0 µs Restart');
    fake.topic('components', [alive('axis[0]', { budget_overruns: 1200 })]);
    await settled();
    expect(text()).toContain('Budget50.0 µs, ▲ exceeded in 1 200 steps');
  });

  it('turns grey: state, fault, times, members', async () => {
    fake.topic('components', [alive('axis[0]', { life: 'fault', fault: 'too hot' })]);
    fake.turns(true);
    await settled();
    const old = (): string[] => [...page().shadowRoot!.querySelectorAll(':is(p, div, dl, table).stale')].map((one) => one.localName);
    expect(old()).toEqual(['p', 'div', 'dl', 'table']);
    fake.turns(false);
    await settled();
    expect(old()).toEqual([]);
  });

  it('shows ports with links, ages and why they are NULL', async () => {
    fake.value('slot:goal', reading(null, { reason: 'too old' }));
    const ages = [...page().shadowRoot!.querySelectorAll('flexrf-slot-age')].map((age) => age.textContent);
    expect(ages[0]).toBe('NULL: too old');
    expect(text(page())).toContain('not observed');
    expect(page().shadowRoot!.querySelector('a[href="#/blackboard/goal"]')).not.toBeNull();
  });

  it('lists the members of its population', () => {
    const members = [...page().shadowRoot!.querySelectorAll('[aria-current=page]')];
    expect(members.map((one) => one.textContent)).toEqual(['axis[0]']);
    expect(text(page())).toContain('ready, not active');
  });
});

describe('the page of a device', () => {
  it('shows the configuration of the driver that it has', async () => {
    await shown('flexrf-devices', ['motor']);
    const keys = (): unknown[] =>
      [...page().shadowRoot!.querySelectorAll<HTMLElement & { item: { key: string } }>('flexrf-item')].map(({ item }) => item.key);
    expect(keys()).toEqual(['motor.configuration.gear']);
    fake.topic('components', [alive('motor', { kind: 'device', driver: 'can', member: null })]);
    await settled();
    expect(keys()).toEqual(['motor.configuration.gear', 'motor.configuration.node']);
    expect(text(page())).toContain('can (real): On a bus.');
  });

  it('shows runtime parameters and feedback of its own driver, and none of another', async () => {
    const shownWith = async (driver: string): Promise<unknown[]> => {
      fake = new FakeCore(driven, { motor: driver });
      await shown('flexrf-devices', ['motor']);
      const keys = [...page().shadowRoot!.querySelectorAll<HTMLElement & { item: { key: string } }>('flexrf-item')].map(({ item }) => item.key);
      view.remove();
      return keys.filter((key) => !key.startsWith('motor.configuration.'));
    };
    expect(await shownWith('can')).toEqual(['motor.pace', 'motor.boost', 'motor.feedback.turns', 'motor.feedback.heat']);
    expect(await shownWith('model')).toEqual(['motor.pace', 'motor.feedback.turns']);
  });

  it('shows the widgets that the table places there', async () => {
    await shown('flexrf-devices', ['motor']);
    expect([...page().shadowRoot!.querySelectorAll('h3')].map((one) => one.textContent)).toContain('The wheel');
    expect(page().shadowRoot!.querySelector('flexrf-placement')).toHaveProperty('placement.kind', 'wheel');
  });
});

describe('a member that is not active', () => {
  it('becomes a clone of one that is', async () => {
    await shown('flexrf-units', ['axis[1]']);
    fake.topic('components', [alive('axis[0]'), alive('axis[1]', { active: false })]);
    await settled();
    button('Clone').click();
    await settled();
    expect(fake.requests).toEqual([{ op: 'action', fields: { component: 'axis[1]', action: 'clone', source: 'axis[0]' } }]);
  });
});

describe('editing on the page', () => {
  const panel = (): ShadowRoot => page().shadowRoot!.querySelector('flexrf-edit-panel')!.shadowRoot!;
  const press = async (label: string): Promise<void> => {
    [...panel().querySelectorAll('button')].find((one) => one.textContent!.trim() === label)!.click();
    await settled();
  };

  it('goes from Edit over marked values to the outcome', async () => {
    fake.answer = (op) =>
      op === 'edit_begin'
        ? { ok: true, edit: '7', reinitialised: ['axis[0]', 'motor'], configuration: { 'axis[0]': { lag: 0.25, reach: 3 } } }
        : { ok: true, outcome: 'done', causes: [], owners: ['axis[0]', 'motor'] };
    await shown('flexrf-units', ['axis[0]']);
    fake.topic('components', [alive('axis[0]')]);
    await settled();
    await press('Edit');
    expect([...panel().querySelectorAll('ol a')].map((one) => one.textContent)).toEqual(['axis[0]', 'motor']);

    const item = page().shadowRoot!.querySelector('flexrf-item') as HTMLElement & { host: { set(key: string, value: number): Promise<unknown> } };
    await item.host.set('axis[0].configuration.lag', 0.75);
    await settled();
    expect(page().shadowRoot!.querySelector('.edited')!.textContent).toContain('in force');
    await press('Apply');
    expect(panel().textContent).toContain('Applied.');
    expect(panel().textContent).toContain('Initialised again: axis[0], motor.');
    await press('Close');
    expect(panel().textContent).toContain('Edit');
    expect(page().shadowRoot!.querySelector('.edited')).toBeNull();
  });

  it('shows what moves', async () => {
    fake.answer = () => ({ ok: false, problem: { title: 'Conflict', detail: 'motor may move', moving: ['motor'] } });
    await shown('flexrf-units', ['axis[0]']);
    await press('Edit');
    expect(panel().querySelector('[role=alert] a')!.getAttribute('href')).toBe('#/devices/motor');
  });

  it('is locked while another edits', async () => {
    await shown('flexrf-units', ['axis[0]']);
    const holder = { name: 'anna', user: 'anna', address: '10.0.0.1', local: false, you: false };
    fake.says({ ...quiet, edit: { holder, components: ['motor'], left_ms: 1 } });
    await settled();
    expect(panel().textContent).toContain('anna at 10.0.0.1 edits motor.');
    expect(dead(panel().querySelector('button')!)).toBe(true);
  });
});
