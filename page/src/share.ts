// The playground's files in a link: packed into its fragment, which browsers do not send to any server.

/** Maximum size in bytes when a link is unpacked, because anyone may have made the link. */
const MOST = 20 << 20;
const HEAD = "#files=";

export interface Shared {
  files: { name: string; text: string }[];
}

export async function linkOf(shared: Shared): Promise<string> {
  const packed = new Uint8Array(await new Response(through(new TextEncoder().encode(JSON.stringify(shared)), new CompressionStream("deflate-raw"))).arrayBuffer());
  let binary = "";
  for (let at = 0; at < packed.length; at += 0x8000) binary += String.fromCharCode(...packed.subarray(at, at + 0x8000));
  return location.href.split("#")[0] + HEAD + btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** The files of the link with which the page was opened; null: the link contains none. */
export async function filesOfLink(fragment: string): Promise<Shared | null> {
  if (!fragment.startsWith(HEAD)) return null;
  const binary = atob(fragment.slice(HEAD.length).replaceAll("-", "+").replaceAll("_", "/"));
  const reader = through(Uint8Array.from(binary, (letter) => letter.charCodeAt(0)), new DecompressionStream("deflate-raw")).getReader();
  const parts: Uint8Array[] = [];
  let length = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    length += value.length;
    if (length > MOST) throw new Error("the link holds more than 20 MB");
    parts.push(value);
  }
  const shared = JSON.parse(await new Blob(parts as BlobPart[]).text()) as Shared;
  const isFile = (file: unknown) => typeof (file as { name: unknown }).name === "string" && typeof (file as { text: unknown }).text === "string";
  if (!Array.isArray(shared?.files) || !shared.files.every(isFile)) throw new Error("the link holds no files");
  return shared;
}

function through(bytes: Uint8Array, stream: CompressionStream | DecompressionStream): ReadableStream<Uint8Array> {
  return new Blob([bytes as BlobPart]).stream().pipeThrough(stream as ReadableWritablePair<Uint8Array, Uint8Array>);
}
