import { afterEach, describe, expect, it } from 'vitest';
import { displayUnits } from '../../core/units';
import { makeItem, settled, show } from '../tests/fake_host';

afterEach(() => {
  document.body.replaceChildren();
  displayUnits.si = false;
});

describe('number', () => {
  it('shows label, unit and a value with a fixed number of decimals', async () => {
    const shown = await show(makeItem({ unit: 'm', range: [0, 0.1] }));
    shown.host.publish('jog.step', 0.01);
    expect(shown.text('#label')).toBe('Step');
    expect(shown.text('.unit')).toBe('mm');
    expect(shown.text('.value')).toBe('10.0');
    shown.host.publish('jog.step', -0.0000001);
    expect(shown.text('.value')).toBe('0.0');
  });

  it('is described by its summary, unit and range', async () => {
    const shown = await show(makeItem({ unit: 'm', range: [0, 0.1] }));
    const row = shown.find('.row');
    expect(row.getAttribute('aria-labelledby')).toBe('label');
    expect(shown.find(`#${row.getAttribute('aria-describedby')}`).textContent).toBe('How far one press moves. In mm. From 0 to 100 mm.');
    expect(shown.root.querySelector('[aria-live], output')).toBeNull();
  });

  it('draws a bar from zero', async () => {
    const shown = await show(makeItem({ range: [-1, 1] }));
    const bar = shown.find<HTMLElement>('.bar > i');
    shown.host.publish('jog.step', 0.5);
    expect(bar.style.transform).toBe('translateX(50.0%) scaleX(0.250)');
    shown.host.publish('jog.step', -1);
    expect(bar.style.transform).toBe('translateX(0.0%) scaleX(0.500)');
    shown.host.publish('jog.step', 7);
    expect(bar.style.transform).toBe('translateX(50.0%) scaleX(0.500)');
  });

  it('has no bar without a range', async () => {
    expect((await show(makeItem())).root.querySelector('.bar')).toBeNull();
  });

  it('writes into one text node, without rendering', async () => {
    const shown = await show(makeItem());
    const text = shown.find('.value').firstChild;
    let renders = 0;
    (shown.widget as unknown as { updated: () => void }).updated = () => void (renders += 1);
    for (let i = 0; i < 100; ++i) shown.host.publish('jog.step', i);
    await settled(shown.widget);
    expect(shown.find('.value').firstChild).toBe(text);
    expect(renders).toBe(0);
  });

  it('says why there is no value', async () => {
    const shown = await show(makeItem());
    expect(shown.text('.value')).toBe('—');
    expect(shown.text('#absence')).toBe('no value yet');
    shown.host.publish('jog.step', null, { reason: 'the unit that writes it was stopped' });
    expect(shown.text('.value')).toBe('—');
    expect(shown.text('#absence')).toBe('the unit that writes it was stopped');
    shown.host.publish('jog.step', 1);
    expect(shown.text('#absence')).toBe('');
  });

  it('marks what is no number, and what is beyond its limits, by a word', async () => {
    const shown = await show(makeItem(), {
      placement: { name: 'w', kind: 'number', label: '', place: '', slots: {}, parameters: {}, options: { low: 1, high: 2 } },
    });
    shown.host.publish('jog.step', Number.NaN);
    expect(shown.text('.value')).toBe('NaN');
    expect(shown.text('.abnormal')).toBe('⚠ not a number');
    shown.host.publish('jog.step', 3);
    expect(shown.text('.abnormal')).toBe('▲ high');
    shown.host.publish('jog.step', 0);
    expect(shown.text('.abnormal')).toBe('▼ low');
    shown.host.publish('jog.step', 1.5);
    expect(shown.text('.abnormal')).toBe('');
  });

  it('turns stale and fresh again', async () => {
    const shown = await show(makeItem());
    shown.host.grow(true);
    expect(shown.widget.hasAttribute('stale')).toBe(true);
    shown.host.grow(false);
    expect(shown.widget.hasAttribute('stale')).toBe(false);
  });

  it('follows the choice of units', async () => {
    const shown = await show(makeItem({ unit: 'rad', range: [0, 1] }));
    shown.host.publish('jog.step', 0.5);
    expect(shown.text('.value')).toBe('28.65');
    displayUnits.si = true;
    await settled(shown.widget);
    expect(shown.text('.value')).toBe('0.500');
    expect(shown.text('.unit')).toBe('rad');
  });

  it('ends its watch when it leaves the document, and begins again when it comes back', async () => {
    const shown = await show(makeItem());
    shown.widget.remove();
    expect(shown.host.watches).toHaveLength(0);
    document.body.append(shown.widget);
    expect(shown.host.watches).toHaveLength(1);
  });

  it('shows the placed item under the label of its row', async () => {
    const item = makeItem({ key: 'slot:joints.load' });
    const shown = await show(item, {
      placement: { name: 'load', kind: 'number', label: 'Load', place: '', slots: { value: 'joints.load' }, parameters: {}, options: {} },
    });
    expect(shown.text('#label')).toBe('Load');
  });
});

describe('vector and matrix', () => {
  it('shows each element under its index', async () => {
    const shown = await show(makeItem({ shape: [2], unit: 'rad' }));
    shown.host.publish('jog.step', [Math.PI / 2, -Math.PI]);
    expect([...shown.root.querySelectorAll('.cell')].map((cell) => cell.textContent)).toEqual(['090.0', '1−180.0']);
  });

  it('shows each element in its own unit, where they differ', async () => {
    const shown = await show(makeItem({ shape: [3], unit: 'rad|m', units: ['rad', 'm'] }));
    shown.host.publish('jog.step', [Math.PI / 2, 0.25, 0]);
    expect([...shown.root.querySelectorAll('.cell')].map((cell) => cell.textContent.trim())).toEqual(['090.00 °', '1250.0 mm', '20.000']);
  });

  it('names the axes of a position', async () => {
    const shown = await show(makeItem({ key: 'slot:pose.position', shape: [3] }));
    expect([...shown.root.querySelectorAll('.index')].map((one) => one.textContent)).toEqual(['x', 'y', 'z']);
  });

  it('shows rows and columns, and a dash for what is missing', async () => {
    const shown = await show(makeItem({ shape: [2, 2], scalar: 'i32' }));
    shown.host.publish('jog.step', [[1, 2], [3]]);
    const rows = [...shown.root.querySelectorAll('tbody tr')];
    expect(rows.map((row) => [...row.querySelectorAll('.value')].map((cell) => cell.textContent))).toEqual([['1', '2'], ['3', '—']]);
    expect(shown.find('.scroll').getAttribute('tabindex')).toBe('0');
  });

  it('shows the first of many, and how many more there are', async () => {
    const shown = await show(makeItem({ shape: [80000], scalar: 'u8' }));
    expect(shown.root.querySelectorAll('.cell')).toHaveLength(64);
    expect(shown.text('.notes')).toContain('79936 more');
  });

  it('shows bools and enumerations in words', async () => {
    const shown = await show(makeItem({ shape: [2], scalar: 'bool' }));
    shown.host.publish('jog.step', [true, false]);
    expect([...shown.root.querySelectorAll('.value')].map((cell) => cell.textContent)).toEqual(['on', 'off']);
  });
});

describe('lamp', () => {
  it('tells its state by a word', async () => {
    const shown = await show(makeItem({ scalar: 'bool' }));
    expect(shown.find('.state').getAttribute('data-state')).toBe('none');
    shown.host.publish('jog.step', true);
    expect(shown.text('.value')).toBe('on');
    expect(shown.find('.state').getAttribute('data-abnormal')).toBe('false');
    shown.host.publish('jog.step', false);
    expect(shown.text('.value')).toBe('off');
  });

  it('stands out only in the state that the table calls abnormal', async () => {
    const shown = await show(makeItem({ scalar: 'bool' }), {
      placement: { name: 'w', kind: 'lamp', label: '', place: '', slots: {}, parameters: {}, options: { abnormal: false, off: 'open' } },
    });
    shown.host.publish('jog.step', false);
    expect(shown.text('.value')).toBe('⚠ open');
    expect(shown.find('.state').getAttribute('data-abnormal')).toBe('true');
  });
});

describe('enumeration and text', () => {
  it('shows the name in words', async () => {
    const shown = await show(makeItem({ scalar: 'enumeration', values: ['not_seen', 'red'] }));
    shown.host.publish('jog.step', 'not_seen');
    expect(shown.text('.value')).toBe('not seen');
  });

  it('marks values that the table calls abnormal', async () => {
    const shown = await show(makeItem({ scalar: 'enumeration', values: ['ok', 'fault'] }), {
      placement: { name: 'w', kind: 'enumeration', label: '', place: '', slots: {}, parameters: {}, options: { abnormal: 'blocked, fault' } },
    });
    shown.host.publish('jog.step', 'fault');
    expect(shown.text('.value')).toBe('⚠ fault');
    expect(shown.find('.value').classList.contains('abnormal')).toBe(true);
    shown.host.publish('jog.step', null, { reason: 'nothing yet' });
    expect(shown.text('.value')).toBe('—');
    expect(shown.find('.value').classList.contains('abnormal')).toBe(false);
  });

  it('shows a text as text', async () => {
    const shown = await show(makeItem({ scalar: 'text' }));
    shown.host.publish('jog.step', '<b>no</b>');
    expect(shown.text('.value')).toBe('<b>no</b>');
  });
});

describe('structure and records', () => {
  const members = [
    makeItem({ key: 'slot:spot.x', label: 'X', unit: 'm', kind: 'slot' }),
    makeItem({ key: 'slot:spot.seen', label: 'Seen', scalar: 'bool', kind: 'slot' }),
  ];

  it('gives each member its widget', async () => {
    const shown = await show(makeItem({ key: 'slot:spot', label: 'Spot', scalar: 'structure', kind: 'slot', members }));
    expect(shown.text('legend')).toBe('Spot');
    const children = [...shown.find('.members').children];
    expect(children.map((child) => child.localName)).toEqual(['flexrf-widget-number', 'flexrf-widget-lamp']);
    await settled(children[0]);
    shown.host.publish('slot:spot.x', 0.25);
    expect(children[0]!.shadowRoot!.querySelector('.value')!.textContent).toBe('250.0');
  });

  it('shows an array of structures as a table', async () => {
    const item = makeItem({ key: 'slot:spots', scalar: 'structure', shape: [2], kind: 'slot', members });
    const shown = await show(item);
    shown.host.publish('slot:spots', [{ x: 1, seen: true }, { x: 2, seen: false }]);
    expect([...shown.root.querySelectorAll('.value')].map((cell) => cell.textContent)).toEqual(['1000', 'on', '2000', 'off']);
    shown.host.publish('slot:spots', null, { reason: 'nothing yet' });
    expect([...shown.root.querySelectorAll('.value')].map((cell) => cell.textContent)).toEqual(['—', '—', '—', '—']);
  });
});
