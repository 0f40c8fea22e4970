// Jogging: hold buttons laid out as the directions they move in. Placed by the table; each of its `parameters` that is
// a hold becomes a button, at the place that its role names.
import { css, html, nothing } from 'lit';
import type { TemplateResult } from 'lit';
import type { ItemInfo } from '../contract';
import { ControlBase } from './control_base';
import { HoldDriver, showPhase } from './hold_driver';
import { holdStyles } from './control_styles';
import { widgetStyles } from './styles';

/** Sign, row and column of the roles that are directions. */
const directions: { readonly [role: string]: readonly [sign: string, row: number, column: number] } = {
  turn_left: ['⟲', 1, 1],
  forward: ['▲', 1, 2],
  y_plus: ['▲', 1, 2],
  plus_y: ['▲', 1, 2],
  turn_right: ['⟳', 1, 3],
  left: ['◀', 2, 1],
  x_minus: ['◀', 2, 1],
  minus_x: ['◀', 2, 1],
  right: ['▶', 2, 3],
  x_plus: ['▶', 2, 3],
  plus_x: ['▶', 2, 3],
  back: ['▼', 3, 2],
  y_minus: ['▼', 3, 2],
  minus_y: ['▼', 3, 2],
  up: ['⤒', 1, 4],
  z_plus: ['⤒', 1, 4],
  plus_z: ['⤒', 1, 4],
  down: ['⤓', 3, 4],
  z_minus: ['⤓', 3, 4],
  minus_z: ['⤓', 3, 4],
};

interface JogButton {
  readonly item: ItemInfo;
  readonly sign: string;
  readonly cell: readonly [row: number, column: number] | undefined;
  readonly driver: HoldDriver;
}

export class JogPad extends ControlBase {
  static override styles = [
    widgetStyles,
    holdStyles,
    css`
      .pad {
        display: inline-grid;
        grid-template-columns: repeat(4, auto);
        gap: max(12px, var(--gap));
        padding: var(--gap) 0;
      }
      .hold {
        display: flex;
        flex-direction: column;
        align-items: center;
        justify-content: center;
        font-size: 0.85em;
      }
      .sign {
        font-size: 1.6rem;
        line-height: 1;
      }
    `,
  ];
  private buttons: JogButton[] = [];
  private detach: (() => void)[] = [];

  protected override prepare(): void {
    super.prepare();
    if (this.buttons.length > 0) return;
    this.buttons = Object.entries(this.placement?.parameters ?? {}).flatMap(([role, key]) => {
      const item = this.host.item(key);
      if (item?.scalar !== 'hold') return [];
      const [sign = '', row = 0, column = 0] = directions[role] ?? [];
      return [{
        item,
        sign,
        cell: sign === '' ? undefined : ([row, column] as const),
        driver: new HoldDriver(
          () => this.host.hold(item.key),
          (_phase, reason) => {
            if (reason !== '') this.say(`${item.label}: ${reason}`);
            else if (this.held() !== undefined) this.say('');
            this.present();
          },
        ),
      }];
    });
  }

  private held(): JogButton | undefined {
    return this.buttons.find((button) => button.driver.phase !== 'idle');
  }

  protected override lockReason(): string {
    if (this.host.stale) return super.lockReason();
    if (this.buttons.length === 0) return 'none of its parameters is a hold';
    // Buttons differ only where their roles do; the pad's reason is the first's.
    return this.lockOf(this.buttons[0]!.item);
  }

  protected override commands(): readonly ItemInfo[] {
    return this.buttons.map((button) => button.item);
  }

  protected override onLocked(): void {
    this.buttons.forEach((button) => button.driver.release());
  }

  protected override begin(): void {
    if (this.hasUpdated) this.listen();
  }
  protected override show(): void {}

  protected override firstUpdated(): void {
    super.firstUpdated();
    this.listen();
    this.present();
  }

  /** Unit and range of the first of its parameters say nothing of the pad. */
  protected override description(): string {
    return 'Each button acts while it is held.';
  }

  protected override render(): TemplateResult {
    const line = this.locked === '' ? 'Acts while held.' : `Dead: ${this.locked}`;
    return this.controlFrame(html`<div class="pad">
      ${this.buttons.map(
        (button, i) => html`<button
          class="hold"
          type="button"
          data-index=${i}
          title=${button.item.summary}
          aria-describedby="summary refusal lock"
          ?disabled=${this.locked !== ''}
        >
          ${button.sign === '' ? nothing : html`<span class="sign" aria-hidden="true">${button.sign}</span>`}
          <span>${button.item.label}</span>
        </button>`,
      )}
    </div>`, '', html`<span class="line" aria-hidden="true">${line}</span>`);
  }

  private element(i: number): HTMLElement {
    return this.find<HTMLElement>(`[data-index="${i}"]`);
  }

  private listen(): void {
    this.detach.splice(0).forEach((end) => end());
    this.buttons.forEach((button, i) => {
      const element = this.element(i);
      if (button.cell) [element.style.gridRow, element.style.gridColumn] = [String(button.cell[0]), String(button.cell[1])];
      // One direction at a time: a second finger begins nothing.
      const mayBegin = (): boolean =>
        this.locked === '' && this.held() === undefined && this.lockOf(button.item) === '';
      this.detach.push(button.driver.attach(element, mayBegin));
    });
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.detach.splice(0).forEach((end) => end());
  }

  private present(): void {
    if (!this.hasUpdated) return;
    this.buttons.forEach((button, i) => showPhase(this.element(i), button.driver.phase));
  }
}
