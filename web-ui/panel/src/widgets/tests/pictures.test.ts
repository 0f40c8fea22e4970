import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { ItemInfo } from '../../contract';
import { columnsPath } from '../histogram';
import { flatPose, mapExtent } from '../pose_2d';
import { makeItem, settled, show } from '../tests/fake_host';

afterEach(() => document.body.replaceChildren());

describe('image', () => {
  const members = ['width', 'height', 'format', 'data'].map((name) => makeItem({ key: `slot:camera.${name}` }));
  const item = makeItem({ key: 'slot:camera', label: 'Camera', scalar: 'structure', kind: 'slot', members });
  let width = 300;
  let resize: () => void = () => undefined;
  let addresses: string[];

  beforeEach(() => {
    width = 300;
    addresses = [];
    vi.stubGlobal('ResizeObserver', class {
      constructor(callback: () => void) {
        resize = callback;
      }
      observe(): void {}
      disconnect(): void {
        resize = () => undefined;
      }
    });
    vi.spyOn(HTMLElement.prototype, 'clientWidth', 'get').mockImplementation(() => width);
    let count = 0;
    URL.createObjectURL = () => {
      const address = `blob:${(count += 1)}`;
      addresses.push(address);
      return address;
    };
    URL.revokeObjectURL = (address) => void addresses.splice(addresses.indexOf(address), 1);
  });
  afterEach(() => {
    vi.unstubAllGlobals();
    vi.restoreAllMocks();
  });

  it('asks for the width that is shown, rounded up, and again when it changes', async () => {
    const { host } = await show(item);
    expect(host.watches.map((watch) => watch.options)).toEqual([{ width: 320, rate: 15 }]);
    width = 310;
    resize();
    expect(host.watches).toHaveLength(1);
    width = 640;
    resize();
    expect(host.watches.map((watch) => watch.options.width)).toEqual([640]);
  });

  it('shows the newest picture, one after the other, and keeps no address of an old one', async () => {
    const { host, find } = await show(item);
    const image = find<HTMLImageElement>('img');
    host.publish('slot:camera', null, { image: new Blob(['1']) });
    host.publish('slot:camera', null, { image: new Blob(['2']) });
    host.publish('slot:camera', null, { image: new Blob(['3']) });
    expect(image.src).toBe('blob:1');
    image.dispatchEvent(new Event('load'));
    expect(image.src).toBe('blob:2');
    image.dispatchEvent(new Event('load'));
    expect(image.src).toBe('blob:2');
    expect(addresses).toEqual(['blob:2']);
    expect(image.alt).toContain('Camera');
  });

  it('gives the last address back when it leaves', async () => {
    const { host, widget } = await show(item);
    host.publish('slot:camera', null, { image: new Blob(['1']) });
    widget.remove();
    expect(addresses).toEqual([]);
    expect(host.watches).toHaveLength(0);
    document.body.append(widget);
    await settled(widget);
    expect(host.watches).toHaveLength(1);
  });

  it('asks for nothing while it is scrolled away', async () => {
    const { host, widget } = await show(item);
    const scroll = (skipped: boolean): boolean =>
      widget.dispatchEvent(Object.assign(new Event('contentvisibilityautostatechange'), { skipped }));
    scroll(true);
    expect(host.watches).toHaveLength(0);
    expect(addresses).toEqual([]);
    scroll(false);
    expect(host.watches).toHaveLength(1);
  });

  it('says why there is none', async () => {
    const { host, text, find } = await show(item);
    host.publish('slot:camera', null, { reason: 'nobody has published yet' });
    expect(text('#absence')).toBe('nobody has published yet');
    expect(find('.picture').classList.contains('absent')).toBe(true);
    host.publish('slot:camera', null, { image: new Blob(['1']) });
    expect(text('#absence')).toBe('');
  });
});

describe('histogram', () => {
  it('draws a column for each number, and tells the largest', async () => {
    const { host, text, find } = await show(makeItem({ shape: [4], scalar: 'u32', widget: 'histogram' }));
    expect(text('.value')).toBe('—');
    host.publish('jog.step', [0, 2, 1, 0]);
    expect(text('.value')).toBe('largest 2 at 1');
    expect(find('path').getAttribute('d')).toContain('M1.05 100.0V0.0h0.9V100.0z');
    expect(find('svg').getAttribute('viewBox')).toBe('0 0 4 100');
    host.publish('jog.step', null, { reason: 'nothing yet' });
    expect(find('path').getAttribute('d')).toBe('');
  });

  it('leaves out what is no number, and draws below zero', () => {
    expect(columnsPath([Number.NaN, -1], -1, 1)).toBe('M1.05 50.0V100.0h0.9V50.0z');
    expect(columnsPath([], 0, 0)).toBe('');
  });
});

describe('gauge', () => {
  const item = makeItem({ range: [0, 10], widget: 'gauge' });

  it('turns its needle over the range and no further', async () => {
    const { host, find, text } = await show(item);
    const needle = find<SVGElement>('.needle');
    expect(needle.style.visibility).toBe('hidden');
    host.publish('jog.step', 5);
    expect(needle.getAttribute('transform')).toBe('rotate(0.0 60 60)');
    host.publish('jog.step', 100);
    expect(needle.getAttribute('transform')).toBe('rotate(120.0 60 60)');
    expect(text('.value')).toBe('100.00');
    host.publish('jog.step', Number.NaN);
    expect(needle.style.visibility).toBe('hidden');
    expect(text('.abnormal')).toBe('⚠ not a number');
  });

  it('marks its limits', async () => {
    const shown = await show(item, {
      placement: { name: 'w', kind: 'gauge', label: '', place: '', slots: {}, parameters: {}, options: { low: 1, high: 9 } },
    });
    expect(shown.root.querySelectorAll('.limit')).toHaveLength(2);
    shown.host.publish('jog.step', 9.5);
    expect(shown.text('.abnormal')).toBe('▲ high');
  });
});

describe('2D pose', () => {
  const item: ItemInfo = makeItem({
    key: 'slot:pose', scalar: 'structure', kind: 'slot', widget: 'pose_2d',
    members: [makeItem({ key: 'slot:pose.position', label: 'Position', unit: 'm', shape: [3] }), makeItem({ key: 'slot:pose.orientation', shape: [4] })],
  });

  it('draws the pose from above, with its numbers', async () => {
    const { host, find, root } = await show(item);
    const half = Math.SQRT1_2;
    host.publish('slot:pose', { position: [1, -0.5, 3], orientation: [0, 0, half, half] });
    expect([...root.querySelectorAll('.value')].map((one) => one.textContent)).toEqual(['1000.0', '−500.0', '90.0']);
    expect(find('.arrow').getAttribute('transform')).toBe('translate(50.00 25.00) rotate(-90.0)');
    expect(find('.extent').textContent).toBe('± 1000 mm');
    host.publish('slot:pose', null, { reason: 'too old' });
    expect(find<SVGElement>('.arrow').style.visibility).toBe('hidden');
    expect(root.querySelector('.value')!.textContent).toBe('—');
  });

  it('takes a structure of poses, a list of three, and nothing else', () => {
    expect(flatPose({ position: [1, 2, 3], orientation: [0, 0, 0, 0] })).toEqual({ x: 1, y: 2, heading: 0 });
    expect(flatPose([1, 2, 0.5])).toEqual({ x: 1, y: 2, heading: 0.5 });
    expect(flatPose([1])).toBeUndefined();
    expect(flatPose({ x: 1 })).toBeUndefined();
    expect(flatPose(null)).toBeUndefined();
    expect(flatPose(3)).toBeUndefined();
  });

  it('maps to the next round extent', () => {
    expect([0.3, 1, 1.2, 7, 20].map(mapExtent)).toEqual([0.5, 1, 2, 10, 20]);
  });
});
