// Widget of kind "robot": the arm in 3D as its joints are now, and the joints as a table for those who cannot see it.
//
// [widget.NAME] kind = "robot", device = the arm, slots.joints = a slot with a field `position`, rad or m from the base to
// the tool (JointState, RobotArmFeedback). Rows of bodies and frames around it are in surroundings_list.ts.
import { css, html, nothing, type CSSResultGroup } from 'lit';
import type { ItemInfo, Joint, Placement, Value } from '../../contract';
import { loadPart } from '../../core/parts';
import { textOfError } from '../../core/reasons';
import { formatNumber } from '../../core/format_number';
import { displayUnits } from '../../core/units';
import { LiveText } from '../live_text';
import { widgetStyles } from '../styles';
import { WidgetBase } from '../widget_base';
import type { RobotScene } from './scene';
import type { SurroundingsList } from './surroundings_list';

/** A table that is read needs no 60 values a second. */
const table_period_ms = 250;
const turn_step = Math.PI / 12;
const zoom_step = 1.2;

interface View {
  readonly name: string;
  readonly sign: string;
  readonly act: (scene: RobotScene) => void;
}

/** All that dragging and the wheel do, by buttons. */
const views: readonly View[] = [
  { name: 'Turn left', sign: '←', act: (scene) => scene.turn(-turn_step, 0) },
  { name: 'Turn right', sign: '→', act: (scene) => scene.turn(turn_step, 0) },
  { name: 'Look from higher', sign: '↑', act: (scene) => scene.turn(0, turn_step) },
  { name: 'Look from lower', sign: '↓', act: (scene) => scene.turn(0, -turn_step) },
  { name: 'Closer', sign: '+', act: (scene) => scene.zoom(1 / zoom_step) },
  { name: 'Farther', sign: '−', act: (scene) => scene.zoom(zoom_step) },
  { name: 'Reset view', sign: 'Reset view', act: (scene) => scene.resetView() },
];

export class RobotWidget extends WidgetBase {
  static override styles: CSSResultGroup = [
    widgetStyles,
    css`
      .stage {
        position: relative;
        aspect-ratio: 4 / 3;
        min-height: 220px;
        max-height: 480px;
        background: var(--field);
        border: 1px solid var(--border);
        border-radius: var(--radius);
        overflow: hidden;
      }
      [hidden] {
        display: none !important;
      }
      canvas {
        position: absolute;
        inset: 0;
        width: 100%;
        height: 100%;
        display: block;
      }
      canvas:focus-visible {
        outline: 3px solid var(--focus);
        outline-offset: -3px;
      }
      :host([stale]) canvas {
        filter: grayscale(1) opacity(0.5);
      }
      :host([stale]) table {
        color: var(--stale);
        font-style: italic;
      }
      .labels {
        position: absolute;
        inset: 0;
        pointer-events: none;
      }
      .labels > span {
        position: absolute;
        inset: 0 auto auto 0;
        padding: 0 3px;
        border-radius: 2px;
        background: color-mix(in srgb, var(--surface) 80%, transparent);
        font-size: 0.8em;
        white-space: nowrap;
      }
      .labels > .letter {
        padding: 0;
        background: none;
        color: var(--muted);
      }
      section {
        position: relative;
      }
      /* Over the picture that stands still: what lies below does not move. */
      #absence.over {
        position: absolute;
        inset: 0 auto auto 0;
        margin: 0;
        padding: 2px 6px;
        background: var(--surface);
      }
      .views {
        display: flex;
        flex-wrap: wrap;
        gap: 4px;
        margin-block: 4px;
      }
      table {
        border-collapse: collapse;
      }
      caption {
        text-align: start;
        color: var(--muted);
      }
      th,
      td {
        text-align: start;
        font-weight: 400;
        padding: 1px 1em 1px 0;
      }
      td.number {
        text-align: end;
      }
      summary {
        min-height: max(24px, calc(var(--target) * 0.75));
        cursor: pointer;
      }
      summary:focus-visible {
        outline: 3px solid var(--focus);
      }
    `,
  ];

  private joints: readonly Joint[] = [];
  private positions: readonly number[] = [];
  private cells: LiveText[] = [];
  private scene: RobotScene | undefined;
  private list: SurroundingsList | undefined;
  /** Why there is no 3D view; empty while there is one, or none yet. */
  private trouble = '';
  private tableAt = 0;
  private tableTimer: ReturnType<typeof setTimeout> | undefined;
  private generation = 0;

  override connectedCallback(): void {
    super.connectedCallback();
    this.generation += 1;
    if (this.hasUpdated) void this.build(this.generation);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.generation += 1;
    clearTimeout(this.tableTimer);
    this.tableTimer = undefined;
    if (this.list) this.list.view = undefined;
    this.scene?.dispose();
    this.scene = undefined;
    this.renewCanvas();
  }

  /** A canvas whose context was given back gets no other: the next view gets a new canvas. */
  private renewCanvas(): void {
    this.renderRoot.querySelector('canvas')?.replaceWith(this.makeCanvas());
  }

  private again(): void {
    this.renewCanvas();
    this.trouble = '';
    this.requestUpdate();
    void this.build(this.generation);
  }

  protected override firstUpdated(): void {
    this.renderRoot.querySelector('.stage')!.prepend(this.makeCanvas());
    super.firstUpdated();
    void this.build(this.generation);
    if (this.placement?.bodies || this.placement?.frames) void this.addList(this.placement);
  }

  private async addList(placement: Placement): Promise<void> {
    try {
      const { SurroundingsList } = await loadPart(() => import('./surroundings_list'));
      this.list = Object.assign(new SurroundingsList(), { host: this.host, placement, label: this.label });
      this.find('.around').append(this.list);
      this.surround();
    } catch (error) {
      this.note = `Nothing is drawn around the robot: ${textOfError(error)}`;
      this.requestUpdate();
    }
  }

  /** Once both are there: what the list tells is drawn in the scene. */
  private surround(): void {
    if (this.list && this.scene && this.placement) this.list.view = this.scene.surround(this.placement, this.find('.labels'));
  }

  /** The position of the joints, whatever else the slot holds. */
  protected override begin(): void {
    const slot = this.placement?.slots['joints'];
    const item: ItemInfo | undefined =
      slot === undefined ? this.item : (this.host.item(`slot:${slot}.position`) ?? this.host.item(slot));
    if (item) this.item = item;
    this.note = item ? '' : 'The widget\'s row names no slot with a field “position”: add slots = { joints = "..." }.';
    super.begin();
  }

  /** Enough to see motion; without a graphics processor each picture costs. */
  protected override watchOptions(): { rate: number } {
    return { rate: 30 };
  }

  protected override render(): unknown {
    return html`
      <section aria-label=${this.label}>
        <div class="stage" ?hidden=${this.trouble !== ''}><div class="labels" aria-hidden="true"></div></div>
        <div class="views" role="group" aria-label="View of ${this.label}" ?hidden=${this.trouble !== ''}>
          ${views.map((view) => html`
            <button aria-label=${view.name} title=${view.name} @click=${() => this.scene && view.act(this.scene)}>${view.sign}</button>
          `)}
        </div>
        ${this.trouble === '' ? nothing : html`<p class="abnormal" role="status">No 3D view: ${this.trouble}
          <button @click=${() => this.again()}>Try again</button></p>`}
        <p class="abnormal ${this.trouble === '' ? 'over' : ''}" id="absence"></p>
        ${this.note === '' ? nothing : html`<p class="abnormal">${this.note}</p>`}
        <div class="around"></div>
        <details ?open=${this.trouble !== ''}>
          <summary>Joints as a table</summary>
          ${this.table()}
        </details>
      </section>
    `;
  }

  protected override updated(): void {
    const cells = [...this.renderRoot.querySelectorAll('td.number')];
    // The Text nodes stay the table's own: Lit does not write into these cells.
    if (cells.length !== this.cells.length) this.cells = cells.map((cell) => new LiveText(cell, '–'));
    this.writeTable();
  }

  protected override show(value: Value | null): void {
    if (!Array.isArray(value)) return;
    this.positions = value.filter((one): one is number => typeof one === 'number');
    this.scene?.setJoints(this.named());
    if (this.tableTimer !== undefined) return;
    const wait = Math.max(0, this.tableAt + table_period_ms - performance.now());
    this.tableTimer = setTimeout(() => {
      this.tableTimer = undefined;
      this.writeTable();
    }, wait);
  }

  private table(): unknown {
    if (this.joints.length === 0) return html`<p>Not known yet.</p>`;
    return html`
      <table>
        <caption>
          ${this.label}: positions of the joints, from the base to the tool
        </caption>
        <thead>
          <tr>
            <th scope="col">Joint</th>
            <th scope="col">Position</th>
            <th scope="col">From</th>
            <th scope="col">To</th>
          </tr>
        </thead>
        <tbody>
          ${this.joints.map((joint) => html`
            <tr>
              <th scope="row">${joint.name}</th>
              <td class="number"></td>
              <td>${joint.range ? quantity(joint.range[0], joint.unit) : 'no limit'}</td>
              <td>${joint.range ? quantity(joint.range[1], joint.unit) : 'no limit'}</td>
            </tr>
          `)}
        </tbody>
      </table>
    `;
  }

  private writeTable(): void {
    this.tableAt = performance.now();
    this.cells.forEach((cell, i) => {
      const position = this.positions[i];
      cell.text = position === undefined ? '–' : quantity(position, this.joints[i]?.unit ?? 'rad');
    });
  }

  private named(): (readonly [string, number])[] {
    return this.joints.flatMap((joint, i) => {
      const position = this.positions[i];
      return position === undefined ? [] : [[joint.name, position] as const];
    });
  }

  private makeCanvas(): HTMLCanvasElement {
    const canvas = document.createElement('canvas');
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'img');
    canvas.setAttribute('aria-label', `${this.label} in 3D; drag to turn. The table below holds the same.`);
    return canvas;
  }

  private async build(generation: number): Promise<void> {
    const device = this.placement?.device ?? this.item?.component;
    let text = '';
    try {
      if (device === undefined) throw new Error('the table names no device; add device = "..." to the widget');
      this.joints = this.host.joints(device);
      const response = await this.host.file(`robots/${device}.urdf`);
      if (!response.ok) throw new Error(`the robot's file robots/${device}.urdf cannot be had (${response.status})`);
      text = await response.text();
    } catch (error) {
      this.fail(generation, error);
      return;
    }
    try {
      const { RobotScene } = await loadPart(() => import('./scene'));
      if (generation !== this.generation) return;
      const style = getComputedStyle(this);
      const colour = (name: string, otherwise: string): string => style.getPropertyValue(name).trim() || otherwise;
      const canvas = this.find<HTMLCanvasElement>('canvas');
      const colours = { line: colour('--track', '#d2d6da'), axis: colour('--border', '#767d86') };
      this.scene = new RobotScene({ canvas, colours });
      this.scene.load(text);
      this.scene.setJoints(this.named());
      this.follow(this.scene, canvas);
      this.surround();
    } catch (error) {
      this.scene?.dispose();
      this.scene = undefined;
      this.fail(generation, error);
      return;
    }
    this.trouble = '';
    this.requestUpdate();
  }

  /** Size and visibility of the canvas, while the scene lives. */
  private follow(scene: RobotScene, canvas: HTMLCanvasElement): void {
    const sizes = new ResizeObserver(() => scene.resize(canvas.clientWidth, canvas.clientHeight));
    const views = new IntersectionObserver((entries) => (scene.visible = entries.at(-1)?.isIntersecting ?? true));
    sizes.observe(canvas);
    views.observe(canvas);
    this.until(() => {
      sizes.disconnect();
      views.disconnect();
    });
  }

  private fail(generation: number, error: unknown): void {
    if (generation !== this.generation) return;
    this.trouble = textOfError(error);
    this.requestUpdate();
  }
}

function quantity(si: number, unit: string): string {
  const shown = displayUnits.of(unit);
  return `${formatNumber(displayUnits.toDisplay(si, unit), { digits: 4 })} ${shown.text}`;
}
