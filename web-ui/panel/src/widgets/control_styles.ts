// What widgets look like that act, beside what all look like (styles.ts). A first view has none of them.
import { css } from 'lit';

export const controlStyles = css`
  .refusal {
    color: var(--alarm);
  }
  /* What is said and asked of a control lies over what is beside it: nothing moves, and no press reaches what is covered. */
  :host([said]) {
    content-visibility: visible;
    position: relative;
    z-index: 1;
  }
  .over {
    position: absolute;
    inset-block-start: calc(100% - 4px);
    inset-inline-start: 4px;
    width: max-content;
    max-width: min(26rem, calc(100vw - 24px));
    box-sizing: border-box;
    padding: 4px 10px;
    background: var(--field);
    border: 2px solid var(--border);
    border-radius: var(--radius);
    overflow-wrap: anywhere;
  }
  .over.above {
    inset-block: auto calc(100% - 4px);
  }
  .over:empty {
    display: none;
  }
  .refusal.over {
    font-size: 0.9em;
    border-color: var(--alarm);
    cursor: pointer;
  }
  .question {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: var(--gap);
  }
  .why {
    flex: 1 1 0;
    min-width: 0;
    width: 0;
    overflow: hidden;
    text-overflow: ellipsis;
    white-space: nowrap;
    color: var(--muted);
    font-size: 0.9em;
  }
  .why.need {
    flex: 1 0 100%;
    min-height: 1.35em;
    white-space: normal;
  }
  .refusal:not(:empty)::before {
    content: '✕ ';
  }
`;

/** A hold button: large, apart from its neighbours, and unmistakable while its lease lives. */
export const holdStyles = css`
  .hold {
    min-width: var(--flexrf-target-jog, 72px);
    min-height: var(--flexrf-target-jog, 72px);
    font-weight: 600;
    touch-action: none;
    user-select: none;
    -webkit-user-select: none;
    -webkit-touch-callout: none;
  }
  .hold[data-phase='asked'] {
    border-style: dotted;
    border-width: 3px;
  }
  .hold[data-phase='held'] {
    background: var(--active);
    color: var(--active-text);
    border: 3px solid var(--text);
  }
`;
