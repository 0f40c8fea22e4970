// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { wired } from '../../core/tests/machine_sample';
import { addressFault, addressesText, choiceOf, consequences, faultOf, pageAt, settingSentence, trialSentence } from '../network_words';

const fixed = { interface: 'enp0s2', setting: 'fixed', address: '192.168.1.10/24', gateway: '192.168.1.1' } as const;
const dhcp = { ...fixed, setting: 'dhcp' } as const;

it('says what decides an address', () => {
  expect(settingSentence(wired)).toBe('as this version says');
  expect(settingSentence({ ...wired, setting: 'dhcp' })).toBe('by DHCP');
  expect(settingSentence({ ...wired, ...fixed })).toBe('fixed: 192.168.1.10/24, gateway 192.168.1.1');
  expect(settingSentence({ ...wired, ...fixed, gateway: '' })).toBe('fixed: 192.168.1.10/24, no gateway');
});

it('says which addresses there are, and which one nobody gave', () => {
  expect(addressesText({ ...wired, addresses: [] })).toBe('none');
  expect(addressesText({ ...wired, addresses: ['10.0.2.15/24', '169.254.7.8/16'] })).toBe('10.0.2.15/24, 169.254.7.8/16 (link-local)');
});

it('says how long a trial lasts', () => {
  expect(trialSentence({ interface: 'enp0s2', remaining_s: 87 })).toBe(
    'The address of enp0s2 is on trial: the former one returns in 87 s unless it is kept.');
});

it('knows where the page is found at a fixed address', () => {
  expect(pageAt(fixed, { protocol: 'https:', port: '8443' })).toBe('https://192.168.1.10:8443/');
  expect(pageAt(fixed, { protocol: 'https:', port: '' })).toBe('https://192.168.1.10/');
  expect(pageAt(dhcp, { protocol: 'https:', port: '8443' })).toBe('');
});

describe('what will happen', () => {
  const page = 'https://192.168.1.10:8443/';
  it('at a fixed address', () => {
    expect(consequences(wired, fixed, page)).toEqual([
      'The address of enp0s2 becomes 192.168.1.10/24, gateway 192.168.1.1, a second after this.',
      'This page may lose the PC by it. Then open https://192.168.1.10:8443/, log in there and press Keep this address within two minutes. '
        + 'Else the former address returns by itself.',
    ]);
  });
  it('by DHCP, where the PC cannot be asked for the address', () => {
    const [becomes, lost] = consequences(wired, dhcp, '');
    expect(becomes).toMatch(/asks for its address by DHCP.*comes from the DHCP server: the PC’s screen tells it.*52:54:00:12:34:56/);
    expect(lost).toContain('Then open the page at that address, log in there');
    expect(consequences(wired, choiceOf(wired), '')[0]).toContain('as this version says, mostly by DHCP');
  });
});

describe('the check of addresses', () => {
  it('takes those of a network', () => {
    for (const [address, gateway] of [
      ['192.168.1.10/24', ''], ['192.168.1.10/24', '192.168.1.254'], ['10.0.0.1/8', '10.255.0.1'], ['255.1.1.1/30', '255.1.1.2'],
    ] as const) expect(addressFault(address, gateway)).toBe('');
  });
  it('says what is none', () => {
    for (const address of ['', '192.168.1.10', '192.168.1/24', '192.168.1.256/24', '192.168.01.10/24', '192.168.1.10/', '192.168.1.10/024', '::1/24', '1.2.3.4.5/24', 'a.b.c.d/8', '1..2.3/8']) {
      expect(addressFault(address, '')).toBe('type an address as 192.168.1.10/24');
    }
    for (const address of ['192.168.1.10/7', '192.168.1.10/31', '192.168.1.10/99']) {
      expect(addressFault(address, '')).toBe('after the / comes a number from 8 to 30');
    }
    for (const address of ['192.168.1.0/24', '192.168.1.255/24', '192.168.1.4/30', '192.168.1.7/30']) {
      expect(addressFault(address, '')).toBe('the first and the last address of a network are those of no PC');
    }
  });
  it('says what is no gateway of it', () => {
    expect(addressFault('192.168.1.10/24', '192.168.1')).toBe('type a gateway as 192.168.1.1, or none');
    expect(addressFault('192.168.1.10/24', '192.168.1.1/24')).toBe('type a gateway as 192.168.1.1, or none');
    expect(addressFault('192.168.1.10/24', '192.168.2.1')).toBe('the gateway is in another network than the address');
    expect(addressFault('192.168.1.10/24', '192.168.1.10')).toBe('the gateway is another one than the PC');
  });
});

describe('why a choice cannot be set', () => {
  it('says what is on trial, what is wrong and what is so already', () => {
    expect(faultOf(wired, fixed, undefined)).toBe('');
    expect(faultOf(wired, { ...fixed, address: '192.168.1.10' }, undefined)).toContain('type an address');
    expect(faultOf(wired, fixed, { interface: 'enp3s0', remaining_s: 5 })).toBe('the address of enp3s0 is on trial: keep it first, or wait');
    expect(faultOf(wired, fixed, { interface: 'enp0s2', remaining_s: 5 })).toBe('');
    expect(faultOf(wired, choiceOf(wired), undefined)).toBe('it is set so already');
    expect(faultOf({ ...wired, ...fixed }, fixed, undefined)).toBe('it is set so already');
    expect(faultOf({ ...wired, ...fixed }, { ...fixed, gateway: '' }, undefined)).toBe('');
  });
  it('what is typed counts for a fixed address only', () => {
    expect(faultOf(wired, { ...dhcp, address: '192' }, undefined)).toBe('');
    expect(faultOf({ ...wired, setting: 'dhcp' }, dhcp, undefined)).toBe('it is set so already');
  });
});
