// Data within the page: base64 of raw DEFLATE.

import type { Source } from '../contract';
import type { GridTable, Hello } from '../wire';

export function embeddedSource(hello: string): Source {
  const none = (): Promise<never> => Promise.reject(new Error('This file has no server to ask.'));
  return {
    hello: JSON.parse(hello) as Hello,
    scene: (world) => unpacked(`isolux-scene-${world}`),
    mesh: (world) => unpacked(`isolux-mesh-${world}`),
    light: (world) => unpacked(`isolux-light-${world}`),
    read: none, control: none,
    grids: async (world) => JSON.parse(new TextDecoder().decode(await unpacked(`isolux-grids-${world}`, '[]'))) as GridTable[],
    follow: () => {},
  };
}

/** The bytes of an element of the page; its text is given up, so that it takes no memory twice. */
async function unpacked(id: string, otherwise?: string): Promise<ArrayBuffer> {
  const element = document.getElementById(id);
  const text = element?.textContent?.trim() ?? '';
  if (!text && otherwise !== undefined) return new TextEncoder().encode(otherwise).buffer as ArrayBuffer;
  if (!text) throw new Error(`The page lacks its data (${id}).`);
  const packed = fromBase64(text);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw'));
  return new Response(stream).arrayBuffer();
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const quick = (Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array<ArrayBuffer> }).fromBase64;
  if (quick) return quick.call(Uint8Array, text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}
