import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Overlay, Placement } from '../../../contract';
import { FakeHost, makeItem, mount, settled, type Shown } from '../../tests/fake_host';
import { strokeOf } from '../strokes';

const ms = 1_000_000;
const members = ['width', 'height', 'format', 'data'].map((name) => makeItem({ key: `slot:camera.${name}` }));
const camera = makeItem({ key: 'slot:camera', label: 'Camera', scalar: 'structure', kind: 'slot', members });
const tracks: Overlay = {
  name: 'tracks', label: 'Tracks', shown: true, slots: ['tracks'], list: 'tracks', text: ['id'], certain: 'confirmed',
  rectangle: ['left', 'top', 'width', 'height'], class: 'found', empty: { field: 'found', value: 'nothing' }, time: { of: 'slot', field: 'time' },
};
const regions: Overlay = {
  name: 'attention', shown: true, slots: ['report[0]', 'report[1]'], list: 'regions', count: 'count', text: [], weight: 'score',
  rectangle: ['left', 'top', 'width', 'height'],
};

const track = (more: object = {}): { [field: string]: number | string | boolean } =>
  ({ id: 4, found: 'target', confirmed: true, left: 100, top: 60, width: 40, height: 30, ...more });
const region = (left: number, score: number): { [field: string]: number } => ({ left, top: 10, width: 20, height: 20, score });

let shown: Shown;
let host: FakeHost;

async function place(...overlays: Overlay[]): Promise<void> {
  host = new FakeHost();
  host.items.set(camera.key, camera);
  host.items.set('slot:tracks.tracks[0].found', makeItem({ scalar: 'enumeration', values: ['nothing', 'obstacle', 'target'] }));
  host.items.set('slot:report[0].regions[0].on_probation', makeItem({ scalar: 'bool' }));
  const placement: Placement = {
    name: 'eye', kind: 'image', label: 'Eye', place: 'overview', slots: { value: 'camera' }, parameters: {}, options: {}, overlays,
  };
  shown = await mount('image', { placement }, host);
  await vi.waitFor(() => expect(shown.root.querySelector('flexrf-overlays')).not.toBeNull(), { timeout: 20_000 });
  await settled(layer());
}
const layer = (): HTMLElement => shown.root.querySelector<HTMLElement>('flexrf-overlays')!;
const inside = <E extends Element>(selector: string): E[] => [...layer().shadowRoot!.querySelectorAll<E>(selector)];
const states = (): string[] => inside('.state').map((state) => state.textContent!.trim());

/** The camera's picture of this time is seen; 320 pixels wide, half as wide as it was. */
async function see(time: number): Promise<void> {
  host.publish('slot:camera', null, { image: new Blob(['1']), sampledAt: time * ms, scaledBy: 2 });
  shown.find('img[hidden]').dispatchEvent(new Event('load'));
  await settled();
}
async function tell(slot: string, value: object | null, time = 0): Promise<void> {
  host.publish(`slot:${slot}`, value as never, { sampledAt: time * ms, reason: value === null ? 'writer retired' : '' });
  await settled();
}
interface DrawnMark { readonly x: number; readonly text: string; readonly opacity: number; readonly stroke: string; readonly dashes: string; readonly thickness: number }
const marks = (): DrawnMark[] =>
  [...shown.root.querySelectorAll('.picture svg > g')].filter((mark) => mark.getAttribute('visibility') === 'visible').map((mark) => {
    const [behind, front] = mark.querySelectorAll('rect');
    const line = front!;
    expect(behind!.getAttribute('x')).toBe(line.getAttribute('x'));
    return {
      x: Number(line.getAttribute('x')), text: mark.querySelector('text')!.textContent ?? '', opacity: Number(mark.getAttribute('opacity')),
      stroke: line.getAttribute('stroke')!, dashes: line.getAttribute('stroke-dasharray')!, thickness: Number(line.getAttribute('stroke-width')),
    };
  });

beforeEach(() => {
  vi.stubGlobal('ResizeObserver', class {
    observe(): void {}
    disconnect(): void {}
  });
  vi.spyOn(HTMLElement.prototype, 'clientWidth', 'get').mockReturnValue(320);
  vi.spyOn(HTMLImageElement.prototype, 'naturalWidth', 'get').mockReturnValue(320);
  vi.spyOn(HTMLImageElement.prototype, 'naturalHeight', 'get').mockReturnValue(240);
  URL.createObjectURL = () => 'blob:1';
  URL.revokeObjectURL = () => undefined;
});
afterEach(() => {
  document.body.replaceChildren();
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
});

describe('overlays of an image', { timeout: 30_000 }, () => {
  it('draws what was found in the picture that is seen, in its pixels', async () => {
    await place(tracks);
    expect(states()).toEqual(['no picture yet']);
    await see(100);
    expect(states()).toEqual(['— nothing yet']);
    await tell('tracks', { time: 100 * ms, tracks: [track(), track({ found: 'nothing' }), track({ id: 5, left: 300, found: 'obstacle' })] });
    expect(shown.find('.picture svg').getAttribute('viewBox')).toBe('0 0 640 480');
    expect(marks().map(({ x, text, opacity }) => ({ x, text, opacity }))).toEqual([{ x: 100, text: '4', opacity: 1 }, { x: 300, text: '5', opacity: 1 }]);
    expect(states()).toEqual(['2 drawn']);
    const [target, obstacle] = marks();
    expect(target!.stroke).not.toBe(obstacle!.stroke);
    expect(target!.dashes).not.toBe(obstacle!.dashes);
  });

  it('never lets what is old stand over a new picture in silence', async () => {
    await place(tracks);
    await see(100);
    await tell('tracks', { time: 100 * ms, tracks: [track()] });
    await see(200);
    expect(marks()[0]!.opacity).toBeLessThan(0.5);
    expect(states()).toEqual(['⚠ 1 drawn, up to 0.10 s older than the picture']);
    expect(inside('.state')[0]!.classList.contains('abnormal')).toBe(true);
    await tell('tracks', { time: 200 * ms, tracks: [track({ left: 120 })] });
    expect(marks()).toMatchObject([{ x: 120, opacity: 1 }]);
    expect(inside('.state')[0]!.classList.contains('abnormal')).toBe(false);
    await see(800);
    expect(marks()).toEqual([]);
    expect(states()).toEqual(['⚠ nothing of this picture; the last is 0.60 s older']);
  });

  it('shows a picture no sooner than what lies over it', async () => {
    await place(tracks);
    const images = (): string[] => [...shown.root.querySelectorAll<HTMLImageElement>('img')].map((image) => `${image.src} ${image.hidden}`);
    URL.createObjectURL = (blob) => `blob:${(blob as Blob).size}`;
    await see(100);
    expect(images()).toEqual([' true', 'blob:1 false']);
    host.publish('slot:camera', null, { image: new Blob(['12']), sampledAt: 133 * ms });
    expect(images()).toEqual(['blob:2 true', 'blob:1 false']);
    shown.find('img[hidden]').dispatchEvent(new Event('load'));
    expect(images()).toEqual(['blob:2 false', 'blob:1 true']);
  });

  it('waits for a picture whose things came before it', async () => {
    await place(tracks);
    await see(100);
    await tell('tracks', { time: 100 * ms, tracks: [track()] });
    await tell('tracks', { time: 133 * ms, tracks: [track({ left: 104 })] });
    expect(marks()).toMatchObject([{ x: 100 }]);
    await see(133);
    expect(marks()).toMatchObject([{ x: 104, opacity: 1 }]);
  });

  it('takes a whole population as one, and draws by weight', async () => {
    await place(regions);
    await see(100);
    await tell('report[0]', { count: 1, regions: [region(50, 4), region(0, 0)] }, 100);
    await tell('report[1]', { count: 2, regions: [region(60, 1), region(70, -3)] }, 100);
    expect(marks().map((mark) => mark.x)).toEqual([50, 60, 70]);
    const [heavy, light, none] = marks().map((mark) => mark.thickness) as [number, number, number];
    expect(heavy).toBe(4);
    expect(light).toBeCloseTo(1.5 + 2.5 / 4, 9);
    expect(none).toBe(1.5);
    expect(states()).toEqual(['3 drawn']);
    await tell('report[1]', null);
    expect(marks().map((mark) => mark.x)).toEqual([50]);
  });

  it('leaves out what has no extent, and marks what is not certain', async () => {
    await place(tracks);
    await see(100);
    await tell('tracks', { time: 100 * ms, tracks: [track({ width: 0 }), track({ left: Number.NaN }), track({ confirmed: false, left: 7 })] });
    expect(marks()).toMatchObject([{ x: 7, text: '4?', opacity: 0.65 }]);
  });

  it('explains each line by word, colour and dashes', async () => {
    await place(tracks, { ...regions, class: 'kind', classes: ['block', 'disc'] });
    expect(inside('label').map((label) => label.textContent!.trim())).toEqual(['Tracks', 'Attention']);
    expect(inside('.sample').map((sample) => sample.textContent!.trim())).toEqual(['obstacle', 'target', 'block', 'disc', 'other']);
    const lines = inside('.sample line').map((line) => `${line.getAttribute('stroke')} ${line.getAttribute('stroke-dasharray')}`);
    expect(new Set(lines).size).toBe(5);
    await see(100);
    const things = [0, 1, 9].map((kind) => ({ ...region(10 * kind, 1), kind }));
    await tell('report[0]', { count: 3, regions: things }, 100);
    expect(marks().map((mark) => `${mark.stroke} ${mark.dashes}`)).toEqual(lines.slice(2));
  });

  it('tells the two sides of a bool apart', async () => {
    await place({ ...regions, class: 'on_probation' });
    expect(inside('.sample').map((sample) => sample.textContent!.trim())).toEqual(['on probation', 'not on probation']);
    await see(100);
    await tell('report[0]', { count: 2, regions: [{ ...region(1, 1), on_probation: false }, { ...region(2, 1), on_probation: true }] }, 100);
    expect(marks().map((mark) => mark.stroke)).toEqual([strokeOf(1).colour, strokeOf(0).colour]);
  });

  it('asks for nothing that is not shown', async () => {
    await place(tracks, { ...regions, shown: false });
    const watched = (): string[] => host.watches.map((watch) => watch.key).filter((key) => key !== 'slot:camera');
    expect(watched()).toEqual(['slot:tracks']);
    expect(states()[1]).toBe('hidden');
    const [first, second] = inside<HTMLInputElement>('input') as [HTMLInputElement, HTMLInputElement];
    second.click();
    expect(watched()).toEqual(['slot:tracks', 'slot:report[0]', 'slot:report[1]']);
    first.click();
    await settled();
    expect(watched()).toEqual(['slot:report[0]', 'slot:report[1]']);
    expect(states()[0]).toBe('hidden');
    const scroll = (skipped: boolean): boolean =>
      shown.widget.dispatchEvent(Object.assign(new Event('contentvisibilityautostatechange'), { skipped }));
    scroll(true);
    expect(host.watches).toHaveLength(0);
    scroll(false);
    expect(watched()).toEqual(['slot:report[0]', 'slot:report[1]']);
    shown.widget.remove();
    expect(host.watches).toHaveLength(0);
  });

  it('draws each once when it comes back', async () => {
    await place(tracks);
    shown.widget.remove();
    document.body.append(shown.widget);
    await settled(shown.widget);
    await see(100);
    await tell('tracks', { time: 100 * ms, tracks: [track()] });
    expect(marks()).toHaveLength(1);
  });

  it('says the same in a table', async () => {
    await place(tracks);
    await see(100);
    await tell('tracks', { time: 100 * ms, tracks: [track(), track({ id: 9, found: 'obstacle', confirmed: false, left: 12.4 })] });
    const [details] = inside<HTMLDetailsElement>('details') as [HTMLDetailsElement];
    details.open = true;
    details.dispatchEvent(new Event('toggle'));
    await settled(layer());
    const rows = inside('tbody tr').map((row) => [...row.children].map((cell) => cell.textContent!.trim()).join(' '));
    expect(rows).toEqual(['Tracks target 4 100 60 40 30  yes no', 'Tracks obstacle 9 12 60 40 30  no no']);
    expect(inside('caption')[0]!.textContent).toContain('Eye: 2 drawn');
    // What was drawn since is in it within half a second, and no sooner.
    vi.useFakeTimers();
    await see(150);
    vi.advanceTimersByTime(600);
    vi.useRealTimers();
    await settled(layer());
    expect(inside('tbody tr td:last-child').map((cell) => cell.textContent)).toEqual(['0.05 s', '0.05 s']);
  });
});

it('has 32 kinds of lines', () => {
  const all = Array.from({ length: 32 }, (_, kind) => strokeOf(kind)).map(({ colour, dashes }) => `${colour} ${dashes}`);
  expect(new Set(all).size).toBe(32);
});
