// Why the version in the other slot failed, as an expandable block of the view of the PC.
import { css, html, nothing } from 'lit';
import type { MachineFailure } from '../core/machine';
import { failedStartText, failureHeading, sentence, silentStartsSentence } from './machine_words';

export const machineFailureStyles = css`
  details.failure {
    border-inline-start: 6px solid var(--warning);
    padding-block: 0;
  }
  details.failure summary {
    cursor: pointer;
    min-height: var(--target);
    display: list-item;
    align-content: center;
    padding-block: 6px;
    box-sizing: border-box;
    font-weight: 600;
    overflow-wrap: anywhere;
  }
  details.failure summary:focus-visible {
    outline: 3px solid var(--focus);
  }
  details.failure pre {
    background: var(--field);
    border: 1px solid var(--border);
    padding: 6px 10px;
    margin-block: 0.3em;
    font: 13px/1.45 ui-monospace, monospace;
    white-space: pre-wrap;
    overflow-wrap: anywhere;
  }
`;

/** `dismiss`: the button that ends it. */
export function failureBlock(failure: MachineFailure | undefined, dismiss: unknown): unknown {
  if (!failure) return nothing;
  const silent = silentStartsSentence(failure);
  return html`
    <details class="box failure">
      <summary>⚠ ${failureHeading(failure)}</summary>
      <dl>
        <dt>Start</dt><dd>${failedStartText(failure)}</dd>
        <dt>Reason</dt><dd>${sentence(failure.reason)}${silent ? html`<br />${silent}` : nothing}</dd>
        <dt>Last lines</dt><dd>${failure.lines.length === 0 ? failure.why_no_lines
    : html`Of its application, each with the seconds since the kernel of its start began.`}</dd>
      </dl>
      ${failure.lines.length === 0 ? nothing : html`<pre>${failure.lines.join('\n')}</pre>`}
      ${dismiss}
    </details>`;
}
