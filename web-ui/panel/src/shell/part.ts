// What the shell's parts have in common: the core, and drawing anew when state, session or link changed.
import { LitElement } from 'lit';
import { property } from 'lit/decorators.js';
import type { PanelCore } from '../core/panel_core';

export abstract class ShellPart extends LitElement {
  @property({ attribute: false }) core!: PanelCore;
  #end: (() => void) | undefined;

  override connectedCallback(): void {
    super.connectedCallback();
    this.#end = this.core.watchState(() => this.requestUpdate());
  }
  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#end?.();
  }
}
