// A dial: a needle over the range, with the limits of the options `low` and `high` marked.
import { css, html, nothing, svg } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { significantText } from '../core/units';
import { LiveText } from './live_text';
import { abnormality } from './value_text';
import { widgetStyles } from './styles';
import { WidgetBase, dash } from './widget_base';

const sweep = 240;

/** Point on the dial at a share of the range. */
function point(share: number, radius: number): string {
  const angle = ((share * sweep - sweep / 2 - 90) * Math.PI) / 180;
  return `${(60 + radius * Math.cos(angle)).toFixed(2)} ${(60 + radius * Math.sin(angle)).toFixed(2)}`;
}

function arc(from: number, to: number, radius: number): string {
  const large = (to - from) * sweep > 180 ? 1 : 0;
  return `M${point(from, radius)}A${radius} ${radius} 0 ${large} 1 ${point(to, radius)}`;
}

export class Gauge extends WidgetBase {
  static override styles = [
    widgetStyles,
    css`
      svg {
        width: 10rem;
        max-width: 100%;
      }
      .scale,
      .limit {
        fill: none;
        stroke: var(--track);
        stroke-width: 8;
      }
      .limit {
        stroke: var(--fill);
      }
      .needle {
        stroke: var(--text);
        stroke-width: 3;
        stroke-linecap: round;
      }
      .end {
        fill: var(--muted);
        font-size: 9px;
        text-anchor: middle;
      }
      .reading {
        display: flex;
        justify-content: center;
        gap: 0.4em;
        min-width: 100%;
      }
      .dial {
        display: inline-flex;
        flex-direction: column;
        align-items: center;
      }
    `,
  ];
  private text: LiveText | undefined;
  private abnormal: LiveText | undefined;
  private needle: SVGElement | undefined;

  protected override render(): TemplateResult {
    const { low, high } = this.options;
    const at = (limit: Value | undefined): number | undefined =>
      typeof limit === 'number' ? this.quantity.fraction(limit) : undefined;
    const [below, above] = [at(low), at(high)];
    const ends = this.quantity.range ?? [0, 1];
    return this.frame(html`<span class="dial">
      <svg viewBox="0 0 120 104" aria-hidden="true">
        <path class="scale" d=${arc(0, 1, 48)} />
        ${below === undefined ? nothing : svg`<path class="limit" d=${arc(0, below, 48)} />`}
        ${above === undefined ? nothing : svg`<path class="limit" d=${arc(above, 1, 48)} />`}
        <line class="needle" x1="60" y1="60" x2="60" y2="18" />
        <text class="end" x="20" y="100">${significantText(ends[0], 4)}</text>
        <text class="end" x="100" y="100">${significantText(ends[1], 4)}</text>
      </svg>
      <span class="reading"><span class="abnormal"></span><span class="value"></span>${this.unitMark()}</span>
    </span>`);
  }

  protected override firstUpdated(): void {
    this.text = new LiveText(this.find('.value'));
    this.abnormal = new LiveText(this.find('.abnormal'));
    this.needle = this.find<SVGElement>('.needle');
    super.firstUpdated();
  }

  protected override show(value: Value | null): void {
    if (!this.text || !this.abnormal || !this.needle) return;
    const share = typeof value === 'number' ? this.quantity.fraction(value) : undefined;
    this.text.text = typeof value === 'number' ? this.quantity.text(value) : dash;
    this.abnormal.text = typeof value === 'number' ? abnormality(value, this.options) : '';
    this.needle.style.visibility = share === undefined ? 'hidden' : 'visible';
    if (share !== undefined) this.needle.setAttribute('transform', `rotate(${(share * sweep - sweep / 2).toFixed(1)} 60 60)`);
  }
}
