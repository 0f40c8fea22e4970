// The 3D scene of one robot. It and surroundings.ts alone know three.js: they come with a chunk of their own, when one is shown.
import {
  AmbientLight, Box3, DirectionalLight, GridHelper, LoadingManager, Material, MathUtils, Mesh, PerspectiveCamera, Scene, Spherical,
  Vector3, WebGLRenderer, type Object3D,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import URDFLoader, { type URDFRobot } from 'urdf-loader';
import type { Placement } from '../../contract';
import { Surroundings, type SurroundingsView } from './surroundings';

/** Where the files of robots lie: a URDF names its meshes relative to it, or as package://NAME/PATH. */
const folder = '/application/robots/';

/** Sharper than this costs more than it shows. */
const most_pixels = 2;

/** rad or m: less than a pixel at any size, more than the noise of a sensor at rest. */
const least_motion = 2e-4;

/** How much more than the robot as it stands is seen: it moves. */
const room = 1.05;

export interface SceneOptions {
  readonly canvas: HTMLCanvasElement;
  /** CSS colours of the grid: its lines, and those through the origin. */
  readonly colours: { readonly line: string; readonly axis: string };
}

/** Draws only when something changed. Throws when there is no WebGL. */
export class RobotScene {
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(40, 1, 0.01, 100);
  private readonly renderer: WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly end = new AbortController();
  private readonly axisColour: string;
  private robot: URDFRobot | undefined;
  private surroundings: Surroundings | undefined;
  /** Link in whose frame they are told. */
  private base = '';
  private frame = 0;
  private shown = true;
  /** The person chose another view: a new size leaves it alone. */
  private chosen = false;

  constructor({ canvas, colours }: SceneOptions) {
    this.axisColour = colours.axis;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(globalThis.devicePixelRatio, most_pixels));
    this.camera.up.set(0, 0, 1); // z is up in robotics
    const key = new DirectionalLight(0xffffff, 2.2);
    key.position.set(2, -3, 4);
    const fill = new DirectionalLight(0xffffff, 0.8);
    fill.position.set(-3, 2, 1);
    const grid = new GridHelper(4, 16, colours.axis, colours.line);
    grid.rotation.x = Math.PI / 2;
    this.scene.add(new AmbientLight(0xffffff, 1.2), key, fill, grid);

    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.invalidate());
    this.controls.addEventListener('start', () => (this.chosen = true));
    // The wheel scrolls the page until the person turned to the view.
    this.controls.enableZoom = false;
    const { signal } = this.end;
    canvas.addEventListener('focus', () => (this.controls.enableZoom = true), { signal });
    canvas.addEventListener('blur', () => (this.controls.enableZoom = false), { signal });
    canvas.addEventListener('webglcontextlost', (event) => event.preventDefault(), { signal });
    canvas.addEventListener('webglcontextrestored', () => this.invalidate(), { signal });
  }

  /** Throws when the text is no robot. Meshes come in as they are loaded. */
  load(urdf: string): void {
    const manager = new LoadingManager();
    manager.itemEnd = ((end) => (address: string) => {
      end.call(manager, address);
      this.invalidate();
    })(manager.itemEnd);
    const loader = new URDFLoader(manager);
    loader.workingPath = folder;
    loader.packages = `${folder}packages`;
    this.robot = loader.parse(urdf);
    this.scene.add(this.robot);
    this.resetView();
  }

  /** rad or m, by the joints' names. */
  setJoints(positions: Iterable<readonly [string, number]>): void {
    let moved = false;
    for (const [name, position] of positions) {
      const joint = this.robot?.joints[name];
      if (!joint || Math.abs(Number(joint.jointValue[0]) - position) < least_motion) continue;
      moved = joint.setJointValue(position) || moved;
    }
    if (moved) this.invalidate();
  }

  /** What is drawn around the robot; words come into `labels`, which lies over the canvas. */
  surround({ bodies = [], frames = [], base = '' }: Placement, labels: HTMLElement): SurroundingsView {
    this.surroundings = new Surroundings(bodies, frames, this.axisColour, labels, () => this.invalidate());
    this.base = base;
    this.scene.add(this.surroundings.object);
    return this.surroundings;
  }

  resize(width: number, height: number): void {
    if (width <= 0 || height <= 0) return;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.renderer.setSize(width, height, false);
    if (!this.chosen) this.resetView();
    this.draw(); // at once: a canvas of a new size is empty
  }

  /** Nothing is drawn while nobody sees it. */
  set visible(visible: boolean) {
    this.shown = visible;
    if (visible) this.invalidate();
  }

  /** The whole robot from its right side, a little above: x to the right, y away, with room to move. */
  resetView(): void {
    this.chosen = false;
    const bounds = this.robot ? new Box3().setFromObject(this.robot) : new Box3();
    if (bounds.isEmpty()) bounds.set(new Vector3(-0.5, -0.5, 0), new Vector3(0.5, 0.5, 1));
    const centre = bounds.getCenter(new Vector3());
    const radius = Math.max(0.05, room * 0.5 * bounds.getSize(new Vector3()).length());
    const half = MathUtils.degToRad(this.camera.fov / 2);
    const narrow = Math.min(half, Math.atan(Math.tan(half) * this.camera.aspect));
    this.camera.position.copy(centre).addScaledVector(new Vector3(0.35, -1, 0.45).normalize(), radius / Math.sin(narrow));
    this.camera.near = radius / 50;
    this.camera.far = radius * 100;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(centre);
    this.controls.update();
    this.invalidate();
  }

  /** rad about the vertical, and towards the top. */
  turn(around: number, up: number): void {
    this.moveCamera((place) => {
      place.theta += around;
      place.phi -= up;
    });
  }

  /** Above 1: away. */
  zoom(factor: number): void {
    this.moveCamera((place) => (place.radius *= factor));
  }

  dispose(): void {
    this.end.abort();
    cancelAnimationFrame(this.frame);
    this.controls.dispose();
    this.surroundings?.dispose();
    this.scene.traverse(free);
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private moveCamera(change: (place: Spherical) => void): void {
    this.chosen = true;
    // Spherical has y upwards.
    const offset = this.camera.position.clone().sub(this.controls.target);
    const place = new Spherical().setFromCartesianCoords(offset.y, offset.z, offset.x);
    change(place);
    place.makeSafe();
    const moved = new Vector3().setFromSpherical(place);
    this.camera.position.set(moved.z, moved.x, moved.y).add(this.controls.target);
    this.controls.update();
    this.invalidate();
  }

  private invalidate(): void {
    if (this.frame !== 0 || !this.shown) return;
    this.frame = requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
    const { robot, surroundings } = this;
    robot?.updateMatrixWorld();
    surroundings?.follow(robot?.links[this.base] ?? robot, (name) => robot?.links[name]);
    this.renderer.render(this.scene, this.camera);
    const { clientWidth, clientHeight } = this.renderer.domElement;
    surroundings?.write(this.camera, clientWidth, clientHeight);
  }
}

function free(object: Object3D): void {
  if (!(object instanceof Mesh) && !('geometry' in object)) return;
  const { geometry, material } = object as Mesh;
  geometry.dispose();
  for (const one of Array.isArray(material) ? material : [material]) if (one instanceof Material) one.dispose();
}
