// Whether anything is in fault, in every view: how many, the newest and since when. The line is always there, so that nothing
// moves when a fault comes.
import { css, html } from 'lit';
import { customElement } from 'lit/decorators.js';
import { deniedLink } from '../core/access';
import type { Fault } from '../core/protocol';
import { addressOfFault, clockText, faultCount, newestFault } from '../core/words';
import { ShellPart } from './part';
import { shellStyles } from './styles';

@customElement('flexrf-faults')
export class Faults extends ShellPart {
  static override styles = [
    shellStyles,
    css`
      :host {
        display: block;
        min-width: 0;
        min-height: 28px;
        line-height: 28px;
      }
      a,
      span {
        display: block;
        overflow: hidden;
        text-overflow: ellipsis;
        white-space: nowrap;
      }
      a {
        padding: 0 8px;
        color: var(--flexrf-alarm);
        background: var(--flexrf-field);
        border-inline-start: 6px solid var(--flexrf-alarm);
      }
      a.old {
        color: var(--flexrf-stale);
        border-color: var(--flexrf-stale);
        font-style: italic;
      }
    `,
  ];

  private at: { readonly since_ns: number; readonly date: Date } | undefined;

  protected override render(): unknown {
    const { state } = this.core;
    const faults = state?.faults ?? [];
    const newest = newestFault(faults);
    const old = deniedLink(this.core) !== '';
    if (newest === undefined) {
      return html`<span class="muted" role="status">${old || !state ? 'Faults: not known' : 'No faults'}</span>`;
    }
    const text = `${newest.component}: ${newest.cause}`;
    const newestText = faults.length === 1 ? 'since' : 'newest since';
    return html`<div role="status"><a class=${old ? 'old' : ''} href=${addressOfFault(newest)} title=${text}
      >✕ <strong>${faultCount(faults.length)}</strong>, ${newestText} ${this.since(newest)}: ${text}</a></div>`;
  }

  /** Worked out once: the two clocks differ a little each time. */
  private since(fault: Fault): string {
    const now = Date.now();
    if (this.at?.since_ns !== fault.since_ns) {
      const age = (this.core.connection.serverNow() - fault.since_ns) / 1e6;
      this.at = { since_ns: fault.since_ns, date: new Date(now - age) };
    }
    return clockText(this.at.date, new Date(now));
  }
}
