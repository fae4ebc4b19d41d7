// A server: `isolux view` and `isolux solve --live`.

import type { Source } from '../contract';
import type { Control, ErrorHistory, GridTable, Hello, LiveState, RayAsked, Reading } from '../wire';

type Follow = Parameters<Source['follow']>[0];
type Query = Record<string, string | number>;

const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 15_000;

/** An answer that is not the one wanted; 404 and 409 mean that something is not there yet. */
export class Refused extends Error {
  constructor(readonly status: number, message: string) {
    super(message);
  }

  get isNotYet(): boolean {
    return this.status === 404 || this.status === 409;
  }
}

/** An address of the server; the token of the page goes along. */
function address(name: string, query: Query = {}): string {
  const all = new URLSearchParams(Object.entries(query).map(([key, value]) => [key, String(value)]));
  const token = new URLSearchParams(location.search).get('token');
  if (token) all.set('token', token);
  const text = all.toString();
  return `api/${name}${text ? `?${text}` : ''}`;
}

async function ask(name: string, query?: Query, init?: RequestInit): Promise<Response> {
  const response = await fetch(address(name, query), { cache: 'no-store', ...init });
  if (!response.ok) throw new Refused(response.status, await reason(response));
  return response;
}

async function reason(response: Response): Promise<string> {
  const text = (await response.text().catch(() => '')).trim();
  return text && text.length < 400 ? text : `The server answered with ${response.status}.`;
}

const bytes = async (name: string, query: Query): Promise<ArrayBuffer> => (await ask(name, query)).arrayBuffer();

async function send<T>(name: string, body: unknown, signal?: AbortSignal): Promise<T> {
  const init: RequestInit = { method: 'POST', headers: { 'content-type': 'application/json' }, body: JSON.stringify(body) };
  const response = await ask(name, {}, signal ? { ...init, signal } : init);
  const text = await response.text();
  return (text ? JSON.parse(text) : {}) as T;
}

export async function serverSource(): Promise<Source> {
  const hello = (await (await ask('hello')).json()) as Hello;
  const read = async (world: number, rays: RayAsked[], dimming: number[], signal: AbortSignal): Promise<Reading[]> =>
    (await send<{ readings: Reading[] }>('read', { world, rays, dimming }, signal)).readings;
  return {
    hello,
    scene: (world) => bytes('scene', { world }),
    mesh: (world) => bytes('mesh', { world }),
    light: (world, mesh, since) => bytes('light', { world, mesh, since }),
    read,
    grids: async (world) => (await (await ask('grids', { world })).json()) as GridTable[],
    control: async (what: Control) => void (await send('control', what)),
    follow: (on) => follow(on, FIRST_WAIT_MS),
  };
}

/** Listens to events; after a break again, ever more seldom. */
function follow(on: Follow, wait: number): void {
  const events = new EventSource(address('events'));
  let next = wait;
  events.addEventListener('open', () => {
    next = FIRST_WAIT_MS;
    on.connected(true);
  });
  events.addEventListener('history', (event) => on.history(JSON.parse(event.data as string) as ErrorHistory));
  events.addEventListener('state', (event) => on.state(JSON.parse(event.data as string) as LiveState));
  events.addEventListener('error', () => {
    events.close();
    on.connected(false);
    setTimeout(() => follow(on, Math.min(2 * next, LONGEST_WAIT_MS)), next);
  });
}
