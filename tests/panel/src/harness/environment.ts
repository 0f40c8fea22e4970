// What ctest tells in the environment; by hand, the release build beside this folder.
import { mkdtempSync } from 'node:fs';
import { networkInterfaces, tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

export const build = process.env['FLEXRF_BUILD'] ?? fileURLToPath(new URL('../../../../build/release', import.meta.url));

const ownApplications = ['panel_cell', 'brief_session', 'sight_cell', 'contest'] as const;
export type ApplicationName = 'keyboard' | 'keyboard-single' | 'pick-station' | 'visual-servoing' | (typeof ownApplications)[number];

export function executableOf(name: ApplicationName): string {
  const own: readonly string[] = ownApplications;
  return own.includes(name) ? join(build, 'tests/panel', name) : join(build, 'apps', name, name);
}

export const passwordTool = join(build, 'web-ui/server/access/flexrf-password');
export const playedPc = join(build, 'tests/panel/played_pc');
export const freezer = join(build, 'tests/panel/freeze_thread');
export const chromium = fileURLToPath(new URL('chromium.sh', import.meta.url));

/** Folder for screenshots; undefined: none are taken. */
export const screenshots = process.env['FLEXRF_PANEL_SCREENSHOTS'];

export function newFolder(): string {
  return mkdtempSync(join(tmpdir(), 'flexrf-panel-'));
}

/** An address of this machine that is no loopback one: what comes from there is not local. Undefined: there is none. */
export function outerAddress(): string | undefined {
  return Object.values(networkInterfaces())
    .flat()
    .find((one) => one && !one.internal && one.family === 'IPv4')?.address;
}
