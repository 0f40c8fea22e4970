// What all widgets look like. Colours and sizes are custom properties that the page's theme sets; the values here are
// those of the light theme, for a widget that stands alone.
//
//   --flexrf-text            text                                --flexrf-text-muted   labels, units, reasons (>= 4.5:1)
//   --flexrf-surface         behind widgets                      --flexrf-field        behind what can be changed
//   --flexrf-border          around controls (>= 3:1)            --flexrf-track        behind bars and sliders
//   --flexrf-fill            bars, needles, lamps, in grey       --flexrf-focus        ring around what has the focus
//   --flexrf-alarm           abnormal, and refused (>= 4.5:1)    --flexrf-warning      near a limit (>= 4.5:1)
//   --flexrf-active          behind a hold whose lease lives     --flexrf-active-text  on it (>= 4.5:1)
//   --flexrf-modified        mark of a value that is not its default (>= 3:1)
//   --flexrf-stale           text of values that are old (>= 4.5:1)
//   --flexrf-target          least size of a control, 32px       --flexrf-target-coarse  the same for gloves, 56px
//   --flexrf-target-jog      of a hold button, 72px              --flexrf-gap          between controls, 8px
//   --flexrf-radius          of corners, 4px                     --flexrf-font         everything's font
//
// Grey is the normal state; a colour always comes with a sign or a word (ISA-101).
import { css } from 'lit';

export const widgetStyles = css`
  :host {
    --text: var(--flexrf-text, #1d2126);
    --muted: var(--flexrf-text-muted, #4a5058);
    --surface: var(--flexrf-surface, #eceef0);
    --field: var(--flexrf-field, #ffffff);
    --border: var(--flexrf-border, #767d86);
    --track: var(--flexrf-track, #d2d6da);
    --fill: var(--flexrf-fill, #626a73);
    --focus: var(--flexrf-focus, #0b57a4);
    --alarm: var(--flexrf-alarm, #a8001c);
    --warning: var(--flexrf-warning, #7a4b00);
    --active: var(--flexrf-active, #0b57a4);
    --active-text: var(--flexrf-active-text, #ffffff);
    --modified: var(--flexrf-modified, #0b57a4);
    --stale: var(--flexrf-stale, #575d65);
    /* Hatched: what does not act is not to be taken for what does, in bright light neither. */
    --dead: repeating-linear-gradient(135deg, var(--track) 0 2px, transparent 2px 7px);
    --target: var(--flexrf-target, 32px);
    --gap: var(--flexrf-gap, 8px);
    --radius: var(--flexrf-radius, 4px);
    display: block;
    color: var(--text);
    font: var(--flexrf-font, 15px/1.35 system-ui, sans-serif);
    font-variant-numeric: tabular-nums;
    /* What is scrolled away costs nothing; the padding leaves room for the ring of the focus. */
    content-visibility: auto;
    contain-intrinsic-size: auto 2.5rem;
    padding: 4px;
  }
  :host([hidden]) {
    display: none;
  }
  @media (pointer: coarse) {
    :host {
      --target: var(--flexrf-target-coarse, 56px);
    }
  }
  :host([stale]) .content {
    color: var(--stale);
    font-style: italic;
    --text: var(--stale);
    --fill: var(--track);
    --active: var(--stale);
    --alarm: var(--stale);
  }

  .row {
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    gap: 2px var(--gap);
  }
  .head {
    flex: 1 1 7rem;
    min-width: 0;
    color: var(--muted);
    overflow-wrap: anywhere;
  }
  .content {
    flex: 3 1 12rem;
    /* Below the label where there is no room beside it. */
    min-width: fit-content;
    display: flex;
    flex-wrap: wrap;
    align-items: center;
    justify-content: flex-end;
    gap: var(--gap);
  }
  .head.hidden + .content {
    justify-content: flex-start;
  }
  /* Why there is no value takes no room of its own: a line that came and went would move what lies below. */
  #absence {
    width: 0;
    flex: 6 1 auto;
    margin-inline-end: calc(-1 * var(--gap));
    overflow: hidden;
    text-overflow: ellipsis;
    white-space: nowrap;
    text-align: end;
    color: var(--muted);
    font-size: 0.9em;
    line-height: 1.2;
  }
  #absence:empty {
    display: none;
  }
  #absence::after {
    content: '\u00a0\u00a0';
  }
  .head.hidden + .content > #absence {
    order: 1;
    text-align: start;
  }
  /* What fills its place has no line to spare, and shows nothing meanwhile. */
  .content:has(> :is(svg, .picture, .dial, .scroll, .cells)) {
    position: relative;
  }
  .content:has(> :is(svg, .picture, .dial, .scroll, .cells)) > #absence {
    position: absolute;
    inset: 0 auto auto 0;
    width: auto;
    max-width: 100%;
    margin: 0;
    padding: 0 4px;
    box-sizing: border-box;
    white-space: normal;
    text-align: start;
    background: var(--surface);
    z-index: 1;
  }
  .notes {
    flex: 1 0 100%;
    display: flex;
    flex-wrap: wrap;
    gap: 0 var(--gap);
    color: var(--muted);
    font-size: 0.9em;
  }
  .notes > :empty,
  .notes:not(:has(> :not(:empty))) {
    display: none;
  }
  .modified {
    color: var(--modified);
    font-weight: 600;
  }
  .value {
    text-align: right;
    white-space: nowrap;
  }
  .boxed {
    display: inline-block;
    min-width: 6ch;
    height: 1.35em;
    contain: strict;
    vertical-align: bottom;
  }
  .wide {
    white-space: normal;
    overflow-wrap: anywhere;
  }
  .unit {
    color: var(--muted);
    min-width: 2.5em;
  }
  .unit:empty {
    display: none;
  }
  .abnormal {
    color: var(--alarm);
    font-weight: 600;
  }
  .abnormal:empty {
    display: none;
  }

  button,
  input,
  select {
    font: inherit;
    color: var(--text);
    background: var(--field);
    border: 1px solid var(--border);
    border-radius: var(--radius);
    min-height: var(--target);
    min-width: var(--target);
    padding: 0 0.5em;
    box-sizing: border-box;
    margin: 0;
  }
  button {
    background: var(--surface);
    cursor: pointer;
    touch-action: manipulation;
  }
  input[type='checkbox'],
  input[type='range'] {
    accent-color: var(--fill);
    padding: 0;
  }
  :is(button, input, select, [tabindex]):focus-visible {
    outline: 3px solid var(--focus);
    outline-offset: 1px;
  }
  .controls {
    display: inline-flex;
    flex-wrap: wrap;
    align-items: center;
    justify-content: flex-end;
    gap: var(--gap);
    min-width: 0;
  }
  /* A touch on a dead control reaches what is around it, which tells why. */
  :disabled {
    pointer-events: none;
    color: var(--stale);
    background: transparent;
    border-style: dashed;
    opacity: 1;
  }
  button:disabled,
  button[aria-disabled='true'] {
    background: var(--dead);
  }
  [aria-busy='true'] {
    border-style: dotted;
  }

  .hidden {
    position: absolute;
    width: 1px;
    height: 1px;
    overflow: hidden;
    clip-path: inset(50%);
    white-space: nowrap;
  }
  @media (forced-colors: active) {
    .bar > i {
      background: CanvasText;
    }
  }
`;

/** A value against its range: grows from the left, or from zero where zero lies within. */
export const barStyles = css`
  .bar {
    position: relative;
    flex: 1 1 4rem;
    min-width: 3rem;
    height: 8px;
    overflow: hidden;
    background: var(--track);
    border-radius: 2px;
  }
  .bar > i {
    position: absolute;
    inset: 0;
    background: var(--fill);
    transform-origin: 0 0;
    transform: scaleX(0);
  }
  .bar > b {
    position: absolute;
    inset: 0 auto 0 0;
    width: 1px;
    background: var(--text);
  }
`;
