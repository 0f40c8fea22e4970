// What the tests of a file, or of a group of them, share: starting a browser or an application takes longer than most tests.
import { afterAll, afterEach, beforeAll, beforeEach } from 'vitest';
import type { Browser } from 'playwright-core';
import { Application, tidyUp, type StartOptions } from './application';
import { Viewer, launch, type ViewerOptions } from './browser';
import type { ApplicationName } from './environment';
import type { Rest } from './rest';

/** A browser from before the first test of the file until after its last. */
export function useBrowser(): () => Browser {
  let browser: Browser | undefined;
  beforeAll(async () => { browser = await launch(); });
  afterAll(async () => { await browser?.close(); });
  return () => browser!;
}

/** An application for all tests of the group, which leave it as it was or do not mind. */
export function useApplication(name: ApplicationName, options: StartOptions = {}): () => Application {
  let running: Application | undefined;
  beforeAll(async () => { running = await Application.start(name, options); });
  afterAll(async () => { await running?.end(); });
  return () => running!;
}

export interface Operator {
  /** Begins each test with control, at the view that was asked for. */
  readonly viewer: Viewer;
  /** A script of a session that only sees. */
  readonly rest: Rest;
  /** A script of the viewer's own session, beside its page. */
  readonly beside: Rest;
  readonly running: Application;
}

/**
 * An application for all tests of the group, and one person before it with all rights. After each test control is given
 * back, whatever was edited is given up, `restore` puts back what the tests change, and the page is loaded anew.
 */
export function useOperator(
  browser: () => Browser, name: ApplicationName, view: readonly [string, ...string[]],
  restore: (operator: Operator) => Promise<void>, options: ViewerOptions = {},
): Operator {
  let running: Application | undefined;
  let viewer: Viewer | undefined;
  let rest: Rest | undefined;
  let beside: Rest | undefined;
  const operator: Operator = {
    get viewer() { return viewer!; },
    get rest() { return rest!; },
    get beside() { return beside!; },
    get running() { return running!; },
  };
  beforeAll(async () => {
    running = await Application.start(name);
    rest = running.rest();
    viewer = await Viewer.open(browser(), running.address, options);
    beside = await viewer.script();
  });
  beforeEach(async () => {
    await operator.viewer.go(...view);
    await operator.viewer.takeControl();
  });
  afterEach(async () => {
    await tidyUp(
      () => operator.beside.do('control/release', { method: 'POST' }), // ends an edit, too
      () => operator.beside.do('control/take', { method: 'POST' }),
      () => restore(operator),
      () => operator.beside.do('control/release', { method: 'POST' }),
      () => operator.viewer.again(),
      () => operator.viewer.check(),
    );
  });
  afterAll(async () => {
    await tidyUp(() => viewer?.close(), () => running?.end());
  });
  return operator;
}
