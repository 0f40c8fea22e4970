import { afterEach, describe, expect, it, vi } from 'vitest';
import type { Outcome } from '../../contract';
import { displayUnits } from '../../core/units';
import { FakeHost, key, makeParameter, pointer, settled, show, type, type Shown } from '../tests/fake_host';

afterEach(() => {
  document.body.replaceChildren();
  displayUnits.si = false;
});

const placed = (options: { [name: string]: boolean | number | string }) => ({
  placement: { name: 'w', kind: 'w', label: '', place: '', slots: {}, parameters: {}, options },
});

/** The next request is answered when the test says so. */
function hangSet(host: FakeHost): (outcome: Outcome) => Promise<void> {
  let answer = (_outcome: Outcome): void => undefined;
  host.set.mockImplementationOnce(() => new Promise((resolve) => (answer = resolve)));
  return async (outcome) => {
    answer(outcome);
    await settled();
  };
}

describe('a whole number of 64 bits', () => {
  const item = makeParameter({ scalar: 'u64', unit: '', default: 0 });

  it('is changed while the page can count it, and marked and left alone beyond', async () => {
    const { host, find, text } = await show(item);
    const field = find<HTMLInputElement>('#field');
    host.publish('jog.step', 2 ** 53 - 1);
    await settled();
    expect([field.value, field.disabled]).toEqual(['9007199254740991', false]);
    host.publish('jog.step', 18446744073709551615);
    await settled();
    expect([field.value, field.disabled]).toEqual(['≈ 18446744073709552000', true]);
    expect(text('#lock')).toContain('more digits than the page keeps');
    host.publish('jog.step', 7);
    await settled();
    expect([field.value, field.disabled]).toEqual(['7', false]);
  });
});

describe('slider', () => {
  const item = makeParameter({ unit: 'm', range: [0, 0.1], default: 0.01 });
  const make = async (): Promise<Shown & { slider: HTMLInputElement; field: HTMLInputElement }> => {
    const shown = await show(item);
    shown.host.publish('jog.step', 0.01);
    return { ...shown, slider: shown.find('#slider'), field: shown.find('#field') };
  };

  it('shows the value in force on slider and field, in the shown unit', async () => {
    const { slider, field } = await make();
    expect(slider.value).toBe('10');
    expect(field.value).toBe('10.0');
    expect([slider.min, slider.max]).toEqual(['0', '100']);
    expect(slider.getAttribute('aria-valuetext')).toBe('10.0 mm');
    expect(field.getAttribute('aria-valuenow')).toBe('10');
  });

  it('ignores echoes while a hand drags, and shows what the unit answered afterwards', async () => {
    const { host, slider, field } = await make();
    pointer(slider, 'pointerdown');
    host.set.mockResolvedValueOnce({ ok: true, values: { step: 0.05 } });
    type(slider, '60');
    host.publish('jog.step', 0.02);
    await settled();
    expect(host.set).toHaveBeenCalledWith('jog.step', 0.06);
    expect(slider.value).toBe('60');
    expect(field.value).toBe('60.0');
    pointer(window, 'pointerup');
    expect(slider.value).toBe('50');
    host.publish('jog.step', 0.03);
    expect(slider.value).toBe('30');
  });

  it('does not move under the hand when a value is refused; goes back when it lets go', async () => {
    const { host, slider, text } = await make();
    pointer(slider, 'pointerdown');
    host.set.mockResolvedValueOnce({ ok: false, detail: 'too far while the arm moves' });
    type(slider, '90');
    await settled();
    expect(slider.value).toBe('90');
    expect(text('#refusal')).toBe('too far while the arm moves');
    pointer(window, 'pointerup');
    expect(slider.value).toBe('10');
    expect(text('#refusal')).toBe('too far while the arm moves');
  });

  it('ends the drag on cancel and when the window loses the focus', async () => {
    for (const name of ['pointercancel', 'blur']) {
      const { host, slider } = await make();
      pointer(slider, 'pointerdown');
      host.publish('jog.step', 0.02);
      expect(slider.value).toBe('10');
      pointer(window, name);
      expect(slider.value).toBe('20');
    }
  });

  it('steps by buttons and keys, fine and coarse, within its range', async () => {
    const { host, slider, root } = await make();
    root.querySelector<HTMLButtonElement>('[data-step="+"]')!.click();
    await settled();
    expect(host.set).toHaveBeenLastCalledWith('jog.step', 0.0105);
    root.querySelector<HTMLButtonElement>('[data-step="−−"]')!.click();
    await settled();
    expect(host.set).toHaveBeenLastCalledWith('jog.step', 0.0055);
    expect(key(slider, 'keydown', 'PageUp').defaultPrevented).toBe(true);
    await settled();
    expect(host.set).toHaveBeenLastCalledWith('jog.step', 0.0105);
    key(slider, 'keydown', 'ArrowLeft', { shiftKey: true });
    key(slider, 'keydown', 'ArrowDown', { shiftKey: true });
    key(slider, 'keydown', 'ArrowDown', { shiftKey: true });
    await settled();
    expect(host.set).toHaveBeenLastCalledWith('jog.step', 0);
  });

  it('lets Home and End to the browser', async () => {
    const { slider } = await make();
    expect(key(slider, 'keydown', 'Home').defaultPrevented).toBe(false);
  });

  it('is dead without a value', async () => {
    const { host, slider } = await make();
    host.publish('jog.step', null, { reason: 'the unit that writes it was stopped' });
    expect(slider.disabled).toBe(true);
  });

  it('asks before it sends where the table says so, once per drag', async () => {
    const shown = await show(item, placed({ confirm: 'Really faster?' }));
    const slider = shown.find<HTMLInputElement>('#slider');
    shown.host.publish('jog.step', 0.01);
    pointer(slider, 'pointerdown');
    type(slider, '50');
    type(slider, '60');
    pointer(window, 'pointerup');
    await settled(shown.widget);
    expect(shown.host.set).not.toHaveBeenCalled();
    expect(shown.text('.question [role="alert"]')).toBe('Really faster?');
    shown.find<HTMLButtonElement>('#no').click();
    await settled(shown.widget);
    expect(slider.value).toBe('10');
    pointer(slider, 'pointerdown');
    type(slider, '60');
    pointer(window, 'pointerup');
    await settled(shown.widget);
    shown.find<HTMLButtonElement>('#yes').click();
    await settled(shown.widget);
    expect(shown.host.set).toHaveBeenCalledExactlyOnceWith('jog.step', 0.06);
    expect(shown.root.querySelector('.question')).toBeNull();
  });
});

describe('number field', () => {
  const make = async (more = {}): Promise<Shown & { field: HTMLInputElement }> => {
    const shown = await show(makeParameter({ unit: 'rad', ...more }));
    shown.host.publish('jog.step', 0);
    return { ...shown, field: shown.find('#field') };
  };

  it('sends what was typed on Enter, in SI', async () => {
    const { host, field } = await make();
    type(field, '180');
    expect(host.set).not.toHaveBeenCalled();
    key(field, 'keydown', 'Enter');
    expect(host.set).toHaveBeenCalledExactlyOnceWith('jog.step', 3.14159265358979);
  });

  it('sends what was typed when the field is left, but nothing when nothing was typed', async () => {
    const { host, field } = await make();
    field.dispatchEvent(new FocusEvent('blur'));
    expect(host.set).not.toHaveBeenCalled();
    type(field, '1');
    field.dispatchEvent(new FocusEvent('blur'));
    expect(host.set).toHaveBeenCalledTimes(1);
  });

  it('gives up on Escape', async () => {
    const { host, field } = await make();
    type(field, '180');
    key(field, 'keydown', 'Escape');
    field.dispatchEvent(new FocusEvent('blur'));
    expect(field.value).toBe('0.000');
    expect(host.set).not.toHaveBeenCalled();
  });

  it('ignores echoes while a person types', async () => {
    const { host, field } = await make();
    type(field, '1');
    host.publish('jog.step', 1);
    expect(field.value).toBe('1');
    key(field, 'keydown', 'Escape');
    expect(field.value).toBe('57.30');
  });

  it('says what is wrong with what was typed, and sends nothing', async () => {
    const { host, field, text } = await make({ range: [0, 1], widget: 'number_field' });
    type(field, 'abc');
    key(field, 'keydown', 'Enter');
    expect(text('#refusal')).toBe('“abc” is not a number');
    expect(field.value).toBe('0.00');
    type(field, '90');
    key(field, 'keydown', 'Enter');
    expect(text('#refusal')).toBe('only 0 to 57.2958 °');
    expect(host.set).not.toHaveBeenCalled();
  });

  it('shows what was asked for as busy until it is answered', async () => {
    const { host, field, widget } = await make();
    const answer = hangSet(host);
    type(field, '57.29577951308232');
    key(field, 'keydown', 'Enter');
    host.publish('jog.step', 0);
    expect(field.value).toBe('57.30');
    expect(field.getAttribute('aria-busy')).toBe('true');
    expect(widget.hasAttribute('pending')).toBe(true);
    await answer({ ok: false, detail: 'not now' });
    expect(field.value).toBe('0.000');
    expect(field.getAttribute('aria-busy')).toBe('false');
  });

  it('adds up steps while answers are under way', async () => {
    const { host, field } = await make({ unit: '1' });
    const answer = hangSet(host);
    key(field, 'keydown', 'ArrowUp');
    key(field, 'keydown', 'ArrowUp');
    key(field, 'keydown', 'ArrowUp');
    expect(host.set).toHaveBeenCalledTimes(1);
    await answer({ ok: true });
    expect(host.set).toHaveBeenLastCalledWith('jog.step', 0.03);
  });

  it('has steps that follow its value, and no smaller ones on the way', async () => {
    const range = [-1e6, 1e6] as const;
    const { host, field, root, widget } = await make({ range, default: -1000, unit: '1' });
    const label = (sign: string) => root.querySelector(`[data-step="${sign}"]`)!.getAttribute('aria-label');
    const step = async (sign: string): Promise<void> => {
      root.querySelector<HTMLButtonElement>(`[data-step="${sign}"]`)!.click();
      await settled(widget);
    };
    expect(root.querySelector('#slider')).toBeNull();
    host.publish('jog.step', -1000);
    await settled(widget);
    expect([label('+'), label('++')]).toEqual(['Increase Step by 10', 'Increase Step by 100']);
    await step('+');
    expect(host.set).toHaveBeenLastCalledWith('jog.step', -990);
    host.publish('jog.step', -990);
    await settled(widget);
    expect(label('+')).toBe('Increase Step by 10'); // it was stepped to
    host.publish('jog.step', 0.65);
    await settled(widget);
    expect(field.value).toBe('0.6500');
    expect(label('+')).toBe('Increase Step by 0.001');
    await step('+');
    expect(host.set).toHaveBeenLastCalledWith('jog.step', 0.651);
  });

  it('refuses what is a number in JavaScript only', async () => {
    const { host, field, text } = await make({ scalar: 'u32', unit: '' });
    type(field, '0x10');
    key(field, 'keydown', 'Enter');
    expect(text('#refusal')).toBe('“0x10” is not a number');
    expect(host.set).not.toHaveBeenCalled();
  });

  it('has a role, a name and a description', async () => {
    const { field, root } = await make();
    expect(field.getAttribute('role')).toBe('spinbutton');
    expect(root.getElementById(field.getAttribute('aria-labelledby')!)!.textContent).toBe('Step');
    const described = field.getAttribute('aria-describedby')!.split(' ').map((id) => root.getElementById(id));
    expect(described.every((element) => element !== null)).toBe(true);
    expect(root.querySelector('[data-step="++"]')!.getAttribute('aria-label')).toBe('Increase Step by 0.1 °');
  });
});

describe('keypad', () => {
  afterEach(() => void delete document.documentElement.dataset['touch']);

  const open = async (): Promise<Shown & { field: HTMLInputElement; press: (sign: string) => void }> => {
    document.documentElement.dataset['touch'] = 'large';
    const shown = await show(makeParameter());
    shown.host.publish('jog.step', 7);
    const field = shown.find<HTMLInputElement>('#field');
    field.focus();
    await settled(shown.widget);
    return { ...shown, field, press: (sign) => shown.find<HTMLButtonElement>(`[data-key="${sign}"]`).click() };
  };

  it('types into the field that has the focus, and keeps it there', async () => {
    const { host, field, press, find, root } = await open();
    expect(field.inputMode).toBe('none');
    for (const sign of ['1', '2', '⌫', '.', '5', '±']) press(sign);
    expect(field.value).toBe('-1.5');
    expect(host.set).not.toHaveBeenCalled();
    const down = new MouseEvent('mousedown', { bubbles: true, cancelable: true });
    find('[data-key="1"]').dispatchEvent(down);
    expect(down.defaultPrevented).toBe(true);
    press('✓');
    expect(host.set).toHaveBeenCalledExactlyOnceWith('jog.step', -1.5);
    expect(root.querySelector('.keypad')).not.toBeNull();
  });

  it('comes into sight, once, where it would lie below what is seen', async () => {
    const seen = vi.fn();
    Element.prototype.scrollIntoView = seen;
    try {
      const { widget, press } = await open();
      expect(seen.mock.contexts.map((one) => (one as Element).className)).toEqual(['keypad']);
      expect(seen).toHaveBeenCalledWith({ block: 'nearest' });
      press('1');
      await settled(widget);
      expect(seen).toHaveBeenCalledTimes(1);
    } finally {
      delete (Element.prototype as { scrollIntoView?: unknown }).scrollIntoView;
    }
  });

  it('gives up, and goes with the focus', async () => {
    const { host, field, press, root, widget } = await open();
    press('9');
    press('✕');
    expect(field.value).toBe('7.000');
    field.blur();
    await settled(widget);
    expect(root.querySelector('.keypad')).toBeNull();
    expect(host.set).not.toHaveBeenCalled();
  });

  it('is not there for a mouse', async () => {
    const { find, root, widget } = await show(makeParameter());
    find<HTMLInputElement>('#field').focus();
    await settled(widget);
    expect(root.querySelector('.keypad')).toBeNull();
  });
});

describe('lock and stale', () => {
  it('makes controls dead, with the reason', async () => {
    const { host, widget, find, root } = await show(makeParameter());
    host.publish('jog.step', 1);
    host.lock('take control first');
    await settled(widget);
    const controls = [...root.querySelectorAll<HTMLInputElement>('input, button')];
    expect(controls.every((control) => control.disabled)).toBe(true);
    expect(find('.controls').getAttribute('title')).toBe('take control first');
    expect(find('#lock').textContent).toBe('take control first');
    host.lock('');
    await settled(widget);
    expect(find<HTMLInputElement>('#field').disabled).toBe(false);
  });

  it('tells the reason to a finger only for a while', async () => {
    vi.useFakeTimers();
    try {
      const { host, find, text } = await show(makeParameter());
      host.lock('needs engineer');
      find<HTMLElement>('.controls').click();
      expect(text('#refusal')).toBe('Locked: needs engineer');
      vi.advanceTimersByTime(6000);
      expect(text('#refusal')).toBe('');
    } finally {
      vi.useRealTimers();
    }
  });

  it('puts a refusal away when it is touched, and not back with the next value', async () => {
    const { host, find, text } = await show(makeParameter());
    host.publish('jog.step', 1);
    type(find('#field'), 'abc');
    key(find('#field'), 'keydown', 'Enter');
    expect(text('#refusal')).toContain('is not a number');
    find<HTMLElement>('#refusal').click();
    host.publish('jog.step', 2);
    expect(text('#refusal')).toBe('');
  });

  it('tells the reason to a finger', async () => {
    const { host, widget, find, text } = await show(makeParameter());
    host.lock('needs engineer');
    await settled(widget);
    find<HTMLElement>('.controls').click();
    expect(text('#refusal')).toBe('Locked: needs engineer');
    host.lock('');
    expect(text('#refusal')).toBe('');
  });

  it('makes void what a person had begun', async () => {
    const { host, widget, find } = await show(makeParameter());
    const field = find<HTMLInputElement>('#field');
    host.publish('jog.step', 1);
    type(field, '5');
    host.lock('take control first');
    field.dispatchEvent(new FocusEvent('blur'));
    await settled(widget);
    expect(field.value).toBe('1.000');
    expect(host.set).not.toHaveBeenCalled();
  });

  it('is dead while values are old', async () => {
    const { host, widget, find } = await show(makeParameter());
    host.grow(true);
    await settled(widget);
    expect(find<HTMLInputElement>('#field').disabled).toBe(true);
    expect(find('#lock').textContent).toContain('values are old');
    expect(widget.hasAttribute('stale')).toBe(true);
  });
});

describe('default', () => {
  it('marks a modified value and resets it', async () => {
    const { host, widget, find, root } = await show(makeParameter({ default: 2, unit: 'm' }));
    host.publish('jog.step', 2);
    await settled(widget);
    expect(root.querySelector('.modified, #reset')).toBeNull();
    host.publish('jog.step', 3);
    await settled(widget);
    expect(find('.modified').getAttribute('title')).toBe('Modified; the default is 2000 mm');
    expect(find('.modified').textContent).toContain('modified');
    const reset = find<HTMLButtonElement>('#reset');
    expect(reset.getAttribute('aria-label')).toBe('Reset Step to its default, 2000 mm');
    host.reset.mockResolvedValueOnce({ ok: true, values: { step: 2 } });
    reset.click();
    await settled(widget);
    expect(host.reset).toHaveBeenCalledExactlyOnceWith('jog.step');
    expect(find<HTMLInputElement>('#field').value).toBe('2000');
    expect(root.querySelector('.modified, #reset')).toBeNull();
  });

  it('has no reset without a default', async () => {
    const { host, widget, root } = await show(makeParameter());
    host.publish('jog.step', 2);
    await settled(widget);
    expect(root.querySelector('#reset')).toBeNull();
  });
});

describe('toggle', () => {
  const item = makeParameter({ scalar: 'bool' });

  it('shows the value in force by position and word', async () => {
    const { host, find, text } = await show(item);
    const control = find<HTMLInputElement>('#control');
    expect(control.indeterminate).toBe(true);
    host.publish('jog.step', true);
    expect([control.checked, control.indeterminate]).toEqual([true, false]);
    expect(text('.state')).toBe('on');
    expect(find<HTMLLabelElement>('label').htmlFor).toBe('control');
  });

  it('goes back when refused', async () => {
    const { host, find, text } = await show(item);
    const control = find<HTMLInputElement>('#control');
    host.publish('jog.step', false);
    const answer = hangSet(host);
    control.click();
    expect(host.set).toHaveBeenCalledWith('jog.step', true);
    expect(control.checked).toBe(true);
    await answer({ ok: false, detail: 'the guard is open' });
    expect(control.checked).toBe(false);
    expect(text('#refusal')).toBe('the guard is open');
  });
});

describe('select', () => {
  const item = makeParameter({ scalar: 'enumeration', values: ['slow_mode', 'fast'] });

  it('offers the names in words, and sends the name', async () => {
    const { host, find, root } = await show(item);
    const control = find<HTMLSelectElement>('#control');
    expect([...root.querySelectorAll('option')].map((option) => option.textContent)).toEqual(['—', 'slow mode', 'fast']);
    expect(control.value).toBe('');
    host.publish('jog.step', 'slow_mode');
    expect(control.value).toBe('slow_mode');
    host.set.mockResolvedValueOnce({ ok: false, detail: 'not now' });
    type(control, 'fast', 'change');
    expect(host.set).toHaveBeenCalledWith('jog.step', 'fast');
    await settled();
    expect(control.value).toBe('slow_mode');
  });
});

describe('text field', () => {
  it('sends on Enter, gives up on Escape, ignores echoes while typing', async () => {
    const { host, find } = await show(makeParameter({ scalar: 'text' }));
    const control = find<HTMLInputElement>('#control');
    host.publish('jog.step', 'belt');
    expect(control.value).toBe('belt');
    type(control, 'table');
    host.publish('jog.step', 'floor');
    expect(control.value).toBe('table');
    key(control, 'keydown', 'Escape');
    expect(control.value).toBe('floor');
    type(control, 'table');
    key(control, 'keydown', 'Enter');
    await settled();
    expect(host.set).toHaveBeenCalledExactlyOnceWith('jog.step', 'table');
    expect(control.value).toBe('table');
  });
});

describe('array field', () => {
  it('sends one element by its path, and shows what the unit answered', async () => {
    const { host, find, root, widget } = await show(makeParameter({ key: 'jog.gains', path: 'gains', shape: [3], default: [1, 2, 3] }));
    host.publish('jog.gains', [1, 2, 3]);
    const inputs = [...root.querySelectorAll<HTMLInputElement>('input')];
    expect(inputs.map((input) => input.value)).toEqual(['1.000', '2.000', '3.000']);
    host.set.mockResolvedValueOnce({ ok: true, values: { gains: [1, 4.5, 3] } });
    type(inputs[1]!, '5');
    host.publish('jog.gains', [9, 9, 9]);
    expect(inputs.map((input) => input.value)).toEqual(['9.000', '5', '9.000']);
    key(inputs[1]!, 'keydown', 'Enter');
    await settled();
    expect(host.set).toHaveBeenCalledExactlyOnceWith('jog.gains[1]', 5);
    expect(inputs[1]!.value).toBe('4.500');
    host.lock('take control first');
    await settled(widget);
    expect(inputs[1]!.value).toBe('4.500');
    expect(inputs[1]!.getAttribute('aria-label')).toBe('Step 1');
    expect(find('.index').textContent).toBe('0');
  });

  it('knows rows and columns of a matrix, steps by keys, and says which element was refused', async () => {
    const { host, root, text } = await show(makeParameter({ key: 'jog.m', path: 'm', shape: [2, 2], scalar: 'i32' }));
    host.publish('jog.m', [[1, 2], [3, 4]]);
    const inputs = [...root.querySelectorAll<HTMLInputElement>('input')];
    host.set.mockResolvedValueOnce({ ok: false, detail: 'too much' });
    key(inputs[2]!, 'keydown', 'ArrowUp');
    expect(host.set).toHaveBeenCalledWith('jog.m[1][0]', 4);
    await settled();
    expect(inputs[2]!.value).toBe('3');
    expect(text('#refusal')).toBe('[1][0]: too much');
  });
});
