// @vitest-environment node
import { describe, expect, it } from 'vitest';
import { pc } from '../../core/tests/machine_sample';
import { hostsConsequences, hostsFault, hostsIn, hostsText } from '../hosts_words';

it('takes what is typed apart, each host once', () => {
  expect(hostsIn('  Cell7.example.org 203.0.113.7,cell8\n CELL8 ')).toEqual(['cell7.example.org', '203.0.113.7', 'cell8']);
  expect(hostsIn(' ')).toEqual([]);
  expect(hostsText(['cell7', '203.0.113.7'])).toBe('cell7, 203.0.113.7');
  expect(hostsText([])).toBe('none');
});

describe('the check of hosts', () => {
  it('takes names and IPv4 addresses', () => {
    for (const host of ['cell7', 'cell-7.example.org', 'a_b', '7.example.org', '203.0.113.7', 'a'.repeat(63)]) expect(hostsFault([], [host])).toBe('');
    expect(hostsFault(['cell7'], [])).toBe('');
  });
  it('names what is none', () => {
    for (const host of ['https://cell7/', 'cell7:8443', '203.0.113.7:8443', '203.0.113', '203.0.113.256', 'cell.7', '.x', 'x.', 'a..b', '*.example.org', 'fd00::7', 'zelle-ä', 'a'.repeat(254)]) {
      expect(hostsFault([], ['cell7', host])).toMatch(`“${host}” is no host: type a name as cell7.example.org`);
    }
  });
  it('takes eight at most, and only what changes something', () => {
    const eight = ['a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'];
    expect(hostsFault([], eight)).toBe('');
    expect(hostsFault([], [...eight, 'i'])).toBe('at most 8 can be set');
    expect(hostsFault(['b', 'a'], ['a', 'b'])).toBe('they are set so already');
    expect(hostsFault(['a', 'b'], ['a', 'c'])).toBe('');
  });
});

describe('what will happen', () => {
  const declared = { ...pc, hosts: ['cell7.example.org', '203.0.113.7'] };
  it('tells where the panel answers, and where no longer', () => {
    expect(hostsConsequences(pc, ['cell7', '203.0.113.7'], 'cell7')).toEqual(['The panel answers at cell7, 203.0.113.7, too, in a second or two.']);
    expect(hostsConsequences(declared, ['cell7.example.org'], 'cell7.example.org')).toEqual([
      'The panel answers at cell7.example.org, too, in a second or two. It no longer answers at 203.0.113.7.',
    ]);
    expect(hostsConsequences(declared, [], '10.0.2.15')).toEqual([
      'The panel answers at this PC’s own addresses and names only, in a second or two. It no longer answers at cell7.example.org, 203.0.113.7.',
    ]);
  });
  it('warns an admin whose own address would be removed', () => {
    expect(hostsConsequences(declared, ['203.0.113.7'], 'cell7.example.org')[1]).toBe(
      '⚠ You opened this page by cell7.example.org; after this change it no longer answers there.');
    // The PC's own address needs no declaration.
    expect(hostsConsequences({ ...declared, hosts: ['10.0.2.15'] }, [], '10.0.2.15')).toHaveLength(1);
    expect(hostsConsequences({ ...declared, hosts: ['10.0.2.1'] }, [], '10.0.2.1')).toHaveLength(2);
  });
});
