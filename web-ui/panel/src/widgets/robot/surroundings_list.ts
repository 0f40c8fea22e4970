// What is drawn around a robot: rows of bodies and frames, each with a switch, and the bodies as a table.
import { css, html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { Placement, Reading, WidgetHost } from '../../contract';
import { formatNumber } from '../../core/format_number';
import { displayUnits } from '../../core/units';
import { EndingElement } from '../ending_element';
import { layerStyles } from '../layer_styles';
import { LiveText } from '../live_text';
import { widgetStyles } from '../styles';
import { fieldOf, titleOf } from '../things';
import { absence, words } from '../value_text';
import { bodiesOf, type Seen } from './bodies';
import type { Pose, SurroundingsView } from './surroundings';

/** A table that is read needs no 30 values a second. */
const table_period_ms = 500;
const most_rows = 100;

const nothing_yet: Seen & { readonly reason: string } = { bodies: [], leftOut: 0, reason: 'nothing yet' };

/** A row of the widget's, of bodies or a frame. */
interface Layer {
  readonly title: string;
  readonly slots: readonly string[];
  shown: boolean;
  end: (() => void)[];
  readonly take: (slot: string, reading: Reading) => void;
  /** Draws it as it is now, or takes it away. */
  readonly draw: () => void;
  readonly state: () => string;
}

export class SurroundingsList extends EndingElement {
  static override styles = [
    widgetStyles,
    layerStyles,
    css`
      .sample i {
        width: 14px;
        height: 14px;
        border: 1px solid var(--border);
      }
    `,
  ];

  host!: WidgetHost;
  placement!: Placement;
  label = '';

  private layers: readonly Layer[] = [];
  /** By row and slot. */
  private seen: readonly Map<string, typeof nothing_yet>[] = [];
  private drawn: SurroundingsView | undefined;
  private states: readonly LiveText[] = [];
  private open = false;
  private isDue = false;
  private tableTimer: ReturnType<typeof setTimeout> | undefined;

  override connectedCallback(): void {
    super.connectedCallback();
    if (this.layers.length === 0) this.layers = this.makeLayers();
    this.layers.forEach((layer) => this.follow(layer));
    this.until(displayUnits.watch(() => this.requestUpdate()));
    this.until(() => {
      this.layers.forEach((layer) => layer.end.splice(0).forEach((end) => end()));
      clearTimeout(this.tableTimer);
      this.tableTimer = undefined;
    });
  }

  /** What it draws with; undefined: there is no 3D view. */
  set view(view: SurroundingsView | undefined) {
    this.drawn = view;
    this.layers.forEach((layer) => layer.draw());
  }

  private makeLayers(): Layer[] {
    const { bodies = [], frames = [] } = this.placement;
    this.seen = bodies.map((row) => new Map(row.slots.map((slot) => [slot, nothing_yet] as const)));
    const rows = bodies.map((row, index): Layer => {
      const seen = this.seen[index]!;
      const all = (): (typeof nothing_yet)[] => [...seen.values()];
      const layer: Layer = {
        title: titleOf(row), slots: row.slots, shown: row.shown, end: [],
        take: (slot, reading) => {
          const found = reading.value === null ? { bodies: [], leftOut: 0 } : bodiesOf(row, reading.value);
          seen.set(slot, { ...found, reason: absence(reading) });
        },
        draw: () => this.drawn?.setBodies(index, layer.shown ? all().flatMap((one) => one.bodies) : []),
        state: () => {
          if (all().every((one) => one.reason !== '')) return `— ${all()[0]?.reason ?? ''}`;
          const leftOut = all().reduce((sum, one) => sum + one.leftOut, 0);
          const count = `${all().reduce((sum, one) => sum + one.bodies.length, 0)} drawn`;
          return leftOut > 0 ? `${count}; ⚠ ${leftOut} of no known kind or place` : count;
        },
      };
      return layer;
    });
    return [...rows, ...frames.map((frame, index): Layer => {
      let pose: Pose | 'link' | undefined = frame.link === undefined ? undefined : 'link';
      let reason = frame.link === undefined ? 'nothing yet' : '';
      const layer: Layer = {
        title: titleOf(frame), slots: frame.slot === undefined ? [] : [frame.slot], shown: frame.shown, end: [],
        take: (_slot, reading) => {
          pose = poseOf(reading);
          reason = pose ? '' : absence(reading) || 'no pose';
        },
        draw: () => this.drawn?.setFrame(index, layer.shown ? pose : undefined),
        state: () => (reason === '' ? '' : `— ${reason}`),
      };
      return layer;
    })];
  }

  /** Begins or ends to ask for what the layer shows. */
  private follow(layer: Layer): void {
    layer.end.splice(0).forEach((end) => end());
    if (layer.shown) {
      for (const slot of layer.slots) {
        layer.end.push(this.host.watch(`slot:${slot}`, (reading) => {
          layer.take(slot, reading);
          this.schedule();
        }, { rate: 30 }));
      }
    }
    this.schedule();
  }

  /** Once for all readings that come in one frame of the screen. */
  private schedule(): void {
    if (this.isDue) return;
    this.isDue = true;
    queueMicrotask(() => {
      this.isDue = false;
      this.layers.forEach((layer, i) => {
        layer.draw();
        const state = this.states[i];
        if (!state) return;
        const text = layer.shown ? layer.state() : 'hidden';
        if (state.text === text) return;
        state.text = text;
        this.renderRoot.querySelectorAll('.state')[i]?.classList.toggle('abnormal', text.includes('⚠'));
      });
      if (this.open) this.tableTimer ??= setTimeout(() => this.writeTable(), table_period_ms);
    });
  }

  private writeTable(): void {
    this.tableTimer = undefined;
    this.requestUpdate();
  }

  private toggle(layer: Layer, shown: boolean): void {
    layer.shown = shown;
    this.follow(layer);
  }

  protected override firstUpdated(): void {
    this.states = [...this.renderRoot.querySelectorAll('.state')].map((element) => new LiveText(element));
    this.schedule();
  }

  protected override updated(): void {
    // Inline styles are not allowed in texts.
    this.renderRoot.querySelectorAll<HTMLElement>('[data-colour]').forEach((one) => (one.style.background = one.dataset['colour'] ?? ''));
  }

  protected override render(): TemplateResult {
    return html`
      <ul aria-label="Drawn around ${this.label}">
        ${this.layers.map((layer, i) => html`
          <li>
            <label>
              <input
                type="checkbox"
                .checked=${layer.shown}
                @change=${(event: Event) => this.toggle(layer, (event.target as HTMLInputElement).checked)}
              />${layer.title}
            </label>
            <span>${this.placement.bodies?.[i]?.kinds.map(({ name, colour }) =>
              html`<span class="sample"><i data-colour=${colour} aria-hidden="true"></i>${words(name)}</span>`)}</span>
            <span class="state"></span>
          </li>
        `)}
      </ul>
      ${this.seen.length === 0 ? nothing : html`
        <details @toggle=${(event: Event) => this.turn((event.target as HTMLDetailsElement).open)}>
          <summary>Bodies as a table</summary>
          ${this.open ? this.table() : nothing}
        </details>
      `}
    `;
  }

  private turn(open: boolean): void {
    this.open = open;
    this.requestUpdate();
  }

  private table(): TemplateResult {
    const rows = (this.placement.bodies ?? []).flatMap((row, i) =>
      !this.layers[i]?.shown ? [] : [...this.seen[i]!.values()].flatMap(({ bodies }) => bodies.map((body) => ({ row, body }))));
    const left = rows.length - most_rows;
    return html`
      <div class="scroll" tabindex="0" role="region" aria-label="Bodies around ${this.label}">
        <table>
          <caption>${this.label}: ${rows.length} bodies, in the robot's frame${left > 0 ? `; ${left} more than these` : ''}</caption>
          <thead>
            <tr>
              ${['Row', 'Kind', 'Text', 'x', 'y', 'z', 'Angle', 'Certain'].map((name) => html`<th scope="col">${name}</th>`)}
            </tr>
          </thead>
          <tbody>
            ${rows.slice(0, most_rows).map(({ row, body }) => html`
              <tr>
                <th scope="row">${titleOf(row)}</th>
                <td>${words(row.kinds[body.kind]?.name ?? '')}</td>
                <td>${body.text}</td>
                ${body.place.map((value) => html`<td class="number">${quantity(value, 'm')}</td>`)}
                <td class="number">${quantity(body.angle, 'rad')}</td>
                <td>${body.certain ? 'yes' : 'no'}</td>
              </tr>
            `)}
          </tbody>
        </table>
      </div>
    `;
  }
}

/** undefined: there is none, or it is none. */
function poseOf(reading: Reading): Pose | undefined {
  const numbers = (field: string, count: number): number[] | undefined => {
    const value = reading.value === null ? undefined : fieldOf(reading.value, field);
    const all = Array.isArray(value) ? value.filter((one): one is number => typeof one === 'number' && Number.isFinite(one)) : [];
    return all.length === count ? all : undefined;
  };
  const position = numbers('position', 3);
  const orientation = numbers('orientation', 4);
  return position && orientation && Math.hypot(...orientation) > 0 ? { position, orientation } : undefined;
}

function quantity(si: number, unit: string): string {
  const shown = displayUnits.of(unit);
  return `${formatNumber(displayUnits.toDisplay(si, unit), { digits: 4 })} ${shown.text}`;
}

customElements.define('flexrf-surroundings', SurroundingsList);
