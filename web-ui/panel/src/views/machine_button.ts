// A button of the view of the PC, with the reason below it why it is dead.
import { css, html, nothing, type TemplateResult } from 'lit';

export const machineButtonStyles = css`
  .buttons {
    margin-block: 0.8em;
  }
`;

/** The id of what says why it is dead. */
export function reasonOf(label: string): string {
  return `why-${label.replaceAll(' ', '-')}`;
}

/** `dead`: why it does nothing now; empty: it acts. */
export function machineButton(label: string, dead: string, act: () => void): TemplateResult {
  const reason = reasonOf(label);
  return html`<div class="buttons"><div>
    <button aria-disabled=${dead ? 'true' : nothing} aria-describedby=${reason} @click=${() => { if (dead === '') act(); }}>${label}</button>
    <small id=${reason}>${dead}</small></div></div>`;
}
