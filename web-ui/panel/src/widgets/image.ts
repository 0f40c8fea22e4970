// A slot of an image type, as JPEGs no wider than they are shown.
import { css, html } from 'lit';
import type { TemplateResult } from 'lit';
import type { Reading } from '../contract';
import { listen } from '../core/listen';
import { widgetStyles } from './styles';
import { WidgetBase } from './widget_base';

/** Widths are asked for in these steps, so that a resize does not ask at each pixel. */
const width_step = 64;

export class ImageView extends WidgetBase {
  static override styles = [
    widgetStyles,
    css`
      .picture {
        flex: 1 1 100%;
        min-height: 4rem;
        background: var(--track);
      }
      img {
        display: block;
        width: 100%;
        height: auto;
      }
      img:not([src]) {
        visibility: hidden;
      }
      :host([stale]) img,
      .absent img {
        filter: grayscale(1) opacity(0.5);
      }
    `,
  ];
  private width = 0;
  private endWatch: (() => void) | undefined;
  private address = '';
  /** While the browser decodes one the newest waits. */
  private decodes = false;
  private waiting: Blob | undefined;

  protected override render(): TemplateResult {
    return this.frame(html`<div class="picture">
      <img alt=${`${this.label}. ${this.item?.summary ?? ''}`} @load=${() => this.presentNext()} @error=${() => this.presentNext()} />
    </div>`);
  }

  protected override begin(): void {
    if (this.hasUpdated) this.measure();
  }

  protected override firstUpdated(): void {
    super.firstUpdated();
    this.measure();
  }

  /** Asks for the width that is shown, and again when that changes. */
  private measure(): void {
    const picture = this.find<HTMLElement>('.picture');
    const observer = new ResizeObserver(() => this.ask(picture.clientWidth));
    observer.observe(picture);
    this.until(() => observer.disconnect());
    this.ask(picture.clientWidth);
    this.until(() => this.stop());
    // Scrolled away, it costs the server nothing.
    this.until(listen(this, 'contentvisibilityautostatechange', (event: Event & { skipped?: boolean }) => {
      if (event.skipped) this.stop();
      else this.ask(picture.clientWidth);
    }));
  }

  private ask(shown: number): void {
    if (!this.item || shown === 0) return;
    const most = typeof this.options['width'] === 'number' ? this.options['width'] : Number.POSITIVE_INFINITY;
    const width = Math.min(most, Math.ceil((shown * window.devicePixelRatio) / width_step) * width_step);
    if (width === this.width) return;
    this.width = width;
    this.endWatch?.();
    const rate = this.options['rate'];
    this.endWatch = this.host.watch(this.item.key, (reading) => this.take(reading), {
      width,
      rate: typeof rate === 'number' ? rate : 15,
    });
  }

  private stop(): void {
    this.endWatch?.();
    this.endWatch = undefined;
    this.width = 0;
    this.decodes = false;
    this.waiting = undefined;
    this.revoke();
    this.renderRoot.querySelector('img')?.removeAttribute('src');
  }

  protected override take(reading: Reading): void {
    super.take(reading);
    if (!this.hasUpdated) return;
    this.find('.picture').classList.toggle('absent', !reading.image);
    if (!reading.image) return;
    this.waiting = reading.image;
    if (!this.decodes) this.presentNext();
  }

  /** The picture is its own value. */
  protected override show(): void {}

  private presentNext(): void {
    const { address: old, waiting } = this;
    this.decodes = waiting !== undefined;
    this.waiting = undefined;
    if (waiting === undefined) return;
    this.address = URL.createObjectURL(waiting);
    this.find<HTMLImageElement>('img').src = this.address;
    if (old !== '') URL.revokeObjectURL(old);
  }

  private revoke(): void {
    if (this.address !== '') URL.revokeObjectURL(this.address);
    this.address = '';
  }
}
