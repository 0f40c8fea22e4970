// Bodies and frames of reference around a robot, in three; their words lie over the canvas.
import {
  BufferGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Matrix4, Mesh, MeshPhongMaterial, Quaternion, Vector3,
  type Camera, type Object3D,
} from 'three';
import type { Bodies, ReferenceFrame } from '../../contract';
import { titleOf } from '../things';
import type { Body } from './bodies';
import { circle, prism } from './prism';

const axis_length = 0.08; // m
const axis_colours = [[0.83, 0.2, 0.2], [0.16, 0.6, 0.2], [0.2, 0.4, 0.9]] as const;
const axis_names = ['x', 'y', 'z'] as const;

export interface Pose {
  readonly position: readonly number[];
  readonly orientation: readonly number[];
}

/** What the list of bodies and frames draws with. */
export interface SurroundingsView {
  /** Of one row, in its order. */
  setBodies(row: number, bodies: readonly Body[]): void;
  /** undefined: it is hidden, or where it is is not known. One on a link follows that. */
  setFrame(index: number, pose: Pose | 'link' | undefined): void;
}

interface Kind {
  readonly geometry: BufferGeometry;
  readonly height: number;
  readonly solid: MeshPhongMaterial;
  readonly ghost: MeshPhongMaterial;
}

interface Row {
  readonly kinds: readonly Kind[];
  readonly meshes: Mesh[];
  bodies: readonly Body[];
}

/** Words in the scene, and where. */
interface Words {
  readonly text: string;
  readonly at: Vector3;
  /** Of an axis: plain. */
  readonly isLetter: boolean;
}

interface Frame {
  readonly declared: ReferenceFrame;
  readonly object: Group;
  readonly mount: Matrix4;
  pose: Pose | 'link' | undefined;
}

function geometryOf(positions: readonly number[], more: { readonly [attribute: string]: readonly number[] }): BufferGeometry {
  const geometry = new BufferGeometry();
  for (const [name, values] of Object.entries({ position: positions, ...more })) geometry.setAttribute(name, new Float32BufferAttribute(values, 3));
  return geometry;
}

function matrixOf(pose: Pose): Matrix4 {
  return new Matrix4().compose(new Vector3().fromArray([...pose.position]), new Quaternion().fromArray([...pose.orientation]).normalize(), new Vector3(1, 1, 1));
}

/** Corners of what the camera sees at the depth, from the upper left one on. */
function cornersOf({ width, height, focal_length, depth }: NonNullable<ReferenceFrame['frustum']>): number[][] {
  const [x, y] = [((width / 2) * depth) / focal_length, ((height / 2) * depth) / focal_length];
  return [[-x, -y, depth], [x, -y, depth], [x, y, depth], [-x, y, depth]];
}

export class Surroundings implements SurroundingsView {
  readonly object = new Group();
  readonly #rows: readonly Row[];
  readonly #frames: readonly Frame[];
  /** What is told in the base link's frame. */
  readonly #around = new Group();
  #words: HTMLElement[] = [];

  constructor(
    bodies: readonly Bodies[], frames: readonly ReferenceFrame[], lineColour: string,
    private readonly labels: HTMLElement, private readonly changed: () => void,
  ) {
    this.#rows = bodies.map((row) => ({ kinds: row.kinds.map(makeKind), meshes: [], bodies: [] }));
    this.#frames = frames.map((declared) => ({
      declared, object: makeFrame(declared, lineColour), pose: undefined,
      mount: declared.mount ? matrixOf(declared.mount) : new Matrix4(),
    }));
    this.#around.matrixAutoUpdate = false;
    this.object.add(this.#around, ...this.#frames.map((frame) => frame.object));
  }

  setBodies(row: number, bodies: readonly Body[]): void {
    const one = this.#rows[row];
    if (!one) return;
    one.bodies = bodies;
    while (one.meshes.length < bodies.length) {
      const mesh = new Mesh();
      one.meshes.push(mesh);
      this.#around.add(mesh);
    }
    one.meshes.forEach((mesh, i) => {
      const body = bodies[i];
      const kind = body && one.kinds[body.kind];
      mesh.visible = kind !== undefined;
      if (!kind) return;
      mesh.geometry = kind.geometry;
      mesh.material = body.certain ? kind.solid : kind.ghost;
      mesh.position.set(...body.place);
      mesh.rotation.z = body.angle;
      mesh.scale.set(body.radius, body.radius, 1);
    });
    this.changed();
  }

  setFrame(index: number, pose: Pose | 'link' | undefined): void {
    const frame = this.#frames[index];
    if (!frame) return;
    frame.pose = pose;
    this.changed();
  }

  /** Puts everything where the robot's links are now. */
  follow(base: Object3D | undefined, linkOf: (name: string) => Object3D | undefined): void {
    this.#around.matrix.copy(base?.matrixWorld ?? new Matrix4());
    this.#around.matrixWorldNeedsUpdate = true;
    for (const { declared, object, mount, pose } of this.#frames) {
      const link = declared.link === undefined ? undefined : linkOf(declared.link);
      object.visible = pose !== undefined && (pose !== 'link' || link !== undefined);
      if (pose === undefined) continue;
      if (pose === 'link') object.matrix.copy(link?.matrixWorld ?? new Matrix4());
      else object.matrix.copy(this.#around.matrix).multiply(matrixOf(pose));
      object.matrix.multiply(mount);
      object.matrixWorldNeedsUpdate = true;
    }
  }

  /** Writes the words where the camera sees what they are about; px of the screen. */
  write(camera: Camera, width: number, height: number): void {
    const wanted = this.#wanted();
    while (this.#words.length < wanted.length) {
      const element = document.createElement('span');
      this.#words.push(element);
      this.labels.append(element);
    }
    this.#words.forEach((element, i) => {
      const one = wanted[i];
      const at = one?.at.project(camera);
      const isSeen = at !== undefined && Math.abs(at.z) < 1;
      element.hidden = !isSeen;
      if (!one || !isSeen) return;
      if (element.textContent !== one.text) element.textContent = one.text;
      element.classList.toggle('letter', one.isLetter);
      element.style.transform = `translate(${(((at.x + 1) * width) / 2).toFixed(1)}px, ${(((1 - at.y) * height) / 2).toFixed(1)}px) translate(-50%, -100%)`;
    });
  }

  dispose(): void {
    for (const { kinds } of this.#rows) {
      for (const { geometry, solid, ghost } of kinds) for (const one of [geometry, solid, ghost]) one.dispose();
    }
    this.labels.replaceChildren();
  }

  #wanted(): Words[] {
    const wanted: Words[] = [];
    const add = (text: string, at: Vector3, { matrix }: Group, isLetter = false): void => {
      wanted.push({ text, at: at.applyMatrix4(matrix), isLetter });
    };
    for (const { bodies, kinds } of this.#rows) {
      for (const { text, certain, place: [x, y, z], kind } of bodies) {
        const words = certain ? text : `${text}?`;
        if (words !== '') add(words, new Vector3(x, y, z + (kinds[kind]?.height ?? 0)), this.#around);
      }
    }
    for (const { declared, object } of this.#frames) {
      if (!object.visible) continue;
      add(titleOf(declared), new Vector3(), object);
      axis_names.forEach((text, i) => add(text, new Vector3().setComponent(i, axis_length * 1.1), object, true));
    }
    return wanted;
  }
}

function makeKind({ outline, height, colour }: Bodies['kinds'][number]): Kind {
  const { positions, normals } = prism(outline ?? circle, height);
  return {
    geometry: geometryOf(positions, { normal: normals }), height,
    solid: new MeshPhongMaterial({ color: colour }),
    ghost: new MeshPhongMaterial({ color: colour, transparent: true, opacity: 0.35, depthWrite: false }),
  };
}

/** Axes, and the edges of what a camera there sees. */
function makeFrame({ frustum }: ReferenceFrame, lineColour: string): Group {
  const group = new Group();
  group.matrixAutoUpdate = false;
  group.visible = false;
  const axes = axis_names.flatMap((_, i) => [0, 0, 0, ...new Vector3().setComponent(i, axis_length).toArray()]);
  const colours = axis_colours.flatMap((colour) => [...colour, ...colour]);
  group.add(new LineSegments(geometryOf(axes, { color: colours }), new LineBasicMaterial({ vertexColors: true })));
  if (frustum) {
    const corners = cornersOf(frustum);
    const edges = corners.flatMap((corner, i) => [0, 0, 0, ...corner, ...corner, ...corners[(i + 1) % 4]!]);
    group.add(new LineSegments(geometryOf(edges, {}), new LineBasicMaterial({ color: lineColour })));
  }
  return group;
}
