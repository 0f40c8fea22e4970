// The addresses of the PC in sentences for people, and the check of what an admin types.
import type { NetworkInterface, NetworkSetting, NetworkTrial } from '../core/machine';

/** How an interface is to get its address; `address` and `gateway` are those of a fixed one. */
export interface AddressChoice {
  readonly interface: string;
  readonly setting: NetworkSetting;
  readonly address: string;
  readonly gateway: string;
}

export const settings: readonly (readonly [NetworkSetting, string])[] = [
  ['image', 'As this version says'], ['dhcp', 'By DHCP'], ['fixed', 'Fixed'],
];

/** As it is set now. */
export function choiceOf({ interface: name, setting, address, gateway }: NetworkInterface): AddressChoice {
  return { interface: name, setting, address, gateway };
}

export function settingSentence({ setting, address, gateway }: NetworkInterface): string {
  if (setting === 'fixed') return `fixed: ${fixedText(address, gateway)}`;
  return setting === 'dhcp' ? 'by DHCP' : 'as this version says';
}

function fixedText(address: string, gateway: string): string {
  return `${address}, ${gateway ? `gateway ${gateway}` : 'no gateway'}`;
}

/** "10.0.2.15/24, 169.254.7.8/16 (link-local)". */
export function addressesText({ addresses }: NetworkInterface): string {
  return addresses.map((address) => (address.startsWith('169.254.') ? `${address} (link-local)` : address)).join(', ') || 'none';
}

export function trialSentence(trial: NetworkTrial): string {
  return `The address of ${trial.interface} is on trial: the former one returns in ${trial.remaining_s} s unless it is kept.`;
}

/** Where the page is found at a fixed address; empty: only the DHCP server knows. */
export function pageAt(choice: AddressChoice, { protocol, port }: Pick<Location, 'protocol' | 'port'>): string {
  if (choice.setting !== 'fixed') return '';
  return `${protocol}//${choice.address.replace(/\/.*/, '')}${port ? `:${port}` : ''}/`;
}

/** What will happen, a paragraph each. */
export function consequences(wired: NetworkInterface, choice: AddressChoice, page: string): readonly string[] {
  const name = wired.interface;
  const become = {
    fixed: `The address of ${name} becomes ${fixedText(choice.address, choice.gateway)}, a second after this.`,
    dhcp: `${name} asks for its address by DHCP, a second after this.`,
    image: `${name} gets its address as this version says, mostly by DHCP, a second after this.`,
  }[choice.setting];
  const unknown = page ? '' : ` The address then comes from the DHCP server: the PC’s screen tells it, and the server has it as that of ${wired.mac}.`;
  return [
    become + unknown,
    `This page may lose the PC by it. Then open ${page || 'the page at that address'}, log in there and press Keep this address within two minutes. `
      + 'Else the former address returns by itself.',
  ];
}

/** Why the choice cannot be set; empty: it can. */
export function faultOf(wired: NetworkInterface, choice: AddressChoice, trial: NetworkTrial | undefined): string {
  if (trial && trial.interface !== choice.interface) return `the address of ${trial.interface} is on trial: keep it first, or wait`;
  const fault = choice.setting === 'fixed' ? addressFault(choice.address, choice.gateway) : '';
  return fault || (isSame(wired, choice) ? 'it is set so already' : '');
}

function isSame(wired: NetworkInterface, choice: AddressChoice): boolean {
  return wired.setting === choice.setting
    && (choice.setting !== 'fixed' || (wired.address === choice.address && wired.gateway === choice.gateway));
}

/** Why these are no address with its network and no gateway of it; empty: they are. */
export function addressFault(address: string, gateway: string): string {
  const [, host = '', length = ''] = /^(.+)\/(\d{1,2})$/.exec(address) ?? [];
  const own = numberOf(host);
  if (own === undefined) return 'type an address as 192.168.1.10/24';
  const prefix = Number(length);
  if (prefix < 8 || prefix > 30) return 'after the / comes a number from 8 to 30';
  const size = 2 ** (32 - prefix);
  if (own % size === 0 || own % size === size - 1) return 'the first and the last address of a network are those of no PC';
  if (gateway === '') return '';
  const other = numberOf(gateway);
  if (other === undefined) return 'type a gateway as 192.168.1.1, or none';
  if (other === own) return 'the gateway is another one than the PC';
  return Math.floor(other / size) === Math.floor(own / size) ? '' : 'the gateway is in another network than the address';
}

/** Of an IPv4 address; undefined: it is none. */
export function numberOf(text: string): number | undefined {
  const parts = text.split('.');
  // "010" is 8 to some programs.
  if (parts.length !== 4 || parts.some((part) => !/^(0|[1-9]\d{0,2})$/.test(part) || Number(part) > 255)) return undefined;
  return parts.reduce((number, part) => 256 * number + Number(part), 0);
}
