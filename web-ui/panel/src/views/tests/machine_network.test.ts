import { describe, expect, it, vi } from 'vitest';
import { quiet } from '../../core/tests/fake_core';
import { pc, wired } from '../../core/tests/machine_sample';
import type { MachineNetwork } from '../machine_network';
import '../machine_network';
import { PartSetup } from './machine_part_setup';

const second = { ...wired, interface: 'enp3s0', mac: '52:54:00:12:34:57', link: false, addresses: [] };
const onTrial = { interface: 'enp0s2', remaining_s: 87 };
const setLabel = 'Set the address';
const whereTo = `Open ${location.protocol}//192.168.1.10:${location.port}/, log in there and keep the address within two minutes.`;

const part = new PartSetup<MachineNetwork>('flexrf-machine-network');
const { posted } = part;

const shown = part.shown.bind(part);
const text = part.text.bind(part);
function button(label: string): HTMLButtonElement | undefined {
  return [...part.view.shadowRoot!.querySelectorAll('button')].find((one) => one.textContent === label);
}
function control<Control extends HTMLInputElement | HTMLSelectElement>(label: string): Control | undefined {
  return [...part.view.shadowRoot!.querySelectorAll('label')].find((one) => one.textContent!.trim().startsWith(label))
    ?.querySelector<Control>('input, select') ?? undefined;
}
async function chooses(label: string, value: string): Promise<void> {
  const select = control<HTMLSelectElement>(label)!;
  select.value = value;
  select.dispatchEvent(new Event('change'));
  await part.view.updateComplete;
}
const types = (label: string, value: string): Promise<void> => part.types(control<HTMLInputElement>(label)!, value);
async function choosesFixed(address = '192.168.1.10/24', gateway = ''): Promise<void> {
  await chooses('Its address', 'fixed');
  await types('Address', address);
  await types('Gateway', gateway);
}
/** Why the button that sets does nothing; empty: it acts. */
const dead = (): string => part.reasonOf(button(setLabel)!);
const sentTo = (): unknown[] => (posted.mock.calls as [string, RequestInit][]).map(([path, { body }]) => [path, JSON.parse(body as string)]);

describe('the network of the PC', () => {
  it('shows each interface', async () => {
    const words = await shown({ network: [{ ...wired, setting: 'fixed', address: '10.0.2.16/24', gateway: '10.0.2.2' }, second] });
    expect(words).toContain('enp0s252:54:00:12:34:56 connected10.0.2.15/24fixed: 10.0.2.16/24, gateway 10.0.2.2');
    expect(words).toContain('enp3s052:54:00:12:34:57 no cablenoneas this version says');
  });

  it('is not shown of an older helper, and needs an interface to set one', async () => {
    const { network, network_trial, ...older } = pc;
    expect(await part.told(older)).not.toContain('Network');
    expect(await shown({ network: [] })).toContain('This PC has no wired interface.');
    expect(button(setLabel)).toBeUndefined();
  });

  it('has nothing to set for who is no admin', async () => {
    part.core.roleDenied = 'needs admin';
    expect(await shown({ network_trial: onTrial })).toContain('the former one returns in 87 s unless it is kept');
    expect(part.view.shadowRoot!.querySelectorAll('button, input, select')).toHaveLength(0);
  });
});

describe('setting an address', () => {
  it('says why it cannot be done', async () => {
    await shown();
    expect(dead()).toBe('it is set so already');
    expect(control('Gateway')).toBeUndefined();
    await chooses('Its address', 'fixed');
    expect(dead()).toBe('type an address as 192.168.1.10/24');
    expect(control('Gateway')!.getAttribute('aria-describedby')).toBe(button(setLabel)!.getAttribute('aria-describedby'));
    button(setLabel)!.click();
    expect(part.core.questions).toEqual([]);
    await choosesFixed();
    expect(dead()).toBe('');
    part.core.says({ motion: { ...quiet.motion, may_move: true } });
    await part.view.updateComplete;
    expect(dead()).toBe('the cell may move: give Stop motion first');
    part.core.says({});
    await shown({ network_trial: { ...onTrial, interface: 'enp3s0' } });
    expect(dead()).toBe('the address of enp3s0 is on trial: keep it first, or wait');
  });

  it('asks for the password, says what will happen, and where to go then', async () => {
    await shown();
    await choosesFixed(' 192.168.1.10/24 ', '192.168.1.1');
    button(setLabel)!.click();
    const question = part.core.questions[0]!;
    expect(question.heading).toBe('Set the address of enp0s2?');
    expect(question.says.join(' ')).toContain(`open ${location.protocol}//192.168.1.10:${location.port}/, log in there`);
    posted.mockImplementationOnce(() => Promise.resolve(new Response('{"detail":"User or password is wrong."}', { status: 403 })));
    expect(await question.act('wrong')).toBe('User or password is wrong.');
    expect(await text()).not.toContain('log in there');
    posted.mockClear();
    expect(await question.act('p')).toBe('');
    expect(sentTo()).toEqual([['/api/v1/machine/network', { password: 'p', interface: 'enp0s2', address: '192.168.1.10/24', gateway: '192.168.1.1' }]]);
    expect(await text()).toContain(whereTo);
    expect(part.view.shadowRoot!.querySelector('a')!.href).toBe(`${location.protocol}//192.168.1.10:${location.port}/`);
    part.core.link = { ...part.core.link, phase: 'waiting' };
    part.core.says({});
    expect(await text()).toContain(whereTo);
  });

  it('of the DHCP server the page knows no address', async () => {
    await shown({ network: [second, wired] });
    await chooses('Interface', 'enp0s2');
    await choosesFixed();
    await chooses('Its address', 'dhcp');
    button(setLabel)!.click();
    await part.core.questions[0]!.act('p');
    expect(sentTo()).toEqual([['/api/v1/machine/network', { password: 'p', interface: 'enp0s2', address: 'dhcp', gateway: '' }]]);
    expect(await text()).toContain('Open this page at the address that the DHCP server gave to 52:54:00:12:34:56, log in there');
  });

  it('goes back to what the version says', async () => {
    await shown({ network: [{ ...wired, setting: 'fixed', address: '10.0.2.16/24', gateway: '' }] });
    expect(control<HTMLInputElement>('Address')!.value).toBe('10.0.2.16/24');
    await chooses('Its address', 'image');
    button(setLabel)!.click();
    await part.core.questions[0]!.act('p');
    expect(sentTo()).toEqual([['/api/v1/machine/network', { password: 'p', interface: 'enp0s2', address: 'image', gateway: '' }]]);
  });

  it('keeps what was typed while the state goes on and the link is lost for a moment', async () => {
    await shown({ network: [wired, second] });
    await chooses('Interface', 'enp3s0');
    await choosesFixed('192.168.1.1');
    const input = control<HTMLInputElement>('Address')!;
    await shown({ network: [{ ...wired, link: false }, { ...second, link: true }], notices: ['another'] });
    part.core.roleDenied = 'values are old';
    part.core.link = { ...part.core.link, stale: true };
    part.core.says({});
    await part.view.updateComplete;
    expect(control('Address')).toBe(input);
    expect(input.value).toBe('192.168.1.1');
    expect(control<HTMLSelectElement>('Interface')!.value).toBe('enp3s0');
    expect(dead()).toBe('values are old');
  });

  it('what was typed for one interface is not set at another', async () => {
    await shown({ network: [wired, second] });
    await choosesFixed();
    await chooses('Interface', 'enp3s0');
    expect(control<HTMLSelectElement>('Its address')!.value).toBe('image');
    expect(dead()).toBe('it is set so already');
    await choosesFixed();
    await shown({ network: [wired] });
    expect(control<HTMLSelectElement>('Interface')!.value).toBe('enp0s2');
    expect(control('Address')).toBeUndefined();
  });

  it('Enter in a field asks as the button does, and leaves the page where it is', async () => {
    await shown();
    await choosesFixed();
    const form = part.view.shadowRoot!.querySelector('form')!;
    const left = vi.fn((event: Event) => event.defaultPrevented);
    form.addEventListener('submit', left);
    form.requestSubmit();
    expect(left).toHaveReturnedWith(true);
    expect(button(setLabel)!.type).toBe('submit');
  });
});

describe('an address on trial', () => {
  async function set(): Promise<void> {
    await shown();
    await choosesFixed();
    button(setLabel)!.click();
    await part.core.questions[0]!.act('p');
  }

  it('is kept with the password', async () => {
    expect(await shown({ network_trial: onTrial })).toContain('The address of enp0s2 is on trial: the former one returns in 87 s unless it is kept.');
    button('Keep this address')!.click();
    expect(part.core.questions[0]!.heading).toBe('Keep the address of enp0s2?');
    expect(await part.core.questions[0]!.act('p')).toBe('');
    expect(sentTo()).toEqual([['/api/v1/machine/keep-network', { password: 'p' }]]);
    await shown();
    expect(button('Keep this address')).toBeUndefined();
  });

  it('where to go stands there until it ends', async () => {
    await set();
    expect(await shown({ notices: ['the trial has not begun'] })).toContain(whereTo);
    expect(await shown({ network_trial: onTrial })).toContain(whereTo);
    expect(await shown({ network_trial: { ...onTrial, remaining_s: 86 } })).toContain(whereTo);
    expect(await shown()).not.toContain('log in there');
  });

  it('ends also for a page that hears nothing of it', async () => {
    vi.useFakeTimers();
    await set();
    await vi.advanceTimersByTimeAsync(120_000);
    expect(await text()).toContain(whereTo);
    await vi.advanceTimersByTimeAsync(1_000);
    expect(await text()).not.toContain('log in there');
  });
});
