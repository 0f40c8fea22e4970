// A vector of numbers as columns: the elements are the bins.
import { css, html } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { LiveText } from './live_text';
import { widgetStyles } from './styles';
import { WidgetBase, dash } from './widget_base';

/** Columns of a box 100 high and as many units wide as there are bins, down from `zero`; what is no number is left out. */
export function columnsPath(bins: readonly number[], low: number, high: number): string {
  const span = high > low ? high - low : 1;
  const y = (value: number): number => (100 * (high - value)) / span;
  const zero = y(0).toFixed(1);
  let path = '';
  bins.forEach((value, i) => {
    if (Number.isFinite(value)) path += `M${(i + 0.05).toFixed(2)} ${zero}V${y(value).toFixed(1)}h0.9V${zero}z`;
  });
  return path;
}

export class Histogram extends WidgetBase {
  static override styles = [
    widgetStyles,
    css`
      svg {
        flex: 1 1 100%;
        height: 6rem;
        background: var(--field);
        border-bottom: 1px solid var(--border);
      }
      path {
        fill: var(--fill);
      }
    `,
  ];
  private text: LiveText | undefined;
  private path: SVGPathElement | undefined;
  private largest = 0;
  private smallest = 0;

  protected override render(): TemplateResult {
    const bins = this.item?.shape[0] ?? 1;
    return this.frame(html`<svg viewBox="0 0 ${bins} 100" preserveAspectRatio="none" aria-hidden="true"><path d="" /></svg>
      <span class="value wide"></span>${this.unitMark()}`);
  }

  protected override watchOptions(): { rate: number } {
    return { rate: 10 };
  }

  protected override firstUpdated(): void {
    this.text = new LiveText(this.find('.value'));
    this.path = this.find<SVGPathElement>('path');
    super.firstUpdated();
  }

  protected override show(value: Value | null): void {
    if (!this.text || !this.path) return;
    const bins = Array.isArray(value) ? value.map((one) => (typeof one === 'number' ? one : Number.NaN)) : [];
    let peak = -1;
    bins.forEach((bin, i) => {
      if (Number.isFinite(bin) && (peak < 0 || bin > bins[peak]!)) peak = i;
    });
    if (peak < 0) {
      this.path.setAttribute('d', '');
      this.text.text = dash;
      return;
    }
    const [low, high] = this.item?.range ?? [Number.NaN, Number.NaN];
    const finite = bins.filter(Number.isFinite);
    // The scale follows the values, but does not jump with each: it halves only when they are that small.
    const most = Math.max(0, ...finite);
    const least = Math.min(0, ...finite);
    if (most > this.largest || most < this.largest / 2) this.largest = most;
    if (least < this.smallest || least > this.smallest / 2) this.smallest = least;
    const fixed = Number.isFinite(low) && Number.isFinite(high);
    this.path.setAttribute('d', columnsPath(bins, fixed ? Math.min(0, low) : this.smallest, fixed ? Math.max(0, high) : this.largest));
    this.text.text = `largest ${this.quantity.text(bins[peak]!)} at ${peak}`;
  }
}
