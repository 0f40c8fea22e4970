// The few things the page asks for by REST.
import type { Problem } from './protocol';

export type Fetched<Body> =
  | { readonly ok: true; readonly body: Body }
  /** status 0: nobody answered. */
  | { readonly ok: false; readonly status: number; readonly detail: string };

export function getJson<Body>(path: string): Promise<Fetched<Body>> {
  return ask<Body>(path, { method: 'GET' });
}

export function postJson<Body>(path: string, body?: object): Promise<Fetched<Body>> {
  return ask<Body>(path, {
    method: 'POST',
    ...(body && { body: JSON.stringify(body), headers: { 'content-type': 'application/json' } }),
  });
}

async function ask<Body>(path: string, options: RequestInit): Promise<Fetched<Body>> {
  try {
    const response = await fetch(path, { cache: 'no-store', credentials: 'same-origin', ...options });
    if (response.ok) {
      const text = await response.text();
      return { ok: true, body: (text === '' ? {} : JSON.parse(text)) as Body };
    }
    return { ok: false, status: response.status, detail: await detailOf(response) };
  } catch (error) {
    return { ok: false, status: 0, detail: error instanceof SyntaxError ? 'The answer is no JSON.' : 'The application does not answer.' };
  }
}

async function detailOf(response: Response): Promise<string> {
  try {
    const problem = (await response.json()) as Problem;
    if (problem.detail || response.status !== 503) return problem.detail || problem.title;
  } catch {
    // not this server's own words
  }
  if (response.status === 503) return 'All places of the panel are taken; close a page elsewhere.';
  return `The server answered ${response.status} ${response.statusText}.`;
}
