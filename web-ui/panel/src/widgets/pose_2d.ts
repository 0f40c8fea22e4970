// A pose from above: x to the right, y up, and an arrow along the frame's x axis; the numbers beside it.
import { css, html } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { displayUnits } from '../core/units';
import { LiveText } from './live_text';
import { Quantity } from './quantity';
import { widgetStyles } from './styles';
import { WidgetBase, dash } from './widget_base';

/** SI: m and rad. */
export interface FlatPose {
  readonly x: number;
  readonly y: number;
  readonly heading: number;
}

function numbers(value: Value | undefined, count: number): number[] | undefined {
  return Array.isArray(value) && value.length >= count && value.every((one) => typeof one === 'number')
    ? (value as number[])
    : undefined;
}

/** Of a Pose (position, orientation as quaternion x, y, z, w), or of a list x, y, heading. */
export function flatPose(value: Value | null): FlatPose | undefined {
  if (value === null || typeof value !== 'object') return undefined;
  if (Array.isArray(value)) {
    const [x = 0, y = 0, heading = 0] = numbers(value, 3) ?? [Number.NaN];
    return Number.isNaN(x) ? undefined : { x, y, heading };
  }
  const position = numbers(value['position'], 2);
  if (!position) return undefined;
  const [qx = 0, qy = 0, qz = 0, qw = 0] = numbers(value['orientation'], 4) ?? [];
  const heading = Math.atan2(2 * (qw * qz + qx * qy), 1 - 2 * (qy * qy + qz * qz));
  return { x: position[0]!, y: position[1]!, heading };
}

/** The next of 1, 2, 5, 10, ... at or above: the half width of the map. */
export function mapExtent(most: number): number {
  const decade = 10 ** Math.floor(Math.log10(Math.max(most, 1e-6)));
  const digit = most / decade;
  return (digit <= 1 ? 1 : digit <= 2 ? 2 : digit <= 5 ? 5 : 10) * decade;
}

export class Pose2d extends WidgetBase {
  static override styles = [
    widgetStyles,
    css`
      svg {
        width: 12rem;
        max-width: 100%;
        aspect-ratio: 1;
        background: var(--field);
        border: 1px solid var(--track);
      }
      .grid {
        stroke: var(--track);
        stroke-width: 0.5;
      }
      .axis {
        stroke: var(--fill);
        stroke-width: 0.7;
      }
      .arrow {
        fill: var(--text);
      }
      .extent {
        fill: var(--muted);
        font-size: 6px;
      }
      .numbers {
        display: grid;
        grid-template-columns: auto 1fr auto;
        gap: 0 0.5em;
      }
      .value {
        min-width: 7ch;
      }
    `,
  ];
  private texts: LiveText[] = [];
  private scale: LiveText | undefined;
  private arrow: SVGElement | undefined;
  private extent = 0;
  private length = new Quantity({ scalar: 'f64', unit: 'm' });
  private angle = new Quantity({ scalar: 'f64', unit: 'rad' }, { decimals: 1 });

  protected override prepare(): void {
    super.prepare();
    const unit = this.item?.members?.find((member) => member.label.toLowerCase() === 'position')?.unit ?? 'm';
    this.length = new Quantity({ scalar: 'f64', unit }, { decimals: displayUnits.of(unit).factor === 1000 ? 1 : 4 });
    this.angle = new Quantity({ scalar: 'f64', unit: 'rad' }, { decimals: displayUnits.si ? 4 : 1 });
    const given = this.options['extent'];
    if (this.extent === 0 && typeof given === 'number' && given > 0) this.extent = given;
  }

  protected override render(): TemplateResult {
    const line = (name: string, unit: string): TemplateResult =>
      html`<span>${name}</span><span class="value"></span><span class="unit">${unit}</span>`;
    return this.frame(html`<svg viewBox="-50 -50 100 100" aria-hidden="true">
        <path class="grid" d="M-50-25H50M-50 25H50M-25-50V50M25-50V50" />
        <path class="axis" d="M-50 0H50M0-50V50" />
        <path class="arrow" d="M7 0L-4 4L-2 0L-4-4Z" />
        <text class="extent" x="-48" y="48"></text>
      </svg>
      <span class="numbers">
        ${line('x', this.length.unit)} ${line('y', this.length.unit)} ${line('heading', this.angle.unit)}
      </span>`);
  }

  protected override firstUpdated(): void {
    this.texts = [...this.renderRoot.querySelectorAll('.value')].map((element) => new LiveText(element));
    this.scale = new LiveText(this.find('.extent'));
    this.arrow = this.find<SVGElement>('.arrow');
    super.firstUpdated();
  }

  protected override show(value: Value | null): void {
    if (!this.arrow || !this.scale) return;
    const pose = flatPose(value);
    const [x, y, heading] = this.texts;
    if (x) x.text = pose ? this.length.text(pose.x) : dash;
    if (y) y.text = pose ? this.length.text(pose.y) : dash;
    if (heading) heading.text = pose ? this.angle.text(pose.heading) : dash;
    const drawn = pose !== undefined && Number.isFinite(pose.x) && Number.isFinite(pose.y);
    this.arrow.style.visibility = drawn ? 'visible' : 'hidden';
    if (!drawn) return;
    this.extent = Math.max(this.extent, mapExtent(Math.max(Math.abs(pose.x), Math.abs(pose.y))));
    const scale = 50 / this.extent;
    const degrees = Number.isFinite(pose.heading) ? (-pose.heading * 180) / Math.PI : 0;
    this.arrow.setAttribute(
      'transform',
      `translate(${(pose.x * scale).toFixed(2)} ${(-pose.y * scale).toFixed(2)}) rotate(${degrees.toFixed(1)})`,
    );
    this.scale.text = `± ${Number(this.length.toShown(this.extent).toPrecision(3))} ${this.length.unit}`;
  }
}
