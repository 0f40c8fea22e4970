// A number: text of fixed width, and a bar against its range.
import { html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { BoxedText, LiveText } from './live_text';
import { abnormality } from './value_text';
import { barStyles, widgetStyles } from './styles';
import { WidgetBase, dash } from './widget_base';

export class NumberReadout extends WidgetBase {
  static override styles = [
    widgetStyles,
    barStyles,
  ];
  private text: BoxedText | undefined;
  private abnormal: LiveText | undefined;
  private bar: HTMLElement | null = null;

  protected override render(): TemplateResult {
    const range = this.quantity.range;
    const zero = range && range[0] < 0 && range[1] > 0 ? -range[0] / (range[1] - range[0]) : undefined;
    return this.frame(html`
      ${range
        ? html`<span class="bar" aria-hidden="true" title=${this.quantity.rangeText()}
            ><i></i>${zero === undefined ? nothing : html`<b></b>`}</span
          >`
        : nothing}
      <span class="abnormal"></span><span class="value boxed"></span>${this.unitMark()}
    `);
  }

  protected override firstUpdated(): void {
    this.text = new BoxedText(this.find('.value'));
    this.abnormal = new LiveText(this.find('.abnormal'));
    this.bar = this.renderRoot.querySelector('.bar > i');
    super.firstUpdated();
  }

  protected override updated(): void {
    const zero = this.renderRoot.querySelector<HTMLElement>('.bar > b');
    if (zero) zero.style.left = `${100 * this.zero()}%`;
  }

  /** Where the bar grows from: zero, or the end of the range that is nearer to it. */
  private zero(): number {
    return this.quantity.fraction(0) ?? 0;
  }

  protected override show(value: Value | null): void {
    const number = typeof value === 'number' ? value : undefined;
    if (this.text) this.text.text = number === undefined ? dash : this.quantity.text(number);
    if (this.abnormal) this.abnormal.text = number === undefined ? '' : abnormality(number, this.options);
    if (this.bar) {
      const from = this.zero();
      const to = number === undefined ? from : (this.quantity.fraction(number) ?? from);
      this.bar.style.transform = `translateX(${(100 * Math.min(from, to)).toFixed(1)}%) scaleX(${Math.abs(to - from).toFixed(3)})`;
    }
  }
}
