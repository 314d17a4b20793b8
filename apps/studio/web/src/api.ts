// Talking to the studio's server: JSON and binary geometry, with this run's token.
import { decode, type Geometry } from './geometry';

export class Refusal extends Error {
  constructor(readonly status: number, message: string, readonly details: Record<string, unknown>) {
    super(message);
  }
}

const tokenKey = 'rhombloom-token';

// The token comes in the address's fragment, which is never sent anywhere; a reload finds it in the tab's own storage.
function takeToken(): string {
  const given = location.hash.slice(1);
  if (/^[0-9a-f]{32}$/.test(given)) {
    sessionStorage.setItem(tokenKey, given);
    history.replaceState(null, '', location.pathname);
  }
  return sessionStorage.getItem(tokenKey) ?? '';
}

const token = takeToken();

async function ask(path: string, body?: unknown): Promise<Response> {
  const raw = body instanceof ArrayBuffer;
  const headers: Record<string, string> = { 'X-Rhombloom-Token': token };
  let response: Response;
  try {
    response = await fetch(path, body === undefined
      ? { headers }
      : { method: 'POST', headers: { ...headers, 'Content-Type': raw ? 'application/octet-stream' : 'application/json' }, body: raw ? body : JSON.stringify(body) });
  } catch {
    throw new Refusal(0, 'unreachable', {});
  }
  if (response.ok) return response;
  const details = await response.json().catch(() => ({})) as Record<string, unknown>;
  throw new Refusal(response.status, String(details.error ?? response.statusText), details);
}

export async function get<T>(path: string): Promise<T> {
  return (await ask(path)).json() as Promise<T>;
}

export async function post<T>(path: string, body: unknown): Promise<T> {
  return (await ask(path, body)).json() as Promise<T>;
}

export async function text(path: string): Promise<string> {
  return (await ask(path)).text();
}

export async function picture(path: string): Promise<string> {
  return URL.createObjectURL(await (await ask(path)).blob());
}

export async function geometry(path: string, body?: unknown): Promise<Geometry> {
  return decode(await (await ask(path, body)).arrayBuffer());
}
