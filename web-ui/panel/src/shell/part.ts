// What the shell's parts have in common: the core, and drawing anew when state, session or link changed.
import { property } from 'lit/decorators.js';
import type { PanelCore } from '../core/panel_core';
import { textOf } from '../core/reasons';
import { EndingElement } from '../widgets/ending_element';

export abstract class ShellPart extends EndingElement {
  @property({ attribute: false }) core!: PanelCore;

  override connectedCallback(): void {
    super.connectedCallback();
    this.until(this.core.watchState(() => this.requestUpdate()));
  }

  /** Of the server; why it does not do it is told. */
  protected async ask(op: string, fields?: object): Promise<void> {
    const answer = await this.core.request(op, fields);
    if (!answer.ok) this.core.notify(textOf(answer.problem), 'warning');
  }
}
