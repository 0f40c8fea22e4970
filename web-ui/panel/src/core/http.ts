// The few things the page asks for by REST.
import type { Problem } from './protocol';

export type Fetched<Body> =
  | { readonly ok: true; readonly body: Body }
  /** status 0: nobody answered. `problem`: what the server said, if that was one. */
  | { readonly ok: false; readonly status: number; readonly detail: string; readonly problem?: Problem };

export function getJson<Body>(path: string): Promise<Fetched<Body>> {
  return ask<Body>(path, { method: 'GET' });
}

export function postJson<Body>(path: string, body?: object): Promise<Fetched<Body>> {
  return ask<Body>(path, {
    method: 'POST',
    ...(body && { body: JSON.stringify(body), headers: { 'content-type': 'application/json' } }),
  });
}

/** Bytes; who does not answer within this time, ms, does not at all. */
export function putBytes<Body>(path: string, body: Blob, within: number): Promise<Fetched<Body>> {
  return ask<Body>(path, {
    method: 'PUT', body, headers: { 'content-type': 'application/octet-stream' }, signal: AbortSignal.timeout(within),
  });
}

async function ask<Body>(path: string, options: RequestInit): Promise<Fetched<Body>> {
  try {
    const response = await fetch(path, { cache: 'no-store', credentials: 'same-origin', ...options });
    if (response.ok) {
      const text = await response.text();
      return { ok: true, body: (text === '' ? {} : JSON.parse(text)) as Body };
    }
    const problem = await problemOf(response);
    return { ok: false, status: response.status, detail: detailOf(response, problem), ...(problem && { problem }) };
  } catch (error) {
    return { ok: false, status: 0, detail: error instanceof SyntaxError ? 'The answer is no JSON.' : 'The application does not answer.' };
  }
}

async function problemOf(response: Response): Promise<Problem | undefined> {
  try {
    return (await response.json()) as Problem;
  } catch {
    return undefined; // not this server's own words
  }
}

function detailOf(response: Response, problem: Problem | undefined): string {
  if (problem && (problem.detail || response.status !== 503)) return problem.detail || problem.title;
  if (response.status === 503) return 'All places of the panel are taken; close a page elsewhere.';
  return `The server answered ${response.status} ${response.statusText}.`;
}
