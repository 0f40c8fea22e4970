// Six arrows around the tool: it moves while one is held, and where it is stands in the middle. A custom widget: one file,
// plain JavaScript, no build. What it is given and may use is in web-ui/panel/src/contract.ts.
//
//   parameters: plus_x, minus_x, plus_y, minus_y, plus_z, minus_z (holds); slots: pose (optional)

const arrows = [
  // role, what it says, what is read out, its place in the grid
  ['plus_y', '▲', '+y, away', 'away'],
  ['minus_x', '◀', '−x, left', 'left'],
  ['plus_x', '▶', '+x, right', 'right'],
  ['minus_y', '▼', '−y, near', 'near'],
  ['plus_z', '⤒', '+z, up', 'up'],
  ['minus_z', '⤓', '−z, down', 'down'],
];

const style = new CSSStyleSheet();
style.replaceSync(`
  :host { display: block; color: var(--flexrf-text, #1d2126); font: var(--flexrf-font, 15px/1.35 system-ui, sans-serif); }
  .pad {
    display: grid; justify-content: start;
    gap: max(var(--flexrf-gap, 8px), 12px);
    grid-template-columns: repeat(4, auto);
    grid-auto-rows: max(var(--flexrf-target-jog, 72px), 72px);
    justify-items: center;
    grid-template-areas: ". away . up" "left pose right ." ". near . down";
  }
  button {
    display: grid; place-content: center; text-align: center; width: max(var(--flexrf-target-jog, 72px), 72px);
    border: 1px solid var(--flexrf-border, #767d86); border-radius: var(--flexrf-radius, 4px);
    background: var(--flexrf-field, #fff); color: inherit; font: inherit;
    touch-action: none; user-select: none; -webkit-user-select: none; cursor: pointer;
  }
  button > span:first-child { font-size: 1.6em; line-height: 1; }
  button:disabled { color: var(--flexrf-text-muted, #4a5058); border-style: dashed; cursor: default; }
  button:focus-visible { outline: 3px solid var(--flexrf-focus, #0b57a4); outline-offset: 2px; }
  button[aria-pressed="true"] {
    background: var(--flexrf-active, #0b57a4); color: var(--flexrf-active-text, #fff); border-style: double; border-width: 4px;
  }
  .away { grid-area: away; } .near { grid-area: near; } .left { grid-area: left; } .right { grid-area: right; }
  .up { grid-area: up; } .down { grid-area: down; }
  .pose { grid-area: pose; align-self: center; font-variant-numeric: tabular-nums; font-size: .8em; white-space: pre; }
  .stale { color: var(--flexrf-stale, #575d65); font-style: italic; }
  p { margin: 8px 0 0; min-height: 1.35em; color: var(--flexrf-text-muted, #4a5058); }
`);

export default class JogArrows extends HTMLElement {
  #buttons = [];
  #held; // { button, key, hold, pointer, keyboard }: at most one arrow at a time
  #forget = [];
  #say;

  connectedCallback() {
    const root = this.shadowRoot ?? this.attachShadow({ mode: 'open' });
    root.adoptedStyleSheets = [style];
    const pad = document.createElement('div');
    pad.className = 'pad';
    pad.setAttribute('role', 'group');
    pad.setAttribute('aria-label', this.placement.label);
    this.#buttons = arrows
      .filter(([role]) => this.placement.parameters[role] !== undefined)
      .map(([role, sign, words, place]) => this.#arrow(this.placement.parameters[role], sign, words, place));
    const pose = document.createElement('div');
    pose.className = 'pose';
    pad.append(...this.#buttons.map(({ button }) => button), pose);
    this.#say = document.createElement('p');
    this.#say.setAttribute('role', 'status');
    root.replaceChildren(pad, this.#say);

    this.#watch(window, 'pointerup', (event) => event.pointerId === this.#held?.pointer && this.#release());
    this.#watch(window, 'pointercancel', (event) => event.pointerId === this.#held?.pointer && this.#release());
    this.#watch(window, 'keyup', (event) => event.key === this.#held?.keyboard && this.#release());
    this.#watch(window, 'blur', () => this.#release());
    this.#watch(document, 'visibilitychange', () => document.hidden && this.#release());
    this.#forget.push(this.host.watchAccess(() => {
      this.#follow_access();
      pose.classList.toggle('stale', this.host.stale);
    }));
    this.#follow_access();
    if (this.placement.slots.pose) {
      this.#forget.push(this.host.watch(`slot:${this.placement.slots.pose}`, ({ value, reason }) => {
        const names = ['x', 'y', 'z'];
        pose.textContent = value === null
          ? reason
          : names.map((name, i) => `${name} ${(value.position[i] * 1000).toFixed(1).padStart(7)} mm`).join('\n');
      }, { rate: 10 }));
    }
  }

  disconnectedCallback() {
    this.#release();
    this.#forget.splice(0).forEach((end) => end());
  }

  #watch(target, name, listener) {
    target.addEventListener(name, listener);
    this.#forget.push(() => target.removeEventListener(name, listener));
  }

  #arrow(parameter, sign, words, place) {
    const button = document.createElement('button');
    button.type = 'button';
    button.className = place;
    button.setAttribute('aria-label', `Move ${words}, while held`);
    button.setAttribute('aria-pressed', 'false');
    const mark = document.createElement('span');
    mark.textContent = sign;
    const name = document.createElement('span');
    name.textContent = words.split(',')[0];
    button.append(mark, name);
    button.addEventListener('pointerdown', (event) => {
      if (event.button !== 0 || !event.isPrimary) return;
      this.#press(button, parameter, { pointer: event.pointerId });
    });
    button.addEventListener('lostpointercapture', () => this.#held?.button === button && this.#release());
    button.addEventListener('keydown', (event) => {
      if (event.key !== ' ' && event.key !== 'Enter') return;
      event.preventDefault();
      if (!event.repeat) this.#press(button, parameter, { keyboard: event.key });
    });
    button.addEventListener('blur', () => this.#held?.button === button && this.#release());
    button.addEventListener('contextmenu', (event) => event.preventDefault());
    return { button, parameter };
  }

  async #press(button, parameter, by) {
    if (this.#held || this.host.locked(parameter)) return;
    const held = { button, ...by };
    this.#held = held;
    this.#say.textContent = '';
    try {
      held.hold = await this.host.hold(parameter);
      if (this.#held !== held) return held.hold.release(); // let go before it had begun
      button.setAttribute('aria-pressed', 'true');
      const reason = await held.hold.over;
      if (this.#held === held) this.#release(reason);
    } catch (failure) {
      if (this.#held === held) this.#release(failure.message);
    }
  }

  #release(reason = '') {
    const held = this.#held;
    if (!held) return;
    this.#held = undefined;
    held.hold?.release();
    held.button.setAttribute('aria-pressed', 'false');
    this.#say.textContent = reason;
  }

  #follow_access() {
    let why = '';
    for (const { button, parameter } of this.#buttons) {
      const locked = this.host.locked(parameter);
      button.disabled = locked !== '';
      why ||= locked;
    }
    if (why) this.#release();
    if (!this.#held) this.#say.textContent = why;
  }
}
