// A PC that nobody has claimed, in a browser: the code on its console, the first password, and the panel after it.
import { spawn, spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { request } from 'node:https';
import { connect } from 'node:net';
import { join } from 'node:path';
import { expect, it, onTestFinished } from 'vitest';
import { Application, build, newFolder, playedPc, screenshot, sizes, tidyUp, useBrowser, violations, within } from './harness';

const browser = useBrowser();
const password = 'a long password of anna';

/** What a first boot leaves: a key, a certificate, and nobody who may log in. */
function newPc(): { folder: string; encryption: string[] } {
  const folder = newFolder();
  const [key, certificate] = [join(folder, 'key.pem'), join(folder, 'certificate.pem')];
  const made = spawnSync('openssl', ['req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-days', '1',
    '-keyout', key, '-out', certificate, '-subj', '/CN=cell']);
  expect(made.status).toBe(0);
  return { folder, encryption: ['--tls-certificate', certificate, '--tls-key', key] };
}

/** The page's answer to somebody who reaches the PC by this host, from this address. */
function asked(port: string, host: string, path: string, form?: URLSearchParams, localAddress = '127.0.0.1'): Promise<{ status: number; text: string }> {
  return new Promise((resolve, reject) => {
    const one = request({
      host: '127.0.0.1', port, path, method: form ? 'POST' : 'GET', rejectUnauthorized: false, agent: false, localAddress, timeout: 30_000,
      headers: { host, ...(form && { 'content-type': 'application/x-www-form-urlencoded', 'content-length': form.toString().length }) },
    }, (incoming) => {
      let text = '';
      incoming.on('data', (part: Buffer) => { text += part.toString('utf8'); });
      incoming.on('error', reject);
      incoming.on('end', () => resolve({ status: incoming.statusCode ?? 0, text }));
    });
    one.on('error', reject);
    one.on('timeout', () => { one.destroy(new Error('no answer')); });
    one.end(form?.toString());
  });
}

function claimForm(token: string, code: string): URLSearchParams {
  return new URLSearchParams({ token, code, user: 'anna', password, repeated: password });
}

/** The form's token, as a browser sends it. */
async function tokenOf(port: string, localAddress?: string): Promise<string> {
  const page = await asked(port, `127.0.0.1:${port}`, '/', undefined, localAddress);
  const token = /name="token" value="([0-9a-f]{32})"/.exec(page.text)?.[1];
  if (token === undefined) throw new Error(`the page has no form: ${page.status} ${page.text}`);
  return token;
}

/** A host with 250 addresses: from each it opens connections and leaves them idle, and guesses codes, until `over`. */
function besieged(port: string): { guesses: number; over: boolean } {
  const siege = { guesses: 0, over: false };
  const pause = (): Promise<void> => new Promise((resolve) => setTimeout(resolve, 100));
  const guess = async (localAddress: string): Promise<void> => {
    while (!siege.over) {
      try {
        const token = await tokenOf(port, localAddress);
        await asked(port, `127.0.0.1:${port}`, '/claim', claimForm(token, '00000-00000'), localAddress);
        siege.guesses += 1;
      } catch {
        await pause();
      }
    }
  };
  const occupy = async (localAddress: string): Promise<void> => {
    while (!siege.over) {
      await new Promise<void>((resolve) => {
        const socket = connect({ host: '127.0.0.1', port: Number(port), localAddress });
        socket.on('error', () => undefined);
        socket.on('close', () => { resolve(); });
      });
      await pause();
    }
  };
  for (let i = 1; i <= 250; i += 1) {
    void guess(`127.1.0.${i}`);
    void occupy(`127.1.0.${i}`);
  }
  return siege;
}

/** What the person at the console does: types the code, and tries again whenever the page does not come. */
async function claimInSpite(port: string, code: () => string): Promise<void> {
  for (;;) {
    try {
      const done = await asked(port, `127.0.0.1:${port}`, '/claim', claimForm(await tokenOf(port), code()));
      if (done.status === 200) return;
    } catch {
      // The connection was closed, or never taken.
    }
    await new Promise((resolve) => setTimeout(resolve, 200));
  }
}

it('behind a router the host by which the code was typed is declared at the helper', async () => {
  const pc = newPc();
  const socket = join(pc.folder, 'helper');
  const helper = spawn(playedPc, [socket, password], { stdio: ['pipe', 'pipe', 'inherit'] });
  onTestFinished(() => { helper.kill('SIGKILL'); });
  let said = '';
  helper.stdout.on('data', (part: Buffer) => { said += part.toString('utf8'); });
  await expect.poll(() => said, { timeout: within }).toContain('ready');
  const claim = spawn(join(build, 'image/claim/flexrf-claim'), ['--users', join(pc.folder, 'users'), '--listen', '127.0.0.1:0',
    '--helper', socket, '--hosts', join(pc.folder, 'hosts'), '--code-file', join(pc.folder, 'code'), ...pc.encryption]);
  onTestFinished(() => { claim.kill('SIGKILL'); });
  let console_ = '';
  claim.stdout.on('data', (part: Buffer) => { console_ += part.toString('utf8'); });
  const shown = (): RegExpMatchArray | null => /The code is {2}(\S+) {2}at https:\/\/[\d.]+:(\d+)\//.exec(console_);
  await expect.poll(shown, { timeout: within }).not.toBeNull();
  const [, code = '', port = ''] = shown()!;

  expect((await asked(port, 'cell 7', '/')).status).toBe(421);
  const form = await asked(port, 'cell7.example.org:8443', '/');
  expect(form.status).toBe(200);
  const token = /name="token" value="([0-9a-f]{32})"/.exec(form.text)?.[1] ?? '';
  const done = await asked(port, 'cell7.example.org:8443', '/claim', claimForm(token, code));
  expect(done.status).toBe(200);
  expect(done.text).toContain('The panel answers at <b>cell7.example.org</b>, too');
  expect(said).toContain('{"hosts":"cell7.example.org","user":"anna","verb":"hosts"}');
  expect(console_).toContain('The panel answers at cell7.example.org, too, by which this PC was claimed.');
});

it('a host that guesses from 250 addresses keeps nobody from claiming the PC', async () => {
  const rounds = process.env['FLEXRF_LONG'] === '1' ? 20 : 1;
  for (let round = 0; round < rounds; round += 1) {
    const pc = newPc();
    const claim = spawn(join(build, 'image/claim/flexrf-claim'), ['--users', join(pc.folder, 'users'), '--listen', '127.0.0.1:0', ...pc.encryption]);
    onTestFinished(() => { claim.kill('SIGKILL'); });
    let console_ = '';
    claim.stdout.on('data', (part: Buffer) => { console_ += part.toString('utf8'); });
    const shown = (): RegExpMatchArray | undefined => [...console_.matchAll(/The code is {2}(\S+) {2}at https:\/\/[\d.]+:(\d+)\//g)].at(-1);
    await expect.poll(shown, { timeout: within }).toBeDefined();
    const port = shown()?.[2] ?? '';
    const siege = besieged(port);
    onTestFinished(() => { siege.over = true; });
    await expect.poll(() => siege.guesses, { timeout: within }).toBeGreaterThan(50);
    const began = performance.now();
    await claimInSpite(port, () => shown()?.[1] ?? '');
    const seconds = (performance.now() - began) / 1000;
    siege.over = true;
    console.log(`claimed after ${seconds.toFixed(1)} s, and ${siege.guesses} guesses`);
    await expect.poll(() => console_, { timeout: within }).toContain('This PC is claimed.');
    claim.kill('SIGKILL');
  }
});

it('the code on the console and a password claim the PC, and the panel knows them', async () => {
  const pc = newPc();
  const users = join(pc.folder, 'users');
  const claim = spawn(join(build, 'image/claim/flexrf-claim'), ['--users', users, '--listen', '127.0.0.1:0', ...pc.encryption]);
  let console_ = '';
  const listen = (part: Buffer): void => { console_ += part.toString('utf8'); };
  claim.stdout.on('data', listen);
  claim.stderr.on('data', listen);
  const ended = new Promise<number | null>((resolve) => claim.once('close', resolve));
  onTestFinished(() => { claim.kill('SIGKILL'); });
  const shown = (): { code: string; port: string } => {
    const all = [...console_.matchAll(/The code is {2}(\S+) {2}at https:\/\/[\d.]+:(\d+)\//g)];
    return { code: all.at(-1)?.[1] ?? '', port: all.at(-1)?.[2] ?? '' };
  };
  await expect.poll(() => shown().code, { timeout: within }).toMatch(/^[0-9A-Z]{5}-[0-9A-Z]{5}$/);

  const context = await browser().newContext({ ignoreHTTPSErrors: true, viewport: sizes.panel });
  onTestFinished(() => tidyUp(() => context.close()));
  context.setDefaultTimeout(within);
  const page = await context.newPage();
  await page.goto(`https://127.0.0.1:${shown().port}/`);
  const type = async (code: string, first = password, second = password): Promise<void> => {
    await page.getByLabel('Code on the screen').fill(code);
    await page.getByLabel('User').fill('anna');
    await page.getByLabel('Password').fill(first);
    await page.getByLabel('The same again').fill(second);
    await page.getByRole('button', { name: 'Claim this PC' }).click();
    await page.waitForLoadState();
  };
  await page.getByRole('button', { name: 'Claim this PC' }).waitFor();
  await screenshot(page, 'claim');
  expect(await violations(page)).toEqual([]);

  await type('00000-00000');
  await page.getByRole('alert').getByText('That is not the code').waitFor();
  await screenshot(page, 'claim-refused');
  expect(await violations(page)).toEqual([]);
  await type(shown().code, password, `${password}x`);
  await page.getByRole('alert').getByText('The two passwords are not the same.').waitFor();
  expect(existsSync(users)).toBe(false);

  // Small letters, and a space in the dash's place.
  await type(shown().code.toLowerCase().replace('-', ' '));
  await page.getByText('This PC is claimed.').waitFor();
  await screenshot(page, 'claimed');
  expect(await violations(page)).toEqual([]);
  expect(await ended).toBe(0);
  expect(console_).toContain('This PC is claimed.');

  const cell = await Application.start('panel_cell', { arguments: ['--panel-users', users, ...pc.encryption] });
  onTestFinished(() => cell.end());
  await page.goto(cell.base);
  const dialog = page.locator('flexrf-login');
  await dialog.getByLabel('User').fill('anna');
  await dialog.getByLabel('Password').fill(password);
  await dialog.getByRole('button', { name: 'Log in' }).click();
  await page.getByText('anna: admin').waitFor();

  // Nobody claims it twice.
  const again = spawnSync(join(build, 'image/claim/flexrf-claim'), ['--users', users, '--listen', '127.0.0.1:0', ...pc.encryption]);
  expect(again.status).toBe(2);
  expect(again.stderr.toString()).toContain('this PC is claimed already');
});
