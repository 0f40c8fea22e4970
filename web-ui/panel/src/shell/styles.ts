// What the shell's parts look like, beside the theme.
import { css } from 'lit';

export const shellStyles = css`
  :host {
    --target: var(--flexrf-target);
    color: var(--flexrf-text);
    font: var(--flexrf-font);
  }
  :host([hidden]) {
    display: none;
  }
  @media (pointer: coarse) {
    :host {
      --target: var(--flexrf-target-coarse);
    }
  }
  button,
  input,
  select {
    font: inherit;
    color: inherit;
    background: var(--flexrf-surface);
    border: 1px solid var(--flexrf-border);
    border-radius: var(--flexrf-radius);
    min-height: var(--target);
    min-width: var(--target);
    padding: 0 0.7em;
    box-sizing: border-box;
    margin: 0;
  }
  input,
  select {
    background: var(--flexrf-field);
  }
  button {
    cursor: pointer;
    touch-action: manipulation;
  }
  button.first {
    font-weight: 600;
    border-width: 2px;
  }
  :is(a, button, input, select, [tabindex]):focus-visible {
    outline: 3px solid var(--flexrf-focus);
    outline-offset: 1px;
  }
  :disabled,
  [aria-disabled='true'] {
    color: var(--flexrf-stale);
    border-style: dashed;
    cursor: not-allowed;
  }
  button:disabled {
    background: repeating-linear-gradient(135deg, var(--flexrf-track) 0 2px, transparent 2px 7px);
  }
  small,
  .muted {
    color: var(--flexrf-text-muted);
  }
  .alarm {
    color: var(--flexrf-alarm);
    font-weight: 600;
  }
  .warning {
    color: var(--flexrf-warning);
    font-weight: 600;
  }
  /* Beside a button: what is, and what is to be said about it. Never more than two lines. */
  .said {
    display: -webkit-box;
    -webkit-box-orient: vertical;
    -webkit-line-clamp: 2;
    overflow: hidden;
    min-width: 0;
    line-height: 1.2;
    overflow-wrap: anywhere;
  }
  .said + button {
    flex: none;
  }
`;
