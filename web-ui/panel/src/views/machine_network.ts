// The wired interfaces of the PC: what addresses they have, and setting them.
import { css, html, nothing } from 'lit';
import { customElement, state } from 'lit/decorators.js';
import { trialOf, type MachineState, type NetworkInterface, type NetworkSetting } from '../core/machine';
import { machineButton, machineButtonStyles, reasonOf } from './machine_button';
import { MachinePart } from './machine_part';
import { addressesText, choiceOf, faultOf, pageAt, settingSentence, settings, trialSentence, type AddressChoice } from './network_words';
import { viewStyles } from './view_styles';

const setLabel = 'Set the address';

@customElement('flexrf-machine-network')
export class MachineNetwork extends MachinePart {
  static override styles = [
    ...viewStyles,
    machineButtonStyles,
    css`
      label {
        display: grid;
        gap: 2px;
        justify-items: start;
        margin-block: 0.5em;
      }
      input,
      select {
        width: 24ch;
        max-width: 100%;
      }
      th small {
        font-weight: 400;
        white-space: nowrap;
      }
    `,
  ];

  /** What was chosen and typed; undefined: nothing yet. */
  @state() private typed: AddressChoice | undefined;

  protected override render(): unknown {
    const known = this.machine.state;
    if (!known?.network) return nothing;
    return html`
      <h3 id="network">Network</h3>
      <div class=${this.staleness}>${this.interfaces(known.network)}${this.trial(known)}</div>
      <div role="status">${this.whereTo(known.network)}</div>
      ${this.mayAct && known.network.length > 0 ? this.form(known, known.network) : nothing}
    `;
  }

  private interfaces(network: readonly NetworkInterface[]): unknown {
    if (network.length === 0) return html`<p>This PC has no wired interface.</p>`;
    return html`
      <div class="scroll" tabindex="0" role="region" aria-labelledby="network">
        <table>
          <thead><tr><th scope="col">Interface</th><th scope="col">Link</th><th scope="col">Address now</th><th scope="col">Setting</th></tr></thead>
          <tbody>${network.map((one) => html`
            <tr><th scope="row">${one.interface}<br /><small class="muted">${one.mac}</small></th>
              <td>${one.link ? 'connected' : 'no cable'}</td><td>${addressesText(one)}</td><td>${settingSentence(one)}</td></tr>`)}
          </tbody>
        </table>
      </div>`;
  }

  private trial(known: MachineState): unknown {
    const trial = trialOf(known);
    if (!trial) return nothing;
    return html`
      <div class="box edit-box">
        <p role="timer">${trialSentence(trial)}</p>
        ${this.mayAct ? machineButton('Keep this address', this.acts.denied, () => this.network.askKeep(trial.interface)) : nothing}
      </div>`;
  }

  /** For a page that loses the PC by what was set from it. */
  private whereTo(network: readonly NetworkInterface[]): unknown {
    const { tried } = this.network;
    if (!tried) return nothing;
    const page = pageAt(tried, location);
    const mac = network.find((one) => one.interface === tried.interface)?.mac;
    return html`<p>Open ${page ? html`<a href=${page}>${page}</a>` : `this page at the address that the DHCP server gave to ${mac}`},
      log in there and keep the address within two minutes.</p>`;
  }

  private form(known: MachineState, network: readonly NetworkInterface[]): unknown {
    const one = network.find(({ interface: name }) => name === this.typed?.interface) ?? network[0]!;
    const choice = one.interface === this.typed?.interface ? this.typed : choiceOf(one);
    const dead = this.acts.denied || this.acts.deniedByMotion(known) || faultOf(one, choice, trialOf(known));
    return html`
      <form aria-label=${setLabel} @submit=${(event: Event) => event.preventDefault()}>
        <label>Interface
          <select @change=${(event: Event) => { this.typed = choiceOf(network[(event.target as HTMLSelectElement).selectedIndex]!); }}>
            ${network.map(({ interface: name }) => html`<option .selected=${name === one.interface}>${name}</option>`)}
          </select></label>
        <label>Its address
          <select @change=${(event: Event) => { this.typed = { ...choice, setting: (event.target as HTMLSelectElement).value as NetworkSetting }; }}>
            ${settings.map(([setting, text]) => html`<option value=${setting} .selected=${setting === choice.setting}>${text}</option>`)}
          </select></label>
        ${choice.setting === 'fixed' ? html`
          ${this.field('Address and network, as 192.168.1.10/24', choice.address, (address) => { this.typed = { ...choice, address }; })}
          ${this.field('Gateway, as 192.168.1.1; empty for none', choice.gateway, (gateway) => { this.typed = { ...choice, gateway }; })}` : nothing}
        ${machineButton(setLabel, dead, () => this.network.askSet(one, choice))}
      </form>`;
  }

  private field(label: string, value: string, take: (text: string) => void): unknown {
    return html`<label>${label}
      <input type="text" autocomplete="off" autocapitalize="none" spellcheck="false" aria-describedby=${reasonOf(setLabel)}
        .value=${value} @input=${(event: Event) => take((event.target as HTMLInputElement).value.trim())} /></label>`;
  }
}
