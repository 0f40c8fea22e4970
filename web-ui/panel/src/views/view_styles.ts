// What views look like; colours and sizes are the theme's, as widgets use them.
import { css } from 'lit';
import { widgetStyles } from '../widgets/styles';

export const viewStyles = [
  widgetStyles,
  css`
    :host {
      content-visibility: visible;
      contain-intrinsic-size: none;
      padding: 0;
    }
    h2 {
      font-size: 1.35em;
      margin: 0.4em 0;
      overflow-wrap: anywhere;
    }
    h3 {
      font-size: 1.1em;
      margin: 1.4em 0 0.4em;
    }
    a {
      color: var(--focus);
      display: inline-block;
      min-height: 24px;
      line-height: 24px;
      overflow-wrap: anywhere;
    }
    a:focus-visible {
      outline: 3px solid var(--focus);
      outline-offset: 1px;
    }
    .muted {
      color: var(--muted);
    }
    .alarm {
      color: var(--alarm);
    }
    .warning {
      color: var(--warning);
    }
    .scroll {
      overflow-x: auto;
      position: relative;
    }
    .scroll:focus-visible {
      outline: 3px solid var(--focus);
    }
    table {
      border-collapse: collapse;
      width: 100%;
    }
    caption {
      text-align: start;
      color: var(--muted);
      padding-block: 0.3em;
    }
    th,
    td {
      text-align: start;
      vertical-align: top;
      padding: 3px 10px 3px 0;
      border-block-end: 1px solid var(--track);
    }
    thead th {
      color: var(--muted);
      font-weight: 500;
      white-space: nowrap;
    }
    tbody th {
      font-weight: 600;
    }
    td.number,
    th.number {
      text-align: end;
      white-space: nowrap;
    }
    @media (pointer: coarse) {
      a {
        min-height: 44px;
        line-height: 44px;
      }
    }
    /* Locked, but still to be reached by the keyboard: a button that acts does not lose the focus by it. */
    [aria-disabled='true'] {
      color: var(--stale);
      background: var(--dead);
      border-style: dashed;
      cursor: not-allowed;
    }
    .buttons {
      display: flex;
      flex-wrap: wrap;
      gap: var(--gap);
      align-items: flex-start;
    }
    .buttons > div {
      display: flex;
      flex-direction: column;
      max-width: 14rem;
    }
    .buttons small {
      color: var(--muted);
    }
    .box {
      border: 1px solid var(--border);
      border-radius: var(--radius);
      padding: 0.5em 0.8em;
      margin-block: 0.6em;
    }
    .box.abnormal-box {
      border-inline-start: 6px solid var(--alarm);
    }
    .box.edit-box {
      border-inline-start: 6px solid var(--modified);
    }
    .box p {
      margin: 0.25em 0;
    }
    .stale {
      color: var(--stale);
      font-style: italic;
      --alarm: var(--stale);
      --warning: var(--stale);
    }
    td a,
    th a {
      white-space: nowrap;
      overflow-wrap: normal;
    }
    dl {
      align-items: baseline;
      display: grid;
      grid-template-columns: max-content 1fr;
      gap: 2px 1em;
      margin: 0.4em 0;
    }
    dt {
      color: var(--muted);
    }
    dd {
      margin: 0;
      overflow-wrap: anywhere;
    }
  `,
];
