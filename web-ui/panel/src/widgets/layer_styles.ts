// What lists of things that are drawn look like, with a switch for each and a table of them: below a picture, below a robot.
import { css } from 'lit';

export const layerStyles = css`
  :host {
    padding: 0;
    content-visibility: visible;
  }
  ul {
    list-style: none;
    margin: 4px 0;
    padding: 0;
  }
  li {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 0 1em;
  }
  label {
    display: inline-flex;
    align-items: center;
    gap: 0.4em;
    min-height: var(--target);
    min-width: 8rem;
    cursor: pointer;
  }
  input {
    min-width: 24px;
    min-height: 24px;
  }
  .sample {
    display: inline-flex;
    align-items: center;
    gap: 0.4em;
    margin-inline-end: 1em;
  }
  /* A place of its own: what it says changes with each picture, and moves nothing. */
  .state {
    flex: 1 1 14rem;
    min-height: 1.35em;
    color: var(--muted);
  }
  .state.abnormal {
    color: var(--alarm);
  }
  .scroll {
    overflow: auto;
    max-height: 20rem;
  }
  table {
    border-collapse: collapse;
  }
  caption {
    text-align: start;
    color: var(--muted);
  }
  th,
  td {
    text-align: start;
    font-weight: 400;
    padding: 1px 1em 1px 0;
  }
  td.number {
    text-align: end;
  }
  summary {
    min-height: max(24px, calc(var(--target) * 0.75));
    cursor: pointer;
  }
  summary:focus-visible {
    outline: 3px solid var(--focus);
  }
`;
