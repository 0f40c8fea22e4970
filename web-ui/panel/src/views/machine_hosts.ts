// The declared hosts of the PC: at which names and addresses its panel answers beside its own, and setting them.
import { css, html, nothing } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import type { MachineState } from '../core/machine';
import { hostsFault, hostsIn, hostsText } from './hosts_words';
import { machineButton, machineButtonStyles, reasonOf } from './machine_button';
import { MachinePart } from './machine_part';
import { viewStyles } from './view_styles';

const setLabel = 'Set other addresses';

@customElement('flexrf-machine-hosts')
export class MachineHosts extends MachinePart {
  static override styles = [
    ...viewStyles,
    machineButtonStyles,
    css`
      p {
        margin: 0.4em 0;
        overflow-wrap: anywhere;
      }
      label {
        display: grid;
        gap: 2px;
        grid-template-columns: minmax(0, 1fr);
        margin-block: 0.5em;
      }
      input {
        box-sizing: border-box;
        width: min(60ch, 100%);
      }
    `,
  ];

  /** What was typed; undefined: nothing yet. */
  @state() private typed: string | undefined;

  protected override render(): unknown {
    const known = this.machine.state;
    if (!known?.hosts) return nothing;
    return html`
      <h3>Other addresses of this PC</h3>
      <p class="muted">For a PC behind NAT or a VPN router, or with a name in the company’s DNS: the panel answers at these names and addresses, too.</p>
      <p class=${this.staleness}>Set now: ${hostsText(known.hosts)}</p>
      ${this.mayAct ? this.form(known, known.hosts) : nothing}
    `;
  }

  private form(known: MachineState, hosts: readonly string[]): unknown {
    const text = this.typed ?? hosts.join(' ');
    const next = hostsIn(text);
    return html`
      <form aria-label=${setLabel} @submit=${(event: Event) => event.preventDefault()}>
        <label>Names and IPv4 addresses, separated by blanks; empty for none
          <input type="text" autocomplete="off" autocapitalize="none" spellcheck="false" aria-describedby=${reasonOf(setLabel)}
            .value=${text} @input=${(event: Event) => { this.typed = (event.target as HTMLInputElement).value; }} /></label>
        ${machineButton(setLabel, this.acts.denied || hostsFault(hosts, next), () => this.network.askHosts(known, next, () => { this.typed = undefined; }))}
      </form>`;
  }
}
