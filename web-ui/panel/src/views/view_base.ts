// What the panel's own views have in common: the properties that the shell sets, and subscriptions that end with them.
import { property, state } from 'lit/decorators.js';
import type { WidgetHost } from '../contract';
import type { Core } from '../core/core';
import { addressOfRoute } from '../core/route';
import { EndingElement } from '../widgets/ending_element';
import type { ViewElement } from './view';

export abstract class ViewBase extends EndingElement implements ViewElement {
  @property({ attribute: false }) core!: Core;
  @property({ attribute: false }) host!: WidgetHost;
  @property({ attribute: false }) path: readonly string[] = [];

  /** Class of what shows values: "stale" once nothing was heard of the application for too long. */
  @state() protected age = '';

  /** Keeps `age`, from connectedCallback on. */
  protected watchAge(): void {
    const look = (): void => { this.age = this.host.stale ? 'stale' : ''; };
    look();
    this.until(this.host.watchAccess(look));
  }
}

/** Address of a unit's, device's or slot's page. */
export function addressOf(view: 'units' | 'devices' | 'blackboard' | 'threads', name: string): string {
  return addressOfRoute({ view, path: [name] });
}
