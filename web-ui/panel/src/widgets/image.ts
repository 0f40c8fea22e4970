// A slot of an image type, as JPEGs no wider than they are shown. What its row draws over it is in overlays/.
import { css, html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { Overlay, Reading } from '../contract';
import { listen } from '../core/listen';
import { loadPart } from '../core/parts';
import { textOfError } from '../core/reasons';
import type { Overlays, Picture } from './overlays/overlays';
import { widgetStyles } from './styles';
import { WidgetBase } from './widget_base';

/** A JPEG that is shown or will be, of which picture of the slot. */
interface Shown {
  readonly image: Blob;
  readonly time: number;
  readonly scaledBy: number;
}

/** Widths are asked for in these steps, so that a resize does not ask at each pixel. */
const width_step = 64;

export class ImageView extends WidgetBase {
  static override styles = [
    widgetStyles,
    css`
      .picture {
        position: relative;
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
      img[hidden] {
        display: none;
      }
      svg {
        position: absolute;
        inset: 0;
        width: 100%;
        height: 100%;
        pointer-events: none;
      }
      :host([stale]) :is(img, svg),
      .absent :is(img, svg) {
        filter: grayscale(1) opacity(0.5);
      }
      /* A wide table scrolls within it. */
      .below {
        flex: 1 1 100%;
        contain: inline-size;
      }
    `,
  ];
  private width = 0;
  private endWatch: (() => void) | undefined;
  private address = '';
  /** While the browser decodes one the newest waits. */
  private decodes: Shown | undefined;
  private waiting: Shown | undefined;
  private layer: Overlays | undefined;
  /** What is seen now. */
  private picture: Picture | undefined;

  protected override render(): TemplateResult {
    const hasOverlays = this.overlays.length > 0;
    return this.frame(html`<div class="picture">
        ${this.image(false)}
        ${hasOverlays ? html`${this.image(true)}<svg aria-hidden="true" preserveAspectRatio="none"></svg>` : nothing}
      </div>
      ${hasOverlays ? html`<div class="below"></div>` : nothing}`);
  }

  private image(hidden: boolean): TemplateResult {
    return html`<img
      ?hidden=${hidden}
      decoding="sync"
      alt=${`${this.label}. ${this.item?.summary ?? ''}`}
      @load=${(event: Event) => this.present(event.target as HTMLImageElement, this.decodes)}
      @error=${(event: Event) => this.present(event.target as HTMLImageElement, undefined)}
    />`;
  }

  /** Where the next picture is decoded. With overlays that is out of sight: it and what lies over it come into sight together. */
  private get next(): HTMLImageElement {
    return this.renderRoot.querySelector<HTMLImageElement>('img[hidden]') ?? this.find<HTMLImageElement>('img');
  }

  private get overlays(): readonly Overlay[] {
    return this.placement?.overlays ?? [];
  }

  protected override begin(): void {
    if (this.hasUpdated) this.measure();
  }

  protected override firstUpdated(): void {
    super.firstUpdated();
    this.measure();
    if (this.overlays.length > 0) void this.addOverlays();
  }

  private async addOverlays(): Promise<void> {
    try {
      const { Overlays } = await loadPart(() => import('./overlays/overlays'));
      const { host, overlays, label } = this;
      this.layer = Object.assign(new Overlays(), { host, overlays, label, svg: this.find<SVGElement>('.picture svg') });
      this.find('.below').append(this.layer);
      Object.assign(this.layer, { active: this.width > 0, width: this.find('.picture').clientWidth });
      this.layer.present(this.picture);
    } catch (error) {
      this.note = `Nothing is drawn over the picture: ${textOfError(error)}`;
      this.requestUpdate();
    }
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
    if (this.layer) Object.assign(this.layer, { active: true, width: shown });
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
    this.decodes = undefined;
    this.waiting = undefined;
    this.picture = undefined;
    if (this.layer) this.layer.active = false;
    this.revoke();
    this.renderRoot.querySelectorAll('img').forEach((image) => image.removeAttribute('src'));
  }

  protected override take(reading: Reading): void {
    super.take(reading);
    if (!this.hasUpdated) return;
    this.find('.picture').classList.toggle('absent', !reading.image);
    if (!reading.image) return;
    this.waiting = { image: reading.image, time: reading.sampledAt, scaledBy: reading.scaledBy || 1 };
    if (!this.decodes) this.presentNext();
  }

  /** The picture is its own value. */
  protected override show(): void {}

  /** The browser has decoded it, or could not: undefined. */
  private present(image: HTMLImageElement, shown: Shown | undefined): void {
    if (image.hidden) {
      this.renderRoot.querySelectorAll('img').forEach((one) => (one.hidden = one !== image));
    }
    const { naturalWidth, naturalHeight } = image;
    this.picture = shown && { time: shown.time, width: naturalWidth * shown.scaledBy, height: naturalHeight * shown.scaledBy };
    this.layer?.present(this.picture);
    this.presentNext();
  }

  private presentNext(): void {
    const { address: old, waiting } = this;
    this.decodes = waiting;
    this.waiting = undefined;
    if (waiting === undefined) return;
    this.address = URL.createObjectURL(waiting.image);
    this.next.src = this.address;
    if (old !== '') URL.revokeObjectURL(old);
  }

  private revoke(): void {
    if (this.address !== '') URL.revokeObjectURL(this.address);
    this.address = '';
  }
}
