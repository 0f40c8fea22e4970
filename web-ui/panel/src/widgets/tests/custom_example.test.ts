// The custom widget of docs/panel-widgets.md works as it is printed there.
import { afterEach, expect, it } from 'vitest';
import page from 'documentation/panel-widgets.md?raw';
import type { WidgetElement } from '../../contract';
import { Registry } from '../../core/registry';
import * as builtIn from '..';
import { FakeHost, key, makeHold, makeItem, makeParameter, pointer, settled } from '../tests/fake_host';

const code = /\n( {4}const sheet = [^]*?)\n\n?Its row/.exec(page)![1]!.replaceAll(/^ {4}/gm, '');

afterEach(() => document.body.replaceChildren());

it('is shorter than 40 lines', () => {
  expect(code.trim().split('\n').length).toBeLessThan(40);
});

it('shows its slot and holds its parameter', async () => {
  // jsdom knows neither style sheets made by scripts nor captured pointers.
  CSSStyleSheet.prototype.replaceSync ??= () => undefined;
  Element.prototype.setPointerCapture = () => undefined;
  const load = (): Promise<{ default: new () => WidgetElement }> =>
    import(/* @vite-ignore */ `data:text/javascript,${encodeURIComponent(code)}`);
  const registry = new Registry(async () => builtIn, load);

  const host = new FakeHost();
  host.items.set('slot:tank_state.level', makeItem({ key: 'slot:tank_state.level' }));
  host.items.set('filling.pump', makeParameter({ key: 'filling.pump', scalar: 'hold' }));
  const hold = makeHold();
  host.hold.mockResolvedValue(hold);
  const placement = {
    name: 'tank', kind: 'tank', label: 'Tank', place: 'overview', options: {},
    slots: { tank: 'tank_state' }, parameters: { pump: 'filling.pump' },
  };
  const widget: WidgetElement = Object.assign(await registry.create('tank'), { host, placement });
  document.body.append(widget);
  const [meter, text, button] = [...widget.shadowRoot!.children] as [HTMLMeterElement, HTMLElement, HTMLButtonElement];

  host.publish('slot:tank_state.level', 0.25);
  expect([meter.value, text.textContent]).toEqual([0.25, '25 %']);
  host.publish('slot:tank_state.level', null, { reason: 'nothing yet' });
  expect(text.textContent).toBe('— nothing yet');

  pointer(button, 'pointerdown');
  await settled();
  expect(host.hold).toHaveBeenCalledExactlyOnceWith('filling.pump');
  pointer(button, 'lostpointercapture');
  await settled();
  expect(hold.released).toBe(true);
  key(button, 'keydown', ' ');
  key(button, 'keydown', ' ', { repeat: true });
  expect(host.hold).toHaveBeenCalledTimes(2);
  key(button, 'keyup', ' ');

  host.lock('take control first');
  expect(button.disabled).toBe(true);
  host.grow(true);
  expect(widget.hasAttribute('stale')).toBe(true);
  widget.remove();
  expect(host.watches).toHaveLength(0);
});
