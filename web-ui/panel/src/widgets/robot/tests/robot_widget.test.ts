import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { FakeCore, reading } from '../../../core/tests/fake_core';
import { cell } from '../../../core/tests/cell';
import { RobotWidget } from '../robot_widget';

customElements.define('flexrf-widget-robot', RobotWidget);

const urdf = `<robot name="r"><link name="base"/><link name="a"/><link name="b"/>
  <joint name="turn" type="revolute"><parent link="base"/><child link="a"/><limit lower="-1" upper="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="a"/><child link="b"/><limit lower="0" upper="0.5"/></joint></robot>`;

// What the generator made of it.
const chain = [
  { name: 'turn', unit: 'rad', range: [-1, 1] },
  { name: 'slide', unit: 'm', range: [0, 0.5] },
  { name: 'roll', unit: 'rad' },
] as const;

// A slot with a field `position`, as JointState has it.
const joints = {
  ...cell,
  types: [
    ...cell.types,
    {
      name: 'Joints', summary: 'Joints.', hash: '9', size: 64,
      fields: [{ name: 'position', scalar: 'f64', shape: [8], offset: 0, size: 64, unit: 'rad|m', summary: 'Positions.' }],
    },
  ],
  slots: [...cell.slots, { ...cell.slots[0]!, name: 'joints', type: 'Joints' }],
  devices: cell.devices.map((device) => (device.name === 'motor' ? { ...device, joints: chain } : device)),
};
const key = 'slot:joints.position';

let fake: FakeCore;
let widget: RobotWidget;

/** jsdom has no WebGL: what is shown is what a person without it gets. */
function place(files: { readonly [path: string]: string }, slots: { readonly [role: string]: string } = { joints: 'joints' }): void {
  fake = new FakeCore(joints);
  fake.host.file = async (path) => (path in files ? new Response(files[path]) : new Response('', { status: 404 }));
  widget = new RobotWidget();
  widget.host = fake.host;
  widget.placement = { name: 'view', kind: 'robot', label: 'Arm', place: 'overview', device: 'motor', slots, parameters: {}, options: {} };
  document.body.append(widget);
}
const text = (): string => widget.shadowRoot!.textContent!.replace(/\s+/g, ' ');

beforeEach(() => {
  HTMLCanvasElement.prototype.getContext = () => null;
});
afterEach(() => widget.remove());

it('shows the joints as a table where there is no 3D', { timeout: 30_000 }, async () => {
  place({ 'robots/motor.urdf': urdf });
  fake.value(key, reading([0.5, 0.25, 0, 0, 0, 0, 0, 0]));
  await vi.waitFor(() => expect(text()).toContain('No 3D view'), { timeout: 20_000 });
  await vi.waitFor(() => expect(text()).toContain('turn 28.65 °'));
  const rows = [...widget.shadowRoot!.querySelectorAll('tbody tr')].map((row) => row.textContent!.replace(/\s+/g, ' ').trim());
  expect(rows).toEqual(['turn 28.65 ° −57.30 ° 57.30 °', 'slide 250.0 mm 0 mm 500.0 mm', 'roll 0 ° no limit no limit']);
  expect(widget.shadowRoot!.querySelector('details')!.open).toBe(true);
  expect(widget.shadowRoot!.querySelector<HTMLElement>('.stage')!.hidden).toBe(true);
});

it('says which file is missing', async () => {
  place({});
  fake.value(key, reading([0.5, 0.25, 0, 0, 0, 0, 0, 0]));
  await vi.waitFor(() => expect(text()).toContain('robots/motor.urdf cannot be had (404)'));
  await vi.waitFor(() => expect(text()).toContain('slide 250.0 mm'));
});

it('says what the row lacks', async () => {
  place({}, { joints: 'nothing' });
  await vi.waitFor(() => expect(text()).toContain('names no slot with a field “position”'));
});

it('says why there are no positions', async () => {
  place({});
  await widget.updateComplete;
  fake.value(key, reading(null, { reason: 'writer stopped' }));
  expect(text()).toContain('writer stopped');
});

it('tells what is around it, without 3D too, and asks for that no longer once it is gone', { timeout: 30_000 }, async () => {
  const place_key = 'slot:place[0]';
  place({ 'robots/motor.urdf': urdf });
  widget.remove();
  const row = {
    name: 'things', shown: true, slots: ['place[0]'], text: [], position: 'at', kind: 'kind',
    kinds: [{ name: 'box', value: 'box', radius: 1, height: 1, colour: '#000000' }],
  };
  widget = Object.assign(new RobotWidget(), { host: fake.host, placement: { ...widget.placement!, bodies: [row] } });
  document.body.append(widget);
  const list = () => widget.shadowRoot!.querySelector('flexrf-surroundings');
  await vi.waitFor(() => expect(list()).not.toBeNull(), { timeout: 20_000 });
  expect(fake.isWatched(place_key)).toBe(true);
  fake.value(place_key, reading({ at: [1, 2], kind: 'box' }));
  await vi.waitFor(() => expect(list()!.shadowRoot!.querySelector('.state')!.textContent).toBe('1 drawn'));
  widget.remove();
  expect(fake.isWatched(place_key)).toBe(false);
});

it('asks for nothing once it is gone', async () => {
  place({ 'robots/motor.urdf': urdf });
  expect(fake.isWatched(key)).toBe(true);
  widget.remove();
  expect(fake.isWatched(key)).toBe(false);
});
