// Where the data come from: the page itself, or the server that it came from.

import type { Source } from '../contract';
import { embeddedSource } from './embedded';
import { serverSource } from './server';

/** Data in the page if there are any, else the server's. */
export async function openSource(): Promise<Source> {
  const hello = document.getElementById('isolux-hello')?.textContent?.trim();
  return hello ? embeddedSource(hello) : serverSource();
}
