// The page's data: docs/view.md describes them.

import {byId} from './dom.js';

export const manifest = JSON.parse(byId('manifest').textContent);

const loaded = new Map();

async function unpacked(bytes, format) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream(format));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function fromBase64(text) {
  if (Uint8Array.fromBase64)
    return Uint8Array.fromBase64(text);
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i)
    bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function load(name) {
  const {base} = manifest.chunks[name];
  const text = byId('chunk-' + name).textContent;
  const bytes = await unpacked(fromBase64(text), 'deflate');
  if (base) {
    const other = await chunk(base);
    for (let i = 0; i < Math.min(bytes.length, other.length); ++i)
      bytes[i] ^= other[i];
  }
  return bytes;
}

// A chunk's bytes.
export function chunk(name) {
  if (!loaded.has(name))
    loaded.set(name, load(name));
  return loaded.get(name);
}

export const chunkText = async (name) => new TextDecoder().decode(await chunk(name));

// A file as it is without gzip.
export async function chunkFile(name) {
  const bytes = await chunk(name), isGzip = bytes[0] === 0x1F && bytes[1] === 0x8B;
  return isGzip ? unpacked(bytes, 'gzip') : bytes;
}
