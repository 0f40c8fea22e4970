// Above a long list that is read: a filter, and what else chooses of it.
import { css, html, type TemplateResult } from 'lit';

export const toolStyles = css`
  .tools {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 8px 16px;
    margin-block: 8px;
  }
  label {
    display: inline-flex;
    align-items: center;
    gap: 6px;
    min-height: var(--target);
  }
`;

export function filterField(wanted: string, want: (wanted: string) => void): TemplateResult {
  return html`<label>Filter <input type="search" .value=${wanted} @input=${(event: Event) =>
    want((event.target as HTMLInputElement).value)} /></label>`;
}
