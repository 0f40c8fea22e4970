// A part of the view of the PC in which an admin sets something.
import { deniedLink } from '../core/access';
import { MachineWatch } from '../core/machine';
import { MachineActs } from './machine_acts';
import { NetworkActs } from './network_acts';
import { ViewBase } from './view_base';

export abstract class MachinePart extends ViewBase {
  /** Whether the form is shown. */
  protected mayAct = false;
  protected acts!: MachineActs;
  protected network!: NetworkActs;
  protected machine!: MachineWatch;

  override connectedCallback(): void {
    super.connectedCallback();
    this.acts = MachineActs.of(this.core);
    this.network = NetworkActs.of(this.core);
    this.machine = MachineWatch.of(this.core);
    this.watchAge();
    this.until(this.machine.watch(() => this.requestUpdate()));
    this.until(this.network.watch(() => this.requestUpdate()));
    this.until(this.core.watchState(() => this.requestUpdate()));
  }

  /** Keeps the form while the link is silent for a moment, so that nothing that was typed is lost. */
  protected override willUpdate(): void {
    if (deniedLink(this.core) === '') this.mayAct = this.acts.denied === '';
  }

  /** The class of what the PC told, when that is old. */
  protected get staleness(): string {
    return this.age || (this.machine.trouble ? 'stale' : '');
  }
}
