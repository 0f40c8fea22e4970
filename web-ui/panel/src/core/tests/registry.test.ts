import { afterEach, describe, expect, it, vi } from 'vitest';
import type { WidgetElement } from '../../contract';
import { Registry, type BuiltInWidgets, type LoadWidget } from '../registry';

const element = (): new () => WidgetElement => class extends HTMLElement {} as unknown as new () => WidgetElement;

const apart = vi.fn<LoadWidget>((kind) => Promise.resolve(kind === 'crowd' ? element() : undefined));
afterEach(() => void apart.mockClear());

function builtIn(): BuiltInWidgets {
  return {
    registerBuiltIn: (register) => register('number', element()),
    registerFurther: vi.fn<BuiltInWidgets['registerFurther']>((register) => {
      register('slider', element());
      return Promise.resolve(apart);
    }),
    kindOf: (item) => item.widget ?? 'number',
    placedKind: (_host, placement) => placement.kind,
  };
}

describe('registry', () => {
  it('loads further widgets only when one is asked for', async () => {
    const widgets = builtIn();
    const registry = new Registry(() => Promise.resolve(widgets));
    expect((await registry.create('number')).localName).toBe('flexrf-widget-number');
    expect(widgets.registerFurther).not.toHaveBeenCalled();
    expect((await registry.create('slider')).localName).toBe('flexrf-widget-slider');
    await registry.create('number', true);
    expect(widgets.registerFurther).toHaveBeenCalledOnce();
  });
  it('loads a widget of the application once, by its kind', async () => {
    const load = vi.fn(() => Promise.resolve({ default: element() }));
    const registry = new Registry(() => Promise.resolve(builtIn()), load);
    await Promise.all([registry.create('jog_arrows'), registry.create('jog_arrows')]);
    expect(load).toHaveBeenCalledExactlyOnceWith('/application/widgets/jog_arrows.js');
  });
  it('loads a widget that comes by itself once, and asks the application for none of its kind', async () => {
    const widgets = builtIn();
    const load = vi.fn(() => Promise.resolve({ default: element() }));
    const registry = new Registry(() => Promise.resolve(widgets), load);
    const [one] = await Promise.all([registry.create('crowd'), registry.create('crowd')]);
    expect(one!.localName).toBe('flexrf-widget-crowd');
    expect(apart).toHaveBeenCalledExactlyOnceWith('crowd');
    expect(load).not.toHaveBeenCalled();
    await registry.create('slider');
    expect(apart).toHaveBeenCalledOnce();
  });
  it('takes several kinds from one module', async () => {
    const registry = new Registry(() => Promise.resolve(builtIn()), () => Promise.resolve({
      register: (register) => {
        register('left_arm', element());
        register('right_arm', element());
      },
    }));
    expect((await registry.create('left_arm')).localName).toBe('flexrf-widget-left-arm');
    expect((await registry.create('right_arm')).localName).toBe('flexrf-widget-right-arm');
  });
  it('says what is wrong, and tries again later', async () => {
    const load = vi.fn<() => Promise<{ default?: new () => WidgetElement }>>()
      .mockRejectedValueOnce(new Error('404')).mockResolvedValueOnce({}).mockResolvedValue({ default: element() });
    const registry = new Registry(() => Promise.resolve(builtIn()), load);
    await expect(registry.create('late')).rejects.toThrow('404');
    await expect(registry.create('late')).rejects.toThrow('registers no widget "late"');
    await expect(registry.create('../evil')).rejects.toThrow('no name of a widget');
    expect(load).toHaveBeenCalledTimes(2);
  });
  it('refuses a name that is taken', () => {
    const registry = new Registry(() => Promise.resolve(builtIn()));
    registry.register('gripper', element());
    expect(() => registry.register('gripper', element())).toThrow('already');
    expect(() => registry.register('Big', element())).toThrow('no name');
  });
});
