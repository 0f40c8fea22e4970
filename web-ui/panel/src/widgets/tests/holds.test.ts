import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { FakeHost, key, makeHold, makeParameter, mount, pointer, settled, show, type FakeHold, type Shown } from '../tests/fake_host';

const captured = vi.fn();
beforeEach(() => {
  captured.mockReset();
  Element.prototype.setPointerCapture = captured;
});
afterEach(() => document.body.replaceChildren());

const item = makeParameter({ key: 'jog.up', label: 'Up', scalar: 'hold', unit: '' });

describe('hold button', () => {
  let shown: Shown;
  let button: HTMLButtonElement;
  let hold: FakeHold;
  beforeEach(async () => {
    shown = await show(item);
    button = shown.find('#control');
    hold = makeHold();
    shown.host.hold.mockResolvedValue(hold);
  });
  const phase = (): string | null => button.getAttribute('data-phase');
  const press = async (): Promise<void> => {
    pointer(button, 'pointerdown');
    await settled();
    expect(phase()).toBe('held');
  };

  it('is active only once there is a lease', async () => {
    pointer(button, 'pointerdown');
    expect(phase()).toBe('asked');
    expect(button.getAttribute('aria-pressed')).toBe('false');
    await settled();
    expect(phase()).toBe('held');
    expect(button.getAttribute('aria-pressed')).toBe('true');
    expect(shown.host.hold).toHaveBeenCalledExactlyOnceWith('jog.up');
    expect(captured).toHaveBeenCalledWith(1);
  });

  const endings: { [cause: string]: () => void } = {
    'the finger is lifted': () => pointer(button, 'pointerup'),
    'the finger is lifted elsewhere': () => pointer(window, 'pointerup'),
    'the touch is cancelled': () => pointer(button, 'pointercancel'),
    'the capture is lost': () => pointer(button, 'lostpointercapture'),
    'the button loses the focus': () => button.dispatchEvent(new FocusEvent('blur')),
    'the window loses the focus': () => window.dispatchEvent(new Event('blur')),
    'the page is left': () => window.dispatchEvent(new Event('pagehide')),
    'the page is hidden': () => {
      const hidden = vi.spyOn(document, 'hidden', 'get').mockReturnValue(true);
      document.dispatchEvent(new Event('visibilitychange'));
      hidden.mockRestore();
    },
    'it is locked': () => shown.host.lock('take control first'),
    'values turn old': () => shown.host.grow(true),
    'the widget leaves the page': () => shown.widget.remove(),
  };
  for (const [cause, end] of Object.entries(endings)) {
    it(`ends when ${cause}`, async () => {
      await press();
      end();
      expect(hold.released).toBe(true);
      expect(phase()).toBe('idle');
      await settled();
      expect(shown.text('#refusal')).toBe('');
    });
  }

  it('ends when the finger slides off, and not while it rolls at the edge', async () => {
    vi.spyOn(button, 'getBoundingClientRect').mockReturnValue(new DOMRect(100, 100, 72, 72));
    await press();
    pointer(button, 'pointermove', { clientX: 177, clientY: 96 });
    pointer(button, 'pointermove', { clientX: 300, clientY: 300, pointerId: 2 });
    expect(hold.released).toBe(false);
    pointer(button, 'pointermove', { clientX: 150, clientY: 190 });
    expect(hold.released).toBe(true);
    expect(phase()).toBe('idle');
    pointer(button, 'pointermove', { clientX: 150, clientY: 150 }); // back on it is not a new press
    await settled();
    expect(shown.host.hold).toHaveBeenCalledTimes(1);
  });

  it('says what was refused over the page, beside nothing that could be moved by it', async () => {
    shown.host.hold.mockRejectedValueOnce(new Error('motion is stopped'));
    pointer(button, 'pointerdown');
    await settled();
    const said = shown.find<HTMLElement>('#refusal');
    expect(said.closest('.notes')).toBeNull();
    expect(said.classList.contains('over')).toBe(true);
    expect(shown.widget.hasAttribute('said')).toBe(true);
    said.click();
    expect(said.textContent).toBe('');
    expect(shown.widget.hasAttribute('said')).toBe(false);
  });

  it('has its reason beside it while it is dead', async () => {
    shown.host.lock('motion is inhibited: give Start motion');
    await settled(shown.widget);
    expect(shown.text('.why')).toBe('motion is inhibited: give Start motion');
  });

  it('goes on while another finger is lifted', async () => {
    await press();
    pointer(window, 'pointerup', { pointerId: 2 });
    expect(hold.released).toBe(false);
  });

  it('does not begin with another button or a second finger', async () => {
    pointer(button, 'pointerdown', { button: 2 });
    pointer(button, 'pointerdown', { isPrimary: false });
    await settled();
    expect(shown.host.hold).not.toHaveBeenCalled();
  });

  it('shows the end of the lease and its reason, and needs a new press', async () => {
    await press();
    hold.lose('the lease expired');
    await settled();
    expect(phase()).toBe('idle');
    expect(shown.text('#refusal')).toBe('the lease expired');
    pointer(button, 'pointerup');
    expect(shown.host.hold).toHaveBeenCalledTimes(1);
  });

  it('says why it did not begin', async () => {
    shown.host.hold.mockRejectedValueOnce(new Error('motion is stopped'));
    pointer(button, 'pointerdown');
    await settled();
    expect(phase()).toBe('idle');
    expect(shown.text('#refusal')).toBe('motion is stopped');
  });

  it('lets go of a lease that comes after the finger was lifted', async () => {
    let grant = (_hold: FakeHold): void => undefined;
    shown.host.hold.mockReturnValueOnce(new Promise((resolve) => (grant = resolve)));
    pointer(button, 'pointerdown');
    pointer(button, 'pointerup');
    grant(hold);
    await settled();
    expect(hold.released).toBe(true);
    expect(phase()).toBe('idle');
  });

  for (const name of [' ', 'Enter']) {
    it(`is held by the key "${name}", whose repetitions are ignored`, async () => {
      expect(key(button, 'keydown', name).defaultPrevented).toBe(true);
      await settled();
      expect(phase()).toBe('held');
      key(button, 'keydown', name, { repeat: true });
      expect(shown.host.hold).toHaveBeenCalledTimes(1);
      key(window, 'keyup', 'a');
      expect(phase()).toBe('held');
      key(window, 'keyup', name);
      expect(hold.released).toBe(true);
      key(button, 'keydown', name, { repeat: true });
      await settled();
      expect(shown.host.hold).toHaveBeenCalledTimes(1);
    });
  }

  it('opens no menu on a long touch', () => {
    const menu = new Event('contextmenu', { cancelable: true });
    button.dispatchEvent(menu);
    expect(menu.defaultPrevented).toBe(true);
  });

  it('does not begin while it is locked', async () => {
    shown.host.lock('take control first');
    await settled(shown.widget);
    expect(button.disabled).toBe(true);
    pointer(button, 'pointerdown');
    expect(shown.host.hold).not.toHaveBeenCalled();
  });

  it('works again after it was taken from the page and put back', async () => {
    shown.widget.remove();
    document.body.append(shown.widget);
    await settled(shown.widget);
    await press();
  });

  it('works where the pointer cannot be captured', async () => {
    captured.mockImplementation(() => {
      throw new DOMException('gone', 'NotFoundError');
    });
    await press();
    pointer(window, 'pointerup');
    expect(hold.released).toBe(true);
  });
});

describe('jog pad', () => {
  const make = async (): Promise<Shown> => {
    const host = new FakeHost();
    for (const name of ['left', 'right', 'extra']) host.items.set(`jog.${name}`, { ...item, key: `jog.${name}`, label: name });
    host.items.set('jog.step', makeParameter());
    const parameters = { left: 'jog.left', right: 'jog.right', special: 'jog.extra', step: 'jog.step', none: 'jog.none' };
    return mount('jog_pad', { placement: { name: 'pad', kind: 'jog_pad', label: 'Jog', place: '', slots: {}, parameters, options: {} } }, host);
  };

  it('has a button for each hold, where its role says', async () => {
    const { root } = await make();
    const buttons = [...root.querySelectorAll<HTMLElement>('button')];
    expect(buttons.map((button) => button.textContent?.replace(/\s+/g, ' ').trim())).toEqual(['◀ left', '▶ right', 'extra']);
    expect(buttons.map((button) => button.style.gridColumn)).toEqual(['1', '3', '']);
  });

  it('is not said to be another widget than was asked for', async () => {
    const { widget } = await make();
    expect(widget).toHaveProperty('note', '');
  });

  it('holds one direction at a time', async () => {
    const { host, root } = await make();
    const hold = makeHold();
    host.hold.mockResolvedValue(hold);
    const [left, right] = [...root.querySelectorAll<HTMLElement>('button')];
    pointer(left!, 'pointerdown');
    await settled();
    pointer(right!, 'pointerdown', { pointerId: 2 });
    expect(host.hold).toHaveBeenCalledExactlyOnceWith('jog.left');
    expect(left!.getAttribute('data-phase')).toBe('held');
    pointer(window, 'pointerup');
    expect(hold.released).toBe(true);
    pointer(right!, 'pointerdown', { pointerId: 2 });
    expect(host.hold).toHaveBeenLastCalledWith('jog.right');
  });

  it('ends with the lock, and tells the reason of a lost lease', async () => {
    const { host, root, text, widget } = await make();
    const hold = makeHold();
    host.hold.mockResolvedValue(hold);
    const left = root.querySelector<HTMLButtonElement>('button')!;
    pointer(left, 'pointerdown');
    await settled();
    hold.lose('the lease expired');
    await settled();
    expect(text('#refusal')).toBe('left: the lease expired');
    pointer(left, 'pointerdown');
    await settled();
    host.lock('take control first');
    await settled(widget);
    expect(left.disabled).toBe(true);
    expect(left.getAttribute('data-phase')).toBe('idle');
  });

  it('has a line that says why it is dead, and is there in any case', async () => {
    const { host, text, widget } = await make();
    expect(text('.line')).toBe('Acts while held.');
    host.lock('motion is stopped');
    await settled(widget);
    expect(text('.line')).toBe('Dead: motion is stopped');
  });

  it('says when its row has no hold', async () => {
    const shown = await mount('jog_pad', { placement: { name: 'pad', kind: 'jog_pad', label: '', place: '', slots: {}, parameters: {}, options: {} } }, new FakeHost());
    expect(shown.text('#lock')).toBe('none of its parameters is a hold');
  });
});

describe('button', () => {
  const action = makeParameter({ key: 'jog.go', label: 'Go', scalar: 'button', unit: '' });

  it('presses once per click, not again before the answer', async () => {
    const { host, find, widget } = await show(action);
    const control = find<HTMLButtonElement>('#control');
    control.click();
    control.click();
    expect(host.press).toHaveBeenCalledExactlyOnceWith('jog.go');
    await settled(widget);
    control.click();
    expect(host.press).toHaveBeenCalledTimes(2);
  });

  it('ignores a key that is held', async () => {
    const { find } = await show(action);
    expect(key(find('#control'), 'keydown', 'Enter', { repeat: true }).defaultPrevented).toBe(true);
    expect(key(find('#control'), 'keydown', 'Enter').defaultPrevented).toBe(false);
  });

  it('says why it was refused', async () => {
    const { host, find, text, widget } = await show(action);
    host.press.mockResolvedValueOnce({ ok: false, detail: 'the queue is full' });
    find<HTMLButtonElement>('#control').click();
    await settled(widget);
    expect(text('#refusal')).toBe('the queue is full');
  });

  it('asks first where the table says so', async () => {
    const { host, find, text, widget } = await show({ ...action, confirm: 'Open it? The part falls.' });
    find<HTMLButtonElement>('#control').click();
    await settled(widget);
    expect(text('.question [role="alert"]')).toBe('Open it? The part falls.');
    expect(host.press).not.toHaveBeenCalled();
    find<HTMLButtonElement>('#yes').click();
    await settled(widget);
    expect(host.press).toHaveBeenCalledTimes(1);
  });

  it('is dead while it is locked', async () => {
    const { host, find, widget } = await show(action);
    host.lock('needs engineer');
    await settled(widget);
    expect(find<HTMLButtonElement>('#control').disabled).toBe(true);
  });
});
