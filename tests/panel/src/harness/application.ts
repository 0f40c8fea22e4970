// A real application as a process, with its panel on a port of its own.
import { spawn, spawnSync, type ChildProcess } from 'node:child_process';
import { chmodSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import { executableOf, newFolder, passwordTool, type ApplicationName } from './environment';
import { Rest } from './rest';
import { until, within } from './waiting';

export interface User {
  readonly name: string;
  readonly role: 'viewer' | 'operator' | 'engineer' | 'admin';
  readonly password: string;
}

export interface StartOptions {
  /** Default: loopback, any port. */
  readonly listen?: string;
  readonly users?: readonly User[];
  /** By TLS, with a new certificate for this address. */
  readonly certificateFor?: string;
  readonly arguments?: readonly string[];
}

/** Those that run now: what they said explains why a test failed. */
export const runningApplications = new Set<Application>();

export class Application {
  private said = '';
  private ended: Promise<number | NodeJS.Signals | null>;
  /** "http://127.0.0.1:PORT" */
  base = '';
  /** The printed address, with its one-time token if it has one. */
  address = '';

  private constructor(readonly process: ChildProcess, readonly folder: string) {
    const listen = (part: Buffer): void => { this.said += part.toString('utf8'); };
    process.stdout!.on('data', listen);
    process.stderr!.on('data', listen);
    runningApplications.add(this);
    this.ended = new Promise((resolve) => process.once('close', (code, signal) => {
      runningApplications.delete(this);
      resolve(signal ?? code);
    }));
    process.once('error', (error) => { this.said += error.message; });
  }

  static async start(name: ApplicationName, options: StartOptions = {}): Promise<Application> {
    const folder = newFolder();
    const given = [...(options.arguments ?? [])];
    if (options.certificateFor) given.push(...makeCertificate(folder, options.certificateFor));
    if (options.users) given.push('--panel-users', writeUsers(folder, options.users));
    // What stops the application on purpose goes on with it afterwards; a test of a standstill says so itself.
    if (!given.includes('--standstill-limit')) given.push('--standstill-limit', '10min');
    const child = spawn(executableOf(name), ['--panel', options.listen ?? '127.0.0.1:0', ...given], {
      cwd: folder,
      stdio: ['pipe', 'pipe', 'pipe'],
      // A lock of its own, so that the machine may run the same application beside it.
      env: { ...process.env, XDG_RUNTIME_DIR: folder, TERM: 'dumb' },
    });
    child.stdin.on('error', () => undefined); // it may end before its input does
    const application = new Application(child, folder);
    await application.findAddress();
    return application;
  }

  get id(): number { return this.process.pid!; }
  get text(): string { return this.said; }
  get port(): number { return Number(new URL(this.base).port); }

  /** A script's session of its own: a viewer without a password file. */
  rest(): Rest {
    return new Rest(this.base);
  }

  async loggedIn(user: User): Promise<Rest> {
    const rest = this.rest();
    await rest.do('login', { body: { user: user.name, password: user.password } });
    return rest;
  }

  /** A script with all rights: it uses up the token of the printed address. */
  async admin(): Promise<Rest> {
    const rest = this.rest();
    await rest.do(this.address);
    return rest;
  }

  press(keys: string): void {
    this.process.stdin!.write(keys);
  }

  /** Ends it and gives its exit code. */
  async stop(signal: NodeJS.Signals = 'SIGTERM'): Promise<number | NodeJS.Signals | null> {
    this.process.kill('SIGCONT');
    this.process.kill(signal);
    const timer = setTimeout(() => this.process.kill('SIGKILL'), within);
    const how = await this.ended;
    clearTimeout(timer);
    rmSync(this.folder, { recursive: true, force: true });
    return how;
  }

  /** Ends it, and throws what it said unless it ended as it was told to, and without a fault. */
  async end(): Promise<void> {
    const how = await this.stop();
    if (how !== 143) throw new Error(`the application ended with ${String(how)}:\n${this.said}`);
  }

  private async findAddress(): Promise<void> {
    let over: unknown;
    void this.ended.then((how) => { over = how ?? 'ended'; });
    try {
      this.address = await until(() => {
        const found = /Panel: (https?:\/\/\S+)\n/.exec(this.said)?.[1];
        if (found === undefined && over !== undefined) throw new Error(`the application ended (${String(over)}): ${this.said}`);
        return found;
      }, () => `the application printed no address: ${this.said}`);
    } catch (failure) {
      this.process.kill('SIGKILL');
      throw failure;
    }
    this.base = new URL(this.address).origin;
  }
}

function writeUsers(folder: string, users: readonly User[]): string {
  const file = join(folder, 'users');
  for (const user of users) {
    const made = spawnSync(passwordTool, ['--role', user.role, '--user', user.name, file], { input: `${user.password}\n` });
    if (made.status !== 0) throw new Error(`no password for ${user.name}: ${made.stderr.toString()}`);
  }
  return file;
}

/** As docs/panel-access.md tells to make it; the arguments that name it. */
function makeCertificate(folder: string, address: string): string[] {
  const [key, certificate] = [join(folder, 'key.pem'), join(folder, 'certificate.pem')];
  const made = spawnSync('openssl', [
    'req', '-x509', '-newkey', 'ec', '-pkeyopt', 'ec_paramgen_curve:prime256v1', '-nodes', '-days', '1',
    '-keyout', key, '-out', certificate, '-subj', '/CN=cell', '-addext', `subjectAltName=IP:${address}`,
  ]);
  if (made.status !== 0) throw new Error(`no certificate: ${made.stderr?.toString() ?? made.error?.message}`);
  chmodSync(key, 0o600);
  return ['--tls-certificate', certificate, '--tls-key', key];
}

/** Does all of it, in this order, whatever fails; then throws what did. */
export async function tidyUp(...acts: readonly (() => unknown)[]): Promise<void> {
  const failures: string[] = [];
  for (const act of acts) {
    try {
      await act();
    } catch (failure) {
      failures.push(failure instanceof Error ? failure.message : String(failure));
    }
  }
  if (failures.length > 0) throw new Error(failures.join('\n\n'));
}
