// @vitest-environment-options {"url": "https://cell7.example.org:8443/"}
import { afterEach, beforeEach, expect, it, vi } from 'vitest';
import { FakeCore } from '../../core/tests/fake_core';
import { pc } from '../../core/tests/machine_sample';
import { MachineWatch, type MachineState } from '../../core/machine';
import { sample } from '../../core/tests/sample';
import type { MachineHosts } from '../machine_hosts';
import '../machine_hosts';

const admin = { name: 'panel-1', user: 'adam', role: 'admin', local: true } as const;

let core: FakeCore;
let view: MachineHosts;
let answer: object;
const posted = vi.fn();

async function shown(state: Partial<MachineState> = {}): Promise<string> {
  answer = { ...pc, ...state };
  await MachineWatch.of(core.core).refresh();
  await view.updateComplete;
  return view.shadowRoot!.textContent!.replace(/\s+/g, ' ');
}
const button = (): HTMLButtonElement | null => view.shadowRoot!.querySelector('button');
const field = (): HTMLInputElement => view.shadowRoot!.querySelector('input')!;
async function types(value: string): Promise<void> {
  field().value = value;
  field().dispatchEvent(new Event('input'));
  await view.updateComplete;
}
/** Of the button; empty: it acts. */
function dead(): string {
  const reason = view.shadowRoot!.getElementById(button()!.getAttribute('aria-describedby')!)!.textContent;
  expect(button()!.getAttribute('aria-disabled')).toBe(reason ? 'true' : null);
  return reason;
}

beforeEach(() => {
  posted.mockReset();
  posted.mockImplementation(() => Promise.resolve(new Response('{}')));
  answer = pc;
  vi.stubGlobal('fetch', (path: string, options: RequestInit) =>
    path === '/api/v1/machine' ? Promise.resolve(new Response(JSON.stringify(answer))) : posted(path, options) as Promise<Response>);
  core = new FakeCore(sample);
  core.hasMachine = true;
  core.session = admin;
  view = Object.assign(document.createElement('flexrf-machine-hosts') as MachineHosts, { core: core.core, host: core.host });
  document.body.append(view);
});
afterEach(() => {
  document.body.replaceChildren();
  vi.unstubAllGlobals();
});

it('shows what is declared, and what it is for', async () => {
  const words = await shown({ hosts: ['cell7.example.org', '203.0.113.7'] });
  expect(words).toContain('Other addresses of this PC For a PC behind NAT or a VPN router, or with a name in the company’s DNS');
  expect(words).toContain('Set now: cell7.example.org, 203.0.113.7');
  expect(field().value).toBe('cell7.example.org 203.0.113.7');
  expect(await shown()).toContain('Set now: none');
});

it('is not shown of an older helper, and has nothing to set for who is no admin', async () => {
  core.roleDenied = 'needs admin';
  expect(await shown({ hosts: ['cell7'] })).toContain('Set now: cell7');
  expect(view.shadowRoot!.querySelectorAll('button, input')).toHaveLength(0);
  const { hosts, ...older } = pc;
  answer = older;
  await MachineWatch.of(core.core).refresh();
  await view.updateComplete;
  expect(view.shadowRoot!.querySelector('h3')).toBeNull();
});

it('asks for the password and declares the whole list', async () => {
  await shown({ hosts: ['cell7'] });
  expect(dead()).toBe('they are set so already');
  await types('cell7 https://cell8/');
  expect(dead()).toContain('“https://cell8/” is no host');
  button()!.click();
  expect(core.questions).toEqual([]);
  await types(' Cell7, 203.0.113.7 ');
  expect(dead()).toBe('');
  button()!.click();
  const question = core.questions[0]!;
  expect(question.heading).toBe('Set the other addresses of this PC?');
  expect(question.says).toEqual(['The panel answers at cell7, 203.0.113.7, too, in a second or two.']);
  posted.mockImplementationOnce(() => Promise.resolve(new Response('{"detail":"User or password is wrong."}', { status: 403 })));
  expect(await question.act('wrong')).toBe('User or password is wrong.');
  expect(field().value).toBe(' Cell7, 203.0.113.7 ');
  posted.mockClear();
  answer = { ...pc, hosts: ['cell7', '203.0.113.7'] };
  expect(await question.act('p')).toBe('');
  const [path, { body }] = posted.mock.calls[0] as [string, RequestInit];
  expect([path, JSON.parse(body as string)]).toEqual(['/api/v1/machine/hosts', { password: 'p', hosts: 'cell7 203.0.113.7' }]);
  await vi.waitFor(() => expect(field().value).toBe('cell7 203.0.113.7'));
  expect(dead()).toBe('they are set so already');
});

it('warns whoever opened the page by a host that he takes away', async () => {
  await shown({ hosts: ['cell7.example.org', 'cell8'] });
  await types('cell8');
  button()!.click();
  expect(core.questions[0]!.says[1]).toBe('⚠ You opened this page by cell7.example.org; after this change it no longer answers there.');
  await types('cell7.example.org');
  button()!.click();
  expect(core.questions[1]!.says).toHaveLength(1);
});

it('keeps what was typed while the state goes on and the link is lost for a moment', async () => {
  await shown({ hosts: ['cell7'] });
  await types('cell7 cell8 ');
  await shown({ hosts: ['cell9'] });
  core.roleDenied = 'values are old';
  core.link = { ...core.link, stale: true };
  core.says({});
  await view.updateComplete;
  expect(field().value).toBe('cell7 cell8 ');
  expect(dead()).toBe('values are old');
});
