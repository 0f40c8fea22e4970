// An industrial PC at its panel: what runs on it, an update from the file to the restart, and what comes in between.
import { spawn, type ChildProcess } from 'node:child_process';
import { existsSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, it, onTestFinished } from 'vitest';
import {
  Application, Cable, Viewer, newFolder, playedPc, screenshot, sizes, tidyUp, useBrowser, violations, within, type User,
} from './harness';

const adam: User = { name: 'adam', role: 'admin', password: 'a long password of adam' };
const vera: User = { name: 'vera', role: 'viewer', password: 'a long password of vera' };
const newVersion = '20261201T080000Z-0a1b2c3d';

const browser = useBrowser();

/** The helper of a PC, as a process of its own. */
class PlayedPc {
  readonly socket = join(newFolder(), 'socket');
  said = '';
  #process!: ChildProcess;
  #ended!: Promise<unknown>;

  static async start(): Promise<PlayedPc> {
    const pc = new PlayedPc();
    await pc.begin();
    onTestFinished(() => pc.end());
    return pc;
  }
  async begin(): Promise<void> {
    this.#process = spawn(playedPc, [this.socket, adam.password], { stdio: ['pipe', 'pipe', 'inherit'] });
    this.#process.stdin!.on('error', () => undefined);
    this.#process.stdout!.on('data', (part: Buffer) => { this.said += part.toString('utf8'); });
    this.#ended = new Promise((resolve) => this.#process.once('close', resolve));
    await expect.poll(() => existsSync(this.socket) && this.said.includes('ready'), { timeout: within }).toBe(true);
    this.said = '';
  }
  /** Its state has these members from now on. */
  change(members: object): void {
    this.#process.stdin!.write(`${JSON.stringify(members)}\n`);
  }
  pause(): void {
    this.#process.kill('SIGSTOP');
  }
  goOn(): void {
    this.#process.kill('SIGCONT');
  }
  async end(): Promise<void> {
    this.goOn();
    this.#process.kill('SIGKILL');
    await this.#ended;
  }
}

async function start(pc: PlayedPc, more: readonly string[] = []): Promise<Application> {
  const running = await Application.start('panel_cell', { users: [adam, vera], arguments: ['--helper', pc.socket, '--audit', 'audit', ...more] });
  onTestFinished(() => running.end());
  return running;
}

async function open(address: string, user: User): Promise<Viewer> {
  const viewer = await Viewer.open(browser(), address);
  onTestFinished(() => viewer.close());
  viewer.allow(/401|WebSocket/); // before the log-in
  await viewer.logIn(user);
  return viewer;
}

function bundle(size: number): string {
  const file = join(newFolder(), 'pick-station.raucb');
  writeFileSync(file, Buffer.alloc(size, 'update'));
  return file;
}

async function answer(viewer: Viewer, action: string, password = adam.password): Promise<void> {
  const dialog = viewer.page.locator('flexrf-password');
  await dialog.getByLabel('Password of adam').fill(password);
  await dialog.getByRole('button', { name: action, exact: true }).click();
}

async function upload(viewer: Viewer, size: number): Promise<void> {
  await viewer.page.getByLabel('File of an update').setInputFiles(bundle(size));
  await viewer.page.getByRole('button', { name: 'Upload', exact: true }).click();
  await answer(viewer, 'Upload');
}

it('an admin brings an update to the PC, installs it and restarts', async () => {
  const pc = await PlayedPc.start();
  const running = await start(pc);
  const viewer = await open(running.base, adam);
  const { page } = viewer;
  await page.getByRole('link', { name: 'Machine', exact: true }).click();
  await page.getByText('Slot A: it is the slot that is meant to start').waitFor();
  await screenshot(page, 'machine');
  expect(await violations(page)).toEqual([]);

  viewer.allow(/403/); // the wrong password
  await page.getByLabel('File of an update').setInputFiles(bundle(500_000));
  await page.getByRole('button', { name: 'Upload', exact: true }).click();
  await answer(viewer, 'Upload', 'a wrong password');
  await page.getByText('User or password is wrong.').waitFor();
  await screenshot(page, 'machine-password');
  expect(await violations(page)).toEqual([]);
  await answer(viewer, 'Upload');
  await page.getByText(`Uploaded and verified: pick-station ${newVersion}: newer than what runs.`).waitFor();
  await screenshot(page, 'machine-verified');
  expect(pc.said).toContain('"offset":491520'); // in parts of 60 KiB

  await page.getByRole('button', { name: 'Install', exact: true }).click();
  await page.getByText('is written into slot B; what is there now is lost').waitFor();
  await screenshot(page, 'machine-install');
  await answer(viewer, 'Install');
  await page.getByText('is written into slot B: ').waitFor();
  await screenshot(page, 'machine-installing');
  expect(await violations(page)).toEqual([]);
  await page.getByText(`Version ${newVersion} is installed. It starts with the next restart`).waitFor();
  await screenshot(page, 'machine-installed');

  await page.getByRole('button', { name: 'Restart now' }).click();
  await answer(viewer, 'Restart now');
  await page.getByText('Slot B: its version is new and on trial.').waitFor();
  pc.change({ healthy_for_s: 12, motion: 'the version that runs has not confirmed itself' });
  await page.getByText('Not yet: healthy for 12 of 60 s.').waitFor();
  await page.getByText('Not permitted: the version that runs has not confirmed itself.').waitFor();
  await screenshot(page, 'machine-trial');
  expect(await violations(page)).toEqual([]);

  expect(pc.said).toMatch(/"older":false.*"verb":"install"/);
  const file = () => readFileSync(join(running.folder, 'audit'), 'utf8');
  await expect.poll(file, { timeout: within }).toContain('restarted the PC');
  expect(file()).toMatch(/"who":"adam \(127\.0\.0\.1\)","did":"began to upload an update","what":"\(500000 bytes\)"/);
  expect(file()).toMatch(/"did":"began to install","what":"pick-station 20261201T080000Z-0a1b2c3d"/);
  expect(file()).toContain('"did":"was not allowed to","what":"upload an update"');
  for (const text of [file(), running.text]) expect(text).not.toMatch(/a (long|wrong) password/);
});

it('an admin sets the address of the PC on trial, and keeps it', async () => {
  const pc = await PlayedPc.start();
  const running = await start(pc);
  const viewer = await open(running.base, adam);
  const { page } = viewer;
  await viewer.go('machine');
  await page.getByRole('row', { name: /^enp0s2 .*connected 192\.168\.1\.17\/24 as this version says$/ }).waitFor();
  await page.getByRole('row', { name: /^enp3s0 .*no cable none fixed: 10\.0\.0\.1\/24, no gateway$/ }).waitFor();
  await page.getByLabel('Its address').selectOption('Fixed');
  const address = page.getByLabel('Address and network');
  await address.fill('192.168.1.300/24');
  await page.getByText('type an address as 192.168.1.10/24').waitFor();
  await address.fill('192.168.1.10/24');
  await page.getByLabel('Gateway').fill('192.168.2.1');
  await page.getByText('the gateway is in another network than the address').waitFor();
  await page.getByLabel('Gateway').fill('192.168.1.1');
  pc.change({ healthy_for_s: 61 }); // what is typed outlives a new state
  await screenshot(page, 'machine-address');
  expect(await violations(page)).toEqual([]);
  expect(await address.inputValue()).toBe('192.168.1.10/24');

  await page.getByLabel('Gateway').press('Enter');
  await page.getByText('The address of enp0s2 becomes 192.168.1.10/24, gateway 192.168.1.1, a second after this.').waitFor();
  await screenshot(page, 'machine-address-asked');
  await answer(viewer, 'Set the address');
  await page.getByRole('link', { name: /192\.168\.1\.10/ }).waitFor();
  await page.getByRole('region', { name: 'Warnings' }).getByText('The address of enp0s2 is on trial: it is taken back in 120 s').waitFor();
  pc.change({ network_trial: { remaining_s: 87 } });
  await page.getByText('the former one returns in 87 s unless it is kept.').waitFor();
  await page.setViewportSize(sizes.phone);
  await screenshot(page, 'machine-address-trial');
  expect(await violations(page)).toEqual([]);
  expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);

  await page.getByRole('button', { name: 'Keep this address' }).click();
  await answer(viewer, 'Keep this address');
  await expect.poll(() => page.getByText('is on trial').count(), { timeout: within }).toBe(0);
  expect(pc.said).toMatch(/"address":"192\.168\.1\.10\/24","gateway":"192\.168\.1\.1","interface":"enp0s2".*"verb":"network"/);
  expect(pc.said).toContain('"verb":"keep-network"');
});

it('after a fallback an admin reads why the version failed, and dismisses it', async () => {
  const pc = await PlayedPc.start();
  const running = await start(pc);
  pc.change({
    boot: 'fallback', confirmed: true,
    notices: [`slot B, version ${newVersion}, was started three times and did not come up; version 20261128T001500Z-4fb48992 in slot A runs in its place`],
    slots: { B: { version: newVersion, whole: true } },
    last_failure: {
      slot: 'B', version: newVersion, starts: 3, start: 3, began: 1796112012,
      reason: 'it was not well for long enough within 10 min, and gave up its turn; at last: the panel says: device arm is in fault: node 5 is not heard',
      lines: Array.from({ length: 20 }, (_, i) => `[  ${(31.25 + i * 0.5).toFixed(6)}] pick-station[312]: [error] arm: node 5 does not answer the SDO request 0x6041:00 in ${i + 1} tries; check its cable and its bit rate`),
      why_no_lines: '',
    },
  });
  const viewer = await open(running.base, adam);
  const { page } = viewer;
  await viewer.go('machine');
  const block = page.getByText(`Why version ${newVersion} in slot B failed`);
  await block.waitFor();
  expect(await page.getByText('node 5 does not answer').isVisible()).toBe(false);
  await block.click();
  await page.getByText('Start 3 of 3, begun').waitFor();
  await page.getByText('node 5 does not answer').waitFor();
  await screenshot(page, 'machine-failure');
  expect(await violations(page)).toEqual([]);
  await page.setViewportSize(sizes.phone);
  await screenshot(page, 'machine-failure-phone');
  expect(await violations(page)).toEqual([]);
  expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
  await page.getByRole('button', { name: 'Dismiss', exact: true }).click();
  await answer(viewer, 'Dismiss');
  await expect.poll(() => block.count(), { timeout: within }).toBe(0);
  expect(pc.said).toMatch(/"slot":"B".*"verb":"dismiss-failure"/);
});

it('on a full disk an admin sees what fills it, and removes the old logs', async () => {
  const pc = await PlayedPc.start();
  const running = await start(pc);
  pc.change({ data: { used: 193_000_000, free: 7_000_000 } });
  const viewer = await open(running.base, adam);
  const { page } = viewer;
  await viewer.go('machine');
  await page.getByText('193 MB of 250 MB used, 7.0 MB free for the application.').waitFor();
  await page.getByText('Less than 10 % is free for the application.').waitFor();
  await page.getByRole('row', { name: 'Logs of the PC 64 MB' }).waitFor();
  await screenshot(page, 'machine-data');
  expect(await violations(page)).toEqual([]);
  await page.setViewportSize(sizes.phone);
  await page.getByRole('button', { name: 'Remove old logs' }).scrollIntoViewIfNeeded();
  await screenshot(page, 'machine-data-phone');
  expect(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)).toBeLessThanOrEqual(0);
  await page.getByRole('button', { name: 'Remove old logs' }).click();
  await page.getByText('56 MB of closed log files of this PC are removed').waitFor();
  await answer(viewer, 'Remove old logs');
  await page.getByText('137 MB of 250 MB used, 63 MB free for the application.').waitFor();
  await page.getByText('there are no old logs').waitFor();
  expect(pc.said).toMatch(/"verb":"make-room","what":"logs"/);
});

it('an admin declares the other addresses of the PC, and is warned before he locks himself out', async () => {
  const pc = await PlayedPc.start();
  const running = await start(pc);
  const viewer = await open(running.base, adam);
  const { page } = viewer;
  await viewer.go('machine');
  await page.getByText('Set now: none').waitFor();
  const hosts = page.getByLabel('Names and IPv4 addresses');
  await hosts.fill('cell7.example.org https://203.0.113.7/');
  await page.getByText('“https://203.0.113.7/” is no host').waitFor();
  await hosts.fill('cell7.example.org 203.0.113.7');
  pc.change({ moves: true }); // it moves nothing
  const set = page.getByRole('button', { name: 'Set other addresses' });
  await set.scrollIntoViewIfNeeded();
  await screenshot(page, 'machine-hosts');
  expect(await violations(page)).toEqual([]);
  await hosts.press('Enter');
  await page.getByText('The panel answers at cell7.example.org, 203.0.113.7, too, in a second or two.').waitFor();
  await answer(viewer, 'Set other addresses');
  await page.getByText('Set now: cell7.example.org, 203.0.113.7').waitFor();
  expect(pc.said).toMatch(/"hosts":"cell7\.example\.org 203\.0\.113\.7".*"verb":"hosts"/);

  // As if this page was opened by a declared address.
  pc.change({ hosts: ['127.0.0.1'] });
  await page.getByText('Set now: 127.0.0.1').waitFor();
  await hosts.fill('');
  await page.setViewportSize(sizes.phone);
  await set.scrollIntoViewIfNeeded();
  await screenshot(page, 'machine-hosts-phone');
  const { x, width } = (await hosts.boundingBox())!;
  expect(x).toBeGreaterThanOrEqual(0);
  expect(x + width).toBeLessThanOrEqual(sizes.phone.width);
  await hosts.press('Enter');
  await page.getByText('You opened this page by 127.0.0.1; after this change it no longer answers there.').waitFor();
  await screenshot(page, 'machine-hosts-asked');
  expect(await violations(page)).toEqual([]);
  const file = () => readFileSync(join(running.folder, 'audit'), 'utf8');
  await expect.poll(file, { timeout: within }).toContain('"did":"declared as other addresses of the PC","what":"cell7.example.org 203.0.113.7"');
});

it('the panel answers to the hosts that a file declares, as the file is now, and to no other', async () => {
  const pc = await PlayedPc.start();
  const file = join(newFolder(), 'panel-hosts');
  const running = await start(pc, ['--panel-hosts', file]);
  const asked = async (host: string): Promise<number> => (await running.rest().ask('/', { headers: { host } })).status;
  expect(await asked('cell7.example.org')).toBe(421);
  writeFileSync(file, 'cell7.example.org\nhttps://cell7/\n203.0.113.7\n');
  await expect.poll(() => asked('Cell7.example.org:8443'), { timeout: within }).toBe(200);
  expect(await asked('203.0.113.7')).toBe(200);
  for (const host of ['203.0.113.8', 'evil.example', 'cell7.example.org.evil.example']) expect(await asked(host), host).toBe(421);
  expect(running.text).toContain(`${file}:2: 'https://cell7/' is no host`);
  rmSync(file);
  await expect.poll(() => asked('cell7.example.org'), { timeout: within }).toBe(421);
  expect(await asked(`127.0.0.1:${running.port}`)).toBe(200);

  writeFileSync(file, '203.0.113.7\n');
  const again = await start(pc, ['--panel-hosts', file]); // read before the panel listens
  expect((await again.rest().ask('/', { headers: { host: '203.0.113.7' } })).status).toBe(200);
});

it('what lasts is said in every view, and who is no admin has no buttons', async () => {
  const pc = await PlayedPc.start();
  const running = await start(pc);
  pc.change({ development_key: true, confirmed: false, healthy_for_s: 5, boot: 'fallback', notices: ['A copy of the boot choice was damaged, and is written anew.'] });
  const viewer = await open(running.base, vera);
  const { page } = viewer;
  const warnings = page.getByRole('region', { name: 'Warnings' });
  await warnings.getByText('Signed with the development key: anyone can make an update for this PC').waitFor();
  await warnings.getByText('has not confirmed itself: healthy for 5 of 60 s').waitFor();
  await screenshot(page, 'machine-lines');
  expect(await violations(page)).toEqual([]);
  await warnings.getByRole('link').first().click();
  await page.getByText('An update, a choice of the slot, an address and a restart are an admin\'s: needs admin.').waitFor();
  await page.getByText('A copy of the boot choice was damaged').waitFor();
  expect(await page.locator('flexrf-machine button, flexrf-machine input').count()).toBe(0);
  expect(await violations(page)).toEqual([]);
  await page.setViewportSize(sizes.phone);
  await screenshot(page, 'machine-viewer');
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  expect(wide).toBeLessThanOrEqual(0);

  const rest = await running.loggedIn(vera);
  expect((await rest.ask('machine')).body.development_key).toBe(true);
  expect((await rest.ask('machine/restart', { body: { password: adam.password } })).status).toBe(403);
  expect(pc.said).toBe('');
});

it('an upload goes on after the line was cut, and after the helper was started anew it says that it cannot', async () => {
  const pc = await PlayedPc.start();
  const running = await start(pc);
  const cable = await Cable.to(running.port);
  onTestFinished(() => cable.close());
  const viewer = await open(cable.base, adam);
  viewer.allow(/ERR_|WebSocket|404|503/); // the line, and the helper
  const { page } = viewer;
  await viewer.go('machine');
  await upload(viewer, 20_000_000);
  await page.getByText(/^Uploading: [1-9]/).waitFor();
  cable.drop();
  await page.getByText(`Uploaded and verified: pick-station ${newVersion}`).waitFor();
  expect(pc.said).toContain('"offset":19968000');

  await upload(viewer, 20_000_000);
  await page.getByText(/^Uploading: [1-9]/).waitFor();
  await screenshot(page, 'machine-uploading');
  await pc.end();
  await pc.begin();
  await page.getByText('There is no such upload: begin anew.').waitFor();
  await screenshot(page, 'machine-upload-failed');
  expect(await violations(page)).toEqual([]);
  // From the beginning it goes.
  await upload(viewer, 100_000);
  await page.getByText('Uploaded and verified').waitFor();
});

it('an update that is refused, one that is older, and a cell that may move', async () => {
  const pc = await PlayedPc.start();
  const running = await start(pc);
  const viewer = await open(running.base, adam);
  viewer.allow(/409/);
  const { page } = viewer;
  await viewer.go('machine');
  pc.change({ bad: 'It is signed by nobody whom this PC knows.' });
  await upload(viewer, 1000);
  await page.getByText('The update failed: It is signed by nobody whom this PC knows.').waitFor();
  pc.change({ bad: null, verified: { version: '20260101T000000Z-00000000', older: true }, moves: true });
  await upload(viewer, 1000);
  await page.getByText('⚠ older than what runs').waitFor();
  await page.getByRole('button', { name: 'Install the older version' }).click();
  await page.getByText('faults that were mended since may come back').waitFor();
  await answer(viewer, 'Install the older version');
  await page.getByText('The cell may move: give Stop motion first.').waitFor();
  await screenshot(page, 'machine-older');
  expect(await violations(page)).toEqual([]);
  // Stop motion lies under nothing.
  await page.getByRole('button', { name: 'Stop motion' }).click();
  pc.change({ moves: null });
  await answer(viewer, 'Install the older version');
  await page.getByText('is installed. It starts with the next restart').waitFor();
  expect(pc.said).toContain('"older":true');
  // What the other slot holds can be chosen back.
  await page.getByRole('button', { name: 'Start slot A next' }).click();
  await answer(viewer, 'Start slot A next');
  await page.getByRole('row', { name: /^A .*runs, starts next/ }).waitFor();
});

it('a helper that hangs or is gone is told, and nothing else waits for it', async () => {
  const pc = await PlayedPc.start();
  const running = await start(pc);
  const viewer = await open(running.base, adam);
  viewer.allow(/503/);
  const { page } = viewer;
  await viewer.go('machine');
  await page.getByText('Permitted by this PC.').waitFor();
  pc.pause();
  const rest = await running.loggedIn(adam);
  let isAnswered = false;
  const asked = rest.ask('machine').finally(() => { isAnswered = true; });
  for (let i = 0; i < 50; ++i) await rest.do('state');
  expect(isAnswered).toBe(false);
  pc.goOn();
  expect((await asked).status).toBe(200);
  await pc.end();
  await page.getByText('How the PC is cannot be told now.').waitFor();
  await screenshot(page, 'machine-gone');
  expect(await violations(page)).toEqual([]);
  await pc.begin();
  await expect.poll(() => page.getByText('How the PC is cannot be told now.').count(), { timeout: within }).toBe(0);
});

it('without a helper there is no such view, and bytes are nobody else\'s', async () => {
  const running = await Application.start('panel_cell', { users: [adam] });
  onTestFinished(() => running.end());
  const viewer = await open(running.base, adam);
  await viewer.page.getByRole('link', { name: 'Audit' }).waitFor();
  expect(await viewer.page.getByRole('link', { name: 'Machine', exact: true }).count()).toBe(0);
  await tidyUp(() => viewer.check());
  const rest = await running.loggedIn(adam);
  expect((await rest.ask('machine')).status).toBe(404);
  const headers = { 'content-type': 'application/octet-stream' };
  for (const path of ['control/take', 'stop-motion', 'save-values', 'logout', 'login'])
    expect((await rest.ask(path, { body: {}, headers })).status, path).toBe(415);
  expect((await rest.ask('machine/bundle?upload=00112233445566778899aabbccddeeff&offset=0', { method: 'PUT', body: {}, headers })).status).toBe(404);
  const foreign = { 'content-type': 'application/octet-stream', origin: 'http://elsewhere.example' };
  expect((await rest.ask('machine/bundle?upload=00112233445566778899aabbccddeeff&offset=0', { method: 'PUT', body: {}, headers: foreign })).status).toBe(403);
});
