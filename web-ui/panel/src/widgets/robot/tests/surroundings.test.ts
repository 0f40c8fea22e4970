import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { Matrix4, Mesh, PerspectiveCamera, type MeshPhongMaterial, type Object3D } from 'three';
import type { Bodies, Placement, ReferenceFrame } from '../../../contract';
import { FakeHost, settled } from '../../tests/fake_host';
import { bodiesOf, type Body } from '../bodies';
import { Surroundings, type SurroundingsView } from '../surroundings';
import { SurroundingsList } from '../surroundings_list';

const tracks: Bodies = {
  name: 'tracks', label: 'Tracks', shown: true, slots: ['tracks[0]', 'tracks[1]'], list: 'tracks', text: ['id'], certain: 'confirmed',
  empty: { field: 'found', value: 'nothing' }, position: 'position', angle: 'angle', kind: 'kind',
  kinds: [
    { name: 'block', value: 0, outline: [[-0.02, -0.01], [0.02, -0.01], [0.02, 0.01], [-0.02, 0.01]], height: 0.025, colour: '#2850c8' },
    { name: 'flat_disc', value: 1, radius: 0.02, height: 0.02, colour: '#e6781e' },
    { name: 'obstacle', value: 65535, radius: 'radius', height: 0.1, colour: '#46464b' },
  ],
};
const camera: ReferenceFrame = { name: 'camera', label: 'Camera', shown: true, slot: 'camera_pose', frustum: { width: 640, height: 480, focal_length: 600, depth: 0.3 } };
const tool: ReferenceFrame = { name: 'tool', shown: true, link: 'hand', mount: { position: [0, 0, 0.1], orientation: [0, 0, 0, 1] } };

const track = (more: object = {}): { [field: string]: number | string | boolean | number[] } =>
  ({ id: 4, found: 'target', confirmed: true, kind: 0, position: [0.4, 0.1], angle: 0.5, radius: 0.03, ...more });
const list = (...all: object[]) => ({ tracks: all }) as never;

describe('bodies', () => {
  it('are what a list tells of', () => {
    expect(bodiesOf(tracks, list(track(), track({ found: 'nothing' }), track({ kind: 65535, confirmed: false, position: [0.5, 0, 0.2] })))).toEqual({
      leftOut: 0,
      bodies: [
        { kind: 0, place: [0.4, 0.1, 0], angle: 0.5, radius: 1, text: '4', certain: true },
        { kind: 2, place: [0.5, 0, 0.2], angle: 0.5, radius: 0.03, text: '4', certain: false },
      ],
    });
  });

  it('say how many cannot be drawn', () => {
    const odd = [track({ kind: 7 }), track({ position: [Number.NaN, 0] }), track({ position: 3 }), track({ kind: 65535, radius: 0 })];
    expect(bodiesOf(tracks, list(...odd, track({ kind: 1 })))).toMatchObject({ leftOut: 4, bodies: [{ kind: 1, radius: 0.02 }] });
  });
});

describe('in the scene', () => {
  const labels = document.createElement('div');
  const changed = vi.fn();
  const make = (frames: ReferenceFrame[] = []): Surroundings => new Surroundings([tracks], frames, '#888888', labels, changed);
  const meshes = (of: Surroundings): Mesh[] => {
    const found: Mesh[] = [];
    of.object.traverse((one) => { if (one instanceof Mesh && one.visible) found.push(one as Mesh); });
    return found;
  };
  const body: Body = { kind: 0, place: [0.4, 0.1, 0], angle: 0.5, radius: 1, text: '4', certain: true };
  afterEach(() => { changed.mockClear(); labels.replaceChildren(); });

  it('are prisms, those that are not certain transparent, and no more than there are', () => {
    const around = make();
    around.setBodies(0, [body, { ...body, kind: 2, radius: 0.03, certain: false }]);
    expect(changed).toHaveBeenCalledOnce();
    const [solid, ghost] = meshes(around) as [Mesh, Mesh];
    expect(solid.position.toArray()).toEqual([0.4, 0.1, 0]);
    expect(solid.rotation.z).toBe(0.5);
    expect((solid.material as MeshPhongMaterial).transparent).toBe(false);
    expect(ghost.scale.toArray()).toEqual([0.03, 0.03, 1]);
    expect((ghost.material as MeshPhongMaterial).transparent).toBe(true);
    expect((ghost.material as MeshPhongMaterial).color.getHexString()).toBe('46464b');
    ghost.geometry.computeBoundingBox();
    expect(ghost.geometry.boundingBox!.max.z).toBeCloseTo(0.1, 6);
    around.setBodies(0, [body]);
    expect(meshes(around)).toHaveLength(1);
  });

  it('stand in the frame of the base, and frames on slots or links', () => {
    const around = make([camera, tool]);
    const base = new Mesh();
    base.matrixWorld.makeTranslation(1, 0, 0);
    const hand = new Mesh();
    hand.matrixWorld.makeTranslation(0, 2, 0);
    const [, camera_object, tool_object] = around.object.children as [Object3D, Object3D, Object3D];
    around.follow(base, () => hand);
    expect([camera_object.visible, tool_object.visible]).toEqual([false, false]);
    around.setFrame(0, { position: [0, 0, 0.5], orientation: [0, 0, 0, 2] });
    around.setFrame(1, 'link');
    around.follow(base, (name) => (name === 'hand' ? hand : undefined));
    expect(camera_object.matrix.elements).toEqual(new Matrix4().makeTranslation(1, 0, 0.5).elements);
    expect(tool_object.matrix.elements).toEqual(new Matrix4().makeTranslation(0, 2, 0.1).elements);
    expect([camera_object.visible, tool_object.visible]).toEqual([true, true]);
    around.follow(base, () => undefined);
    expect(tool_object.visible).toBe(false);
    expect(camera_object.children).toHaveLength(2); // axes, and what it sees
    expect(tool_object.children).toHaveLength(1);
  });

  it('have words where they are seen', () => {
    const around = make([camera]);
    around.setBodies(0, [{ ...body, place: [0, 0, 0], certain: false }, { ...body, place: [0, 0, 9] }, { ...body, text: '' }]);
    around.follow(undefined, () => undefined);
    const eye = new PerspectiveCamera(40, 2, 0.01, 100);
    eye.position.set(0, 0, 5);
    eye.updateMatrixWorld();
    eye.updateProjectionMatrix();
    around.write(eye, 600, 300);
    const words = [...labels.children] as HTMLElement[];
    expect(words.map((one) => [one.textContent, one.hidden])).toEqual([['4?', false], ['', true]]); // the second is behind the camera
    expect(words[0]!.style.transform).toContain('translate(300.0px, 150.0px)');
    around.setFrame(0, { position: [0, 0, 0], orientation: [0, 0, 0, 1] });
    around.follow(undefined, () => undefined);
    around.write(eye, 600, 300);
    expect([...labels.children].map((one) => one.textContent)).toEqual(['4?', '', 'Camera', 'x', 'y', 'z']);
    around.dispose();
    expect(labels.children).toHaveLength(0);
  });
});

describe('the list of them', () => {
  let host: FakeHost;
  let around: SurroundingsList;
  const view = { setBodies: vi.fn<SurroundingsView['setBodies']>(), setFrame: vi.fn<SurroundingsView['setFrame']>() };

  beforeEach(async () => {
    view.setBodies.mockClear();
    view.setFrame.mockClear();
    host = new FakeHost();
    const placement: Placement = {
      name: 'cell', kind: 'robot', label: 'Cell', place: 'overview', slots: {}, parameters: {}, options: {}, bodies: [tracks], frames: [camera, tool],
    };
    around = Object.assign(new SurroundingsList(), { host, placement, label: 'Cell' });
    around.view = view;
    document.body.append(around);
    await settled(around);
  });
  afterEach(() => document.body.replaceChildren());
  const inside = <E extends Element>(selector: string): E[] => [...around.shadowRoot!.querySelectorAll<E>(selector)];
  const states = (): string[] => inside('.state').map((state) => state.textContent!.trim());
  async function tell(slot: string, value: unknown, reason = ''): Promise<void> {
    host.publish(`slot:${slot}`, value as never, { reason });
    await settled(around);
  }

  it('names rows, and kinds with their colours', () => {
    expect(inside('label').map((label) => label.textContent!.trim())).toEqual(['Tracks', 'Camera', 'Tool']);
    expect(inside('.sample').map((sample) => sample.textContent!.trim())).toEqual(['block', 'flat disc', 'obstacle']);
    expect(inside<HTMLElement>('.sample i')[0]!.style.background).toContain('rgb(40, 80, 200)');
    expect(states()).toEqual(['— nothing yet', '— nothing yet', '']);
  });

  it('hands on what slots tell, of all members', async () => {
    await tell('tracks[0]', list(track()));
    await tell('tracks[1]', list(track({ id: 5 }), track({ kind: 9 })));
    expect(view.setBodies.mock.lastCall?.[1].map((body) => body.text)).toEqual(['4', '5']);
    expect(states()[0]).toBe('2 drawn; ⚠ 1 of no known kind or place');
    await tell('tracks[1]', null, 'writer stopped');
    expect(view.setBodies.mock.lastCall?.[1].map((body) => body.text)).toEqual(['4']);
    await tell('tracks[0]', null, 'writer stopped');
    expect(states()[0]).toBe('— writer stopped');
    expect(view.setBodies.mock.lastCall?.[1]).toEqual([]);
  });

  it('hands on poses that are some, and links at once', async () => {
    expect(view.setFrame.mock.calls.filter(([index]) => index === 1).at(-1)?.[1]).toBe('link');
    await tell('camera_pose', { position: [1, 2, 3], orientation: [0, 0, 0, 1] });
    expect(view.setFrame.mock.calls.filter(([index]) => index === 0).at(-1)?.[1]).toEqual({ position: [1, 2, 3], orientation: [0, 0, 0, 1] });
    await tell('camera_pose', { position: [1, 2, 3], orientation: [0, 0, 0, 0] });
    expect(view.setFrame.mock.calls.filter(([index]) => index === 0).at(-1)?.[1]).toBeUndefined();
    expect(states()[1]).toBe('— no pose');
  });

  it('hides a row, and asks for it no longer', async () => {
    await tell('tracks[0]', list(track()));
    inside<HTMLInputElement>('input')[0]!.click();
    await settled(around);
    expect(host.watches.map((watch) => watch.key)).toEqual(['slot:camera_pose']);
    expect(view.setBodies.mock.lastCall?.[1]).toEqual([]);
    expect(states()[0]).toBe('hidden');
    around.remove();
    expect(host.watches).toEqual([]);
  });

  it('draws again with another view', async () => {
    await tell('tracks[0]', list(track()));
    const other = { setBodies: vi.fn<SurroundingsView['setBodies']>(), setFrame: vi.fn<SurroundingsView['setFrame']>() };
    around.view = other;
    expect(other.setBodies.mock.lastCall?.[1]).toHaveLength(1);
    expect(other.setFrame).toHaveBeenCalledWith(1, 'link');
  });

  it('says the same in a table', async () => {
    await tell('tracks[0]', list(track({ confirmed: false, kind: 1 })));
    const [details] = inside<HTMLDetailsElement>('details') as [HTMLDetailsElement];
    details.open = true;
    details.dispatchEvent(new Event('toggle'));
    await settled(around);
    expect(inside('tbody tr').map((row) => [...row.children].map((cell) => cell.textContent!.trim()).join(' | '))).toEqual([
      'Tracks | flat disc | 4 | 400.0 mm | 100.0 mm | 0 mm | 28.65 ° | no',
    ]);
  });
});
