// What an admin does to the addresses of the PC and to its declared hosts, and where the PC is found while that is on trial.
import type { Core } from '../core/core';
import { MachineWatch, trialOf, type MachineState, type NetworkInterface } from '../core/machine';
import { added } from '../core/watchers';
import { hostsConsequences } from './hosts_words';
import { MachineActs } from './machine_acts';
import { consequences, pageAt, type AddressChoice } from './network_words';

/** ms; the PC tries an address for two minutes, from a second after its answer on. */
const onTrialFor = 121_000;

const acts = new WeakMap<Core, NetworkActs>();

/** Outlives views: who looks elsewhere meanwhile finds where to go. */
export class NetworkActs {
  /** What was set from this page, as long as it is on trial. */
  tried: AddressChoice | undefined;
  #isHeard = false;
  #timer: ReturnType<typeof setTimeout> | undefined;
  readonly #watchers = new Set<() => void>();
  readonly #machine: MachineWatch;
  readonly #acts: MachineActs;

  static of(core: Core): NetworkActs {
    let one = acts.get(core);
    if (one === undefined) acts.set(core, (one = new NetworkActs(core)));
    return one;
  }

  private constructor(private readonly core: Core) {
    this.#acts = MachineActs.of(core);
    this.#machine = MachineWatch.of(core);
    this.#machine.watch(() => this.#onState());
  }

  watch(callback: () => void): () => void {
    return added(this.#watchers, callback);
  }

  askSet(wired: NetworkInterface, choice: AddressChoice): void {
    const isFixed = choice.setting === 'fixed';
    this.core.askPassword({
      heading: `Set the address of ${wired.interface}?`,
      says: consequences(wired, choice, pageAt(choice, location)),
      action: 'Set the address',
      act: async (password) => {
        const refusal = await this.#acts.post('network', {
          password, interface: choice.interface, address: isFixed ? choice.address : choice.setting, gateway: isFixed ? choice.gateway : '',
        });
        if (refusal === '') this.#try(choice);
        return refusal;
      },
    });
  }

  askKeep(name: string): void {
    this.core.askPassword({
      heading: `Keep the address of ${name}?`,
      says: ['It does not return to the former one any more, and stays after a restart of the PC.'],
      action: 'Keep this address',
      act: (password) => this.#acts.post('keep-network', { password }),
    });
  }

  /** `done`: they are declared, and the state tells them. */
  askHosts(known: MachineState, hosts: readonly string[], done: () => void): void {
    this.core.askPassword({
      heading: 'Set the other addresses of this PC?',
      says: hostsConsequences(known, hosts, location.hostname),
      action: 'Set other addresses',
      act: async (password) => {
        const refusal = await this.#acts.post('hosts', { password, hosts: hosts.join(' ') });
        if (refusal === '') void this.#machine.refresh().then(done);
        return refusal;
      },
    });
  }

  #try(choice: AddressChoice): void {
    this.#become(choice);
    // A page that has lost the PC does not hear of the end.
    this.#timer = setTimeout(() => this.#become(undefined), onTrialFor);
  }

  /** The first states after it may be older than the trial: its end is one only after its beginning. */
  #onState(): void {
    if (this.tried === undefined) return;
    const isOn = trialOf(this.#machine.state)?.interface === this.tried.interface;
    if (!isOn && this.#isHeard) this.#become(undefined);
    else this.#isHeard = isOn;
  }

  #become(tried: AddressChoice | undefined): void {
    clearTimeout(this.#timer);
    this.tried = tried;
    this.#isHeard = false;
    this.#watchers.forEach((watcher) => watcher());
  }
}
