import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import { FakeCore, quiet } from '../../core/tests/fake_core';
import { data, failure, noUpdate, pc } from '../../core/tests/machine_sample';
import { MachineWatch, type MachineState } from '../../core/machine';
import { sample } from '../../core/tests/sample';
import { partSize } from '../bundle_upload';
import type { Machine } from '../machine';
import '../machine';

const admin = { name: 'panel-1', user: 'adam', role: 'admin', local: true } as const;
const verified = { ...noUpdate, phase: 'verified', version: '20261201T1', application: 'pick-station' } as const;

let core: FakeCore;
let view: Machine;
/** Of the PC's state; the other requests are `fetched`. */
let asked = 0;
let answer: () => Response;
const fetched = vi.fn();

function says(body: object, status = 200): void {
  fetched.mockImplementation(() => Promise.resolve(new Response(JSON.stringify(body), { status })));
}
async function heard(what: () => Response): Promise<string> {
  answer = what;
  await MachineWatch.of(core.core).refresh();
  return text();
}
async function shown(state: Partial<MachineState> = {}): Promise<string> {
  return heard(() => new Response(JSON.stringify({ ...pc, ...state })));
}
async function text(): Promise<string> {
  await view.updateComplete;
  return view.shadowRoot!.textContent!.replace(/\s+/g, ' ');
}
function button(label: string): HTMLButtonElement | undefined {
  return [...view.shadowRoot!.querySelectorAll('button')].find((one) => one.textContent === label);
}
const isDead = (label: string): boolean => button(label)!.getAttribute('aria-disabled') === 'true';
function chooses(file: File): void {
  const input = view.shadowRoot!.querySelector<HTMLInputElement>('input[type=file]')!;
  Object.defineProperty(input, 'files', { value: [file] });
  input.dispatchEvent(new Event('change'));
}
const sentTo = (): unknown[] => (fetched.mock.calls as [string, RequestInit][]).map(([path, options]) =>
  [path, typeof options.body === 'string' ? JSON.parse(options.body) : (options.body as Blob).size]);

beforeEach(() => {
  fetched.mockReset();
  asked = 0;
  answer = () => new Response(JSON.stringify(pc));
  vi.stubGlobal('fetch', (path: string, options: RequestInit) => {
    if (path !== '/api/v1/machine') return fetched(path, options) as Promise<Response>;
    asked += 1;
    return Promise.resolve(answer());
  });
  says({});
  core = new FakeCore(sample);
  core.hasMachine = true;
  core.session = admin;
  view = Object.assign(document.createElement('flexrf-machine') as Machine, { core: core.core, host: core.host });
  document.body.append(view);
});
afterEach(() => {
  document.body.replaceChildren();
  vi.unstubAllGlobals();
});

describe('the view of the PC', () => {
  it('shows what runs and why, and asks often while it is seen', async () => {
    const words = await shown();
    expect(words).toContain('pick-station');
    expect(words).toContain('20261128T001500Z-4fb48992, built');
    expect(words).toContain('Slot A: it is the slot that is meant to start');
    expect(words).toContain('Permitted by this PC.');
    expect(words).not.toContain('development key');
    const before = asked;
    await vi.waitFor(() => expect(asked).toBeGreaterThan(before), { timeout: 3000 });
  });

  it('shows what is not as it should be', async () => {
    const words = await shown({
      boot: 'fallback', confirmed: false, healthy_for_s: 12, motion: 'the version has not confirmed itself',
      development_key: true, notices: ['The copy of the boot choice was mended.'],
    });
    expect(words).toContain('This one stands in for it');
    expect(words).toContain('healthy for 12 of 60 s');
    expect(view.shadowRoot!.querySelector<HTMLProgressElement>('progress')!.value).toBe(12);
    expect(words).toContain('Not permitted: the version has not confirmed itself.');
    expect(words).toContain('anyone can make an update for this PC');
    expect(words).toContain('The copy of the boot choice was mended.');
  });

  it('says why nothing is known, and keeps what was', async () => {
    await shown();
    const gone = (): Response => new Response('{"title":"No","detail":"The PC’s helper is not there."}', { status: 503 });
    expect(await heard(gone)).toContain('How the PC is cannot be told now. The PC’s helper is not there.');
    expect(view.shadowRoot!.querySelector('.stale')!.textContent).toContain('pick-station');
    core.hasMachine = false;
    core.says({});
    expect(await text()).toContain('does not run on a PC of FlexRF');
  });

  it('has no buttons for who is no admin, and says why', async () => {
    core.roleDenied = 'needs admin';
    const words = await shown({ update: verified });
    expect(words).toContain('an admin\'s: needs admin.');
    expect(words).toContain('Uploaded and verified: pick-station 20261201T1: newer than what runs.');
    expect(view.shadowRoot!.querySelectorAll('button, input')).toHaveLength(0);
    core.roleDenied = '';
    core.session = { ...admin, user: '' };
    expect(await shown()).toContain('needs a log-in with a password');
    expect(view.shadowRoot!.querySelectorAll('button, input')).toHaveLength(0);
  });

  it('uploads a file after the password, in parts', async () => {
    await shown();
    expect(isDead('Upload')).toBe(true);
    expect(await text()).toContain('choose a file first');
    chooses(new File([new Uint8Array(partSize + 7)], 'pick-station.raucb'));
    await text();
    button('Upload')!.click();
    const question = core.questions[0]!;
    expect(question.says.join(' ')).toContain('pick-station.raucb, 61 kB');
    says({ detail: 'User or password is wrong.', title: 'Forbidden' }, 403);
    expect(await question.act('wrong')).toBe('User or password is wrong.');
    fetched.mockClear();
    let received = 0;
    fetched.mockImplementation((_: string, { body }: RequestInit) => {
      if (body instanceof Blob) received += body.size;
      return Promise.resolve(new Response(JSON.stringify({ upload: 'ab', received })));
    });
    expect(await question.act('the right one')).toBe('');
    await vi.waitFor(() => expect(received).toBe(partSize + 7));
    expect(sentTo()).toEqual([
      ['/api/v1/machine/upload', { password: 'the right one', size: partSize + 7 }],
      ['/api/v1/machine/bundle?upload=ab&offset=0', partSize],
      [`/api/v1/machine/bundle?upload=ab&offset=${partSize}`, 7],
    ]);
    await vi.waitFor(async () => expect(await text()).toContain('choose a file first')); // for the next one
  });

  it('shows the network', async () => {
    await shown();
    const network = view.shadowRoot!.querySelector('flexrf-machine-network')!;
    expect(network.shadowRoot!.textContent).toContain('enp0s2');
  });

  it('an upload that stopped says where and why, and goes on', async () => {
    await shown();
    chooses(new File([new Uint8Array(10)], 'a.raucb'));
    await text();
    button('Upload')!.click();
    fetched.mockImplementation((path: string) => Promise.resolve(path.endsWith('upload')
      ? new Response('{"upload":"ab"}') : new Response('{"title":"Forbidden","detail":"Log in again."}', { status: 403 })));
    await core.questions[0]!.act('p');
    await vi.waitFor(async () => expect(await text()).toContain('The upload stopped at 0 B of 10 B. Log in again.'));
    fetched.mockImplementation(() => Promise.resolve(new Response('{"received":10}')));
    button('Go on with the upload')!.click();
    await vi.waitFor(async () => expect(await text()).not.toContain('stopped'));
  });

  it('installs what was verified, and says what that does', async () => {
    await shown({ update: verified });
    expect(isDead('Install')).toBe(false);
    button('Install')!.click();
    const question = core.questions[0]!;
    expect(question.says.join(' ')).toMatch(/20261201T1 is written into slot B.*Nothing may move/);
    expect(await question.act('p')).toBe('');
    expect(sentTo()).toEqual([['/api/v1/machine/install', { password: 'p', older: false, other_drivers: false }]]);
  });

  it('other drivers are told, and have to be meant', async () => {
    const words = await shown({ update: { ...verified, driver_changes: [{ device: 'arm', from: 'canopen', to: 'simulated' }] } });
    expect(words).toContain('⚠ It changes drivers: arm from canopen to simulated.');
    button('Install')!.click();
    expect(core.questions[0]!.says.join(' ')).toContain('arm from canopen to simulated');
    expect(core.questions[0]!.action).toBe('Install, with other drivers');
    await core.questions[0]!.act('p');
    expect(sentTo()).toEqual([['/api/v1/machine/install', { password: 'p', older: false, other_drivers: true }]]);
  });

  it('an older version is called so, and another application, too', async () => {
    const words = await shown({ update: { ...verified, older: true, application: 'keyboard' } });
    expect(words).toContain('⚠ older than what runs');
    button('Install the older version')!.click();
    expect(core.questions[0]!.heading).toBe('Install this older version?');
    expect(core.questions[0]!.says.join(' ')).toMatch(/faults that were mended since.*becomes another cell/);
    await core.questions[0]!.act('p');
    expect(sentTo()).toEqual([['/api/v1/machine/install', { password: 'p', older: true, other_drivers: false }]]);
  });

  it('what needs a cell at rest is dead while it may move, and says so', async () => {
    await shown({ update: verified, slots: { ...pc.slots, B: { ...pc.slots.B!, version: '7', whole: true } } });
    core.says({ motion: { ...quiet.motion, may_move: true } });
    const words = await text();
    for (const label of ['Install', 'Start slot B next', 'Restart the PC']) {
      expect(isDead(label)).toBe(true);
      button(label)!.click();
    }
    expect(words).toContain('the cell may move: give Stop motion first');
    expect(core.questions).toEqual([]);
    core.says({});
    await shown({ update: verified, confirmed: false });
    expect(isDead('Install')).toBe(true);
  });

  it('chooses the other slot, and restarts', async () => {
    await shown({ slots: { ...pc.slots, B: { ...pc.slots.B!, version: '7', whole: true } } });
    expect(button('Start slot A next')).toBeUndefined();
    button('Start slot B next')!.click();
    await core.questions[0]!.act('p');
    button('Restart the PC')!.click();
    expect(core.questions[1]!.says.join(' ')).toContain('the whole PC restarts');
    await core.questions[1]!.act('p');
    expect(sentTo()).toEqual([
      ['/api/v1/machine/choose', { password: 'p', slot: 'B', other_drivers: false }], ['/api/v1/machine/restart', { password: 'p' }],
    ]);
  });

  it('tells why the version in the other slot failed, until an admin dismisses it', async () => {
    expect(await shown()).not.toContain('failed');
    expect(view.shadowRoot!.querySelector('details')).toBeNull();
    const words = await shown({ last_failure: failure });
    expect(words).toContain('Why version 20261201T1 in slot B failed');
    expect(words).toContain('Start 3 of 3, begun');
    expect(words).toContain('The panel says: device arm is in fault.');
    expect(view.shadowRoot!.querySelector('pre')!.textContent).toBe(failure.lines.join('\n'));
    // It stays open when the next state arrives.
    view.shadowRoot!.querySelector('details')!.open = true;
    await shown({ last_failure: failure, healthy_for_s: 7 });
    expect(view.shadowRoot!.querySelector('details')!.open).toBe(true);
    button('Dismiss')!.click();
    expect(core.questions[0]!.says.join(' ')).toContain('version 20261201T1 in slot B');
    expect(await core.questions[0]!.act('p')).toBe('');
    expect(sentTo()).toEqual([['/api/v1/machine/dismiss-failure', { password: 'p', slot: 'B' }]]);
    const nothing = { ...failure, starts: 3, start: 0, began: 0, lines: [], reason: 'it stopped before its services ran', why_no_lines: 'No start left a line.' };
    expect(await shown({ last_failure: nothing })).toMatch(/3 starts.*It stopped before its services ran\..*No start left a line\./);
    expect(view.shadowRoot!.querySelector('pre')).toBeNull();
    core.roleDenied = 'needs admin';
    await shown({ last_failure: failure });
    expect(button('Dismiss')).toBeUndefined();
  });

  it('tells what fills the partition for data, and offers to remove old logs', async () => {
    expect(await shown()).not.toContain('Data partition');
    let words = await shown({ data });
    expect(words).toMatch(/Data partition 180 MB of 250 MB used, 32 MB free.*Updates105 MB.*Logs of the PC64 MB/);
    expect(words).not.toContain('Less than 10 %');
    expect(words).not.toContain('of the first');
    button('Remove old logs')!.click();
    expect(core.questions[0]!.says.join(' ')).toMatch(/56 MB of closed log files.*configuration stay/);
    expect(await core.questions[0]!.act('p')).toBe('');
    expect(sentTo()).toEqual([['/api/v1/machine/make-room', { password: 'p', what: 'logs' }]]);
    words = await shown({ data: { ...data, free: 1e6, old_logs: 0, complete: false } });
    expect(words).toContain('⚠ Less than 10 % is free');
    expect(words).toContain('of the first 20 000 files');
    expect(isDead('Remove old logs')).toBe(true);
    expect(words).toContain('there are no old logs');
    core.roleDenied = 'needs admin';
    expect(await shown({ data })).toContain('180 MB of 250 MB');
    expect(button('Remove old logs')).toBeUndefined();
  });

  it('follows an update to its end', async () => {
    expect(await shown({ update: { ...verified, phase: 'receiving', received: 5e6, size: 1e7 } })).toContain('5.0 MB of 10 MB');
    expect(await shown({ update: { ...verified, phase: 'verifying', percent: 40 } })).toContain('checks who signed');
    const words = await shown({ update: { ...verified, phase: 'installing', percent: 40 } });
    expect(words).toContain('is written into slot B: 40 %');
    expect(button('Upload')).toBeUndefined();
    expect(isDead('Restart the PC')).toBe(true);
    expect(await shown({ update: { ...verified, phase: 'installed' } })).toContain('starts with the next restart');
    expect(isDead('Restart now')).toBe(false);
    expect(await shown({ update: { ...noUpdate, phase: 'failed', why: 'It is signed by nobody that this PC knows.' } })).toContain(
      '✕ The update failed: It is signed by nobody that this PC knows.');
  });
});
