// What every widget shares: its item, its place on the page, its label and unit, NULL, and old values.
import { html, nothing } from 'lit';
import type { CSSResultGroup, TemplateResult } from 'lit';
import type { ItemInfo, Placement, Reading, Value, WidgetElement, WidgetHost } from '../contract';
import { displayUnits } from '../core/units';
import { misfit, placedItem, placedKind } from './choose';
import { EndingElement } from './ending_element';
import { LiveText } from './live_text';
import { Quantity } from './quantity';
import { widgetStyles } from './styles';
import { absence } from './value_text';

/** What is shown in place of a value that is not there. */
export const dash = '—';

export abstract class WidgetBase extends EndingElement implements WidgetElement {
  static override styles: CSSResultGroup = widgetStyles;

  host!: WidgetHost;
  item?: ItemInfo;
  placement?: Placement;
  /** Why this is not the widget that was asked for; empty when it is. */
  note = '';

  /** Newest reading; undefined before the first. */
  protected reading: Reading | undefined;
  protected quantity = new Quantity({ scalar: 'f64', unit: '' });
  private watching = false;
  private absence: LiveText | undefined;
  private absentIn: Element | null = null;

  override connectedCallback(): void {
    super.connectedCallback();
    const placed = this.item ?? (this.placement && placedItem(this.host, this.placement));
    if (placed) {
      this.item = placed;
      if (!this.placement) this.note ||= misfit(placed);
      else if (placedKind(this.host, this.placement) !== this.placement.kind) this.note ||= misfit({ ...placed, widget: this.placement.kind });
    }
    this.prepare();
    this.takeAccess();
    this.until(this.host.watchAccess(() => this.takeAccess()));
    this.until(
      displayUnits.watch(() => {
        this.prepare();
        this.requestUpdate();
        if (this.hasUpdated) this.redraw();
      }),
    );
    this.begin();
  }

  /** Where values come from; widgets of several items begin others. */
  protected begin(): void {
    this.watching = this.item !== undefined;
    if (this.item) this.until(this.host.watch(this.item.key, (reading) => this.take(reading), this.watchOptions()));
  }

  protected watchOptions(): { rate?: number; width?: number } {
    return { rate: 60 };
  }

  protected take(reading: Reading): void {
    this.reading = reading;
    if (this.hasUpdated) this.presentReading(reading);
  }

  protected override firstUpdated(): void {
    const absence = this.renderRoot.querySelector('#absence');
    if (absence) this.absence = new LiveText(absence);
    this.absentIn = absence;
    if (this.reading) this.presentReading(this.reading);
    else this.show(null);
    if (!this.reading && this.watching) this.sayAbsent('no value yet');
  }

  private presentReading(reading: Reading): void {
    this.sayAbsent(absence(reading));
    this.show(reading.value);
  }

  /** In full where there is room beside what stands for the value, else by the pointer: it moves nothing. */
  private sayAbsent(why: string): void {
    if (!this.absence || this.absence.text === why) return;
    this.absence.text = why;
    this.absentIn?.setAttribute('title', why);
  }

  /** Writes a value into what is rendered, with as little as possible; null: there is none. */
  protected abstract show(value: Value | null): void;

  /** The same value once more: units are others. */
  protected redraw(): void {
    this.show(this.reading?.value ?? null);
  }

  /** Access, or the freshness of values, may have changed. */
  protected takeAccess(): void {
    this.toggleAttribute('stale', this.host.stale);
  }

  /** Item or units are new. */
  protected prepare(): void {
    if (this.item) this.quantity = new Quantity(this.item, this.options);
  }

  protected get options(): Placement['options'] {
    return this.placement?.options ?? (this.item?.confirm ? { confirm: this.item.confirm } : {});
  }
  protected get label(): string {
    return this.placement?.label || this.item?.label || this.placement?.name || '';
  }

  /** Label, content, and what is to be said about it. With `control`, the label is that of the element of this id. */
  protected frame(content: TemplateResult, control = '', notes: TemplateResult | typeof nothing = nothing): TemplateResult {
    const label = html`${this.label}${this.extraLabel()}`;
    const controls = this.headControls();
    // A placed readout stands below a heading of its name.
    const named = this.placement !== undefined && control === '' && controls === nothing;
    return html`
      <div
        class="row"
        role=${control === '' ? 'group' : nothing}
        aria-labelledby=${control === '' ? 'label' : nothing}
        aria-describedby=${control === '' ? 'summary' : nothing}
      >
        <div class="head ${named ? 'hidden' : ''}" title=${this.item?.summary ?? ''}>
          ${control === ''
            ? html`<span id="label">${label}</span>`
            : html`<label id="label" for=${control}>${label}</label>`}${controls}
        </div>
        <div class="content"><span id="absence"></span>${content}</div>
        <div class="notes">
          ${this.note === '' ? nothing : html`<span class="note">${this.note}</span>`} ${notes}
        </div>
        <span id="summary" class="hidden">${this.description()}</span>
        ${this.over()}
      </div>
    `;
  }

  /** What lies over the page while there is need of it. */
  protected over(): TemplateResult | typeof nothing {
    return nothing;
  }

  protected extraLabel(): TemplateResult | typeof nothing {
    return nothing;
  }

  protected headControls(): TemplateResult | typeof nothing {
    return nothing;
  }

  /** For screen readers: summary, unit and range. */
  protected description(): string {
    const unit = this.quantity.unit === '' ? '' : `In ${this.quantity.unit}.`;
    const range = this.quantity.rangeText();
    return [this.item?.summary ?? '', unit, range === '' ? '' : `From ${range}.`].filter((part) => part !== '').join(' ');
  }

  protected unitMark(): TemplateResult {
    return html`<span class="unit" aria-hidden="true">${this.quantity.unit}</span>`;
  }

  protected find<E extends Element>(selector: string): E {
    return this.renderRoot.querySelector<E>(selector)!;
  }
}
