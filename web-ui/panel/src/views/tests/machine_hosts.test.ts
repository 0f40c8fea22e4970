// @vitest-environment-options {"url": "https://cell7.example.org:8443/"}
import { expect, it, vi } from 'vitest';
import { pc } from '../../core/tests/machine_sample';
import type { MachineHosts } from '../machine_hosts';
import '../machine_hosts';
import { PartSetup } from './machine_part_setup';

const part = new PartSetup<MachineHosts>('flexrf-machine-hosts');
const { posted } = part;

const shown = part.shown.bind(part);
const button = (): HTMLButtonElement | null => part.view.shadowRoot!.querySelector('button');
const field = (): HTMLInputElement => part.view.shadowRoot!.querySelector('input')!;
const types = (value: string): Promise<void> => part.types(field(), value);
const dead = (): string => part.reasonOf(button()!);

it('shows what is declared, and what it is for', async () => {
  const words = await shown({ hosts: ['cell7.example.org', '203.0.113.7'] });
  expect(words).toContain('Other addresses of this PC For a PC behind NAT or a VPN router, or with a name in the company’s DNS');
  expect(words).toContain('Set now: cell7.example.org, 203.0.113.7');
  expect(field().value).toBe('cell7.example.org 203.0.113.7');
  expect(await shown()).toContain('Set now: none');
});

it('is not shown of an older helper, and has nothing to set for who is no admin', async () => {
  part.core.roleDenied = 'needs admin';
  expect(await shown({ hosts: ['cell7'] })).toContain('Set now: cell7');
  expect(part.view.shadowRoot!.querySelectorAll('button, input')).toHaveLength(0);
  const { hosts, ...older } = pc;
  await part.told(older);
  expect(part.view.shadowRoot!.querySelector('h3')).toBeNull();
});

it('asks for the password and declares the whole list', async () => {
  await shown({ hosts: ['cell7'] });
  expect(dead()).toBe('they are set so already');
  await types('cell7 https://cell8/');
  expect(dead()).toContain('“https://cell8/” is no host');
  button()!.click();
  expect(part.core.questions).toEqual([]);
  await types(' Cell7, 203.0.113.7 ');
  expect(dead()).toBe('');
  button()!.click();
  const question = part.core.questions[0]!;
  expect(question.heading).toBe('Set the other addresses of this PC?');
  expect(question.says).toEqual(['The panel answers at cell7, 203.0.113.7, too, in a second or two.']);
  posted.mockImplementationOnce(() => Promise.resolve(new Response('{"detail":"User or password is wrong."}', { status: 403 })));
  expect(await question.act('wrong')).toBe('User or password is wrong.');
  expect(field().value).toBe(' Cell7, 203.0.113.7 ');
  posted.mockClear();
  part.answer = { ...pc, hosts: ['cell7', '203.0.113.7'] };
  expect(await question.act('p')).toBe('');
  const [path, { body }] = posted.mock.calls[0] as [string, RequestInit];
  expect([path, JSON.parse(body as string)]).toEqual(['/api/v1/machine/hosts', { password: 'p', hosts: 'cell7 203.0.113.7' }]);
  await vi.waitFor(() => expect(field().value).toBe('cell7 203.0.113.7'));
  expect(dead()).toBe('they are set so already');
});

it('warns an admin who removes the host by which this page was opened', async () => {
  await shown({ hosts: ['cell7.example.org', 'cell8'] });
  await types('cell8');
  button()!.click();
  expect(part.core.questions[0]!.says[1]).toBe('⚠ You opened this page by cell7.example.org; after this change it no longer answers there.');
  await types('cell7.example.org');
  button()!.click();
  expect(part.core.questions[1]!.says).toHaveLength(1);
});

it('keeps what was typed while the state goes on and the link is lost for a moment', async () => {
  await shown({ hosts: ['cell7'] });
  await types('cell7 cell8 ');
  await shown({ hosts: ['cell9'] });
  part.core.roleDenied = 'values are old';
  part.core.link = { ...part.core.link, stale: true };
  part.core.says({});
  await part.view.updateComplete;
  expect(field().value).toBe('cell7 cell8 ');
  expect(dead()).toBe('values are old');
});
