// @vitest-environment node
import { afterEach, expect, it, vi } from 'vitest';
import { postJson } from '../http';

afterEach(() => vi.unstubAllGlobals());

async function told(status: number, body: string): Promise<string> {
  vi.stubGlobal('fetch', () => Promise.resolve(new Response(body, { status, statusText: 'So' })));
  const answer = await postJson('/api/v1/login', {});
  return answer.ok ? '' : answer.detail;
}

it('shows the server\'s own words, also where it has too little of something', async () => {
  expect(await told(503, '{"title":"Service Unavailable","detail":"The machine has too little memory."}')).toBe('The machine has too little memory.');
  expect(await told(403, '{"title":"Forbidden","detail":"User or password is wrong."}')).toBe('User or password is wrong.');
  expect(await told(409, '{"title":"Conflict"}')).toBe('Conflict');
});

it('has words of its own where there are none', async () => {
  const full = 'All places of the panel are taken; close a page elsewhere.';
  expect(await told(503, '')).toBe(full);
  expect(await told(503, '{"title":"Service Unavailable"}')).toBe(full);
  expect(await told(502, '<html>')).toBe('The server answered 502 So.');
});
