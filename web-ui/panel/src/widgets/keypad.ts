// Digits on the page, for fingers: a panel PC beside a machine has no keyboard on its screen. Shown below a field that has
// the focus; what is pressed happens to the field as if it were typed.
import { css, html, nothing } from 'lit';
import type { TemplateResult } from 'lit';

const keys: readonly (readonly [sign: string, name: string])[] = [
  ['7', ''], ['8', ''], ['9', ''], ['⌫', 'Delete'],
  ['4', ''], ['5', ''], ['6', ''], ['±', 'Sign'],
  ['1', ''], ['2', ''], ['3', ''], ['✕', 'Give up'],
  ['0', ''], ['.', 'Point'], ['✓', 'Enter'],
];

export const keypadStyles = css`
  .keypad {
    flex: 1 0 100%;
    display: grid;
    grid-template-columns: repeat(4, minmax(var(--target), auto));
    justify-content: end;
    gap: var(--gap);
  }
  .keypad > [data-key='0'] {
    grid-column: span 2;
  }
`;

export class Keypad {
  private field: HTMLInputElement | undefined;
  private opened = false;

  constructor(private readonly changed: () => void) {}

  /** Fingers are the main pointer, or the person chose large controls. */
  get wanted(): boolean {
    return document.documentElement.dataset['touch'] === 'large' || (window.matchMedia?.('(pointer: coarse)').matches ?? false);
  }

  /** The screen's own keyboard stays away where this one comes. */
  inputMode(otherwise: string): string {
    return this.wanted ? 'none' : otherwise;
  }

  focus(field: HTMLInputElement): void {
    if (!this.wanted || field === this.field) return;
    this.field = field;
    this.opened = true;
    field.select(); // the first digit replaces what is there
    this.changed();
  }

  blur(): void {
    if (!this.field) return;
    this.field = undefined;
    this.changed();
  }

  /** After drawing: what opened below what is seen of the page comes into sight. */
  reveal(root: ParentNode): void {
    if (!this.opened) return;
    this.opened = false;
    root.querySelector('.keypad')?.scrollIntoView?.({ block: 'nearest' });
  }

  render(): TemplateResult | typeof nothing {
    if (!this.field) return nothing;
    // The focus stays in the field: to leave it would send what is typed so far.
    return html`<span class="keypad" role="group" aria-label="Keypad" @mousedown=${(event: Event) => event.preventDefault()}>
      ${keys.map(
        ([sign, name]) =>
          html`<button type="button" tabindex="-1" data-key=${sign} aria-label=${name || nothing} @click=${() => this.press(sign)}>${sign}</button>`,
      )}
    </span>`;
  }

  private press(sign: string): void {
    const field = this.field;
    if (!field || field.disabled) return;
    if (sign === '✓' || sign === '✕') {
      field.dispatchEvent(new KeyboardEvent('keydown', { key: sign === '✓' ? 'Enter' : 'Escape', cancelable: true }));
      field.select();
      return;
    }
    const start = field.selectionStart ?? field.value.length;
    const end = field.selectionEnd ?? start;
    if (sign === '±') field.value = field.value.startsWith('-') ? field.value.slice(1) : `-${field.value}`;
    else if (sign !== '⌫') field.setRangeText(sign, start, end, 'end');
    else field.setRangeText('', start === end ? Math.max(0, start - 1) : start, end, 'end');
    field.dispatchEvent(new Event('input'));
  }
}
