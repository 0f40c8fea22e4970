// A text, the name of an enumeration's value, or whatever else no other widget takes apart.
import { html } from 'lit';
import type { TemplateResult } from 'lit';
import type { Value } from '../contract';
import { LiveText, setAttribute } from './live_text';
import { scalarText } from './value_text';
import { WidgetBase, dash } from './widget_base';

export class TextReadout extends WidgetBase {
  private text: LiveText | undefined;

  protected override render(): TemplateResult {
    return this.frame(html`<span class="value wide"></span>${this.unitMark()}`);
  }

  protected override firstUpdated(): void {
    this.text = new LiveText(this.find('.value'));
    super.firstUpdated();
  }

  protected override show(value: Value | null): void {
    if (!this.text) return;
    this.text.text = value === null ? dash : this.textOf(value);
  }

  protected textOf(value: Value): string {
    return this.item ? scalarText(this.item, this.quantity, value) : '';
  }
}

/** The value's name; with the option `abnormal = "fault, blocked"` those stand out, by a sign and a colour. */
export class EnumerationReadout extends TextReadout {
  protected override show(value: Value | null): void {
    const element = this.renderRoot.querySelector('.value');
    if (element) setAttribute(element, 'class', this.stands(value) ? 'value wide abnormal' : 'value wide');
    super.show(value);
  }

  protected override textOf(value: Value): string {
    return this.stands(value) ? `⚠ ${super.textOf(value)}` : super.textOf(value);
  }

  private stands(value: Value | null): boolean {
    const { abnormal } = this.options;
    return typeof value === 'string' && typeof abnormal === 'string' && abnormal.split(/[ ,]+/).includes(value);
  }
}
