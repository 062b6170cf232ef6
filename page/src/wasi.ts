// The small part of WASI that a program needs for standard input and output.

class Exit extends Error {
  constructor(readonly code: number) {
    super(`exit ${code}`);
  }
}

/** Runs a program with its standard input, and returns its standard output. */
export async function run(module: WebAssembly.Module, input: Uint8Array): Promise<Uint8Array> {
  let memory: WebAssembly.Memory;
  let read = 0;
  let said = "";
  const out: Uint8Array[] = [];
  const view = () => new DataView(memory.buffer);
  /** The memory ranges of a list. */
  const pieces = function* (list: number, count: number) {
    for (let i = 0; i < count; i++) {
      const [at, length] = [view().getUint32(list + i * 8, true), view().getUint32(list + i * 8 + 4, true)];
      yield new Uint8Array(memory.buffer, at, length);
    }
  };
  const BAD = 8;
  const calls: Record<string, (...values: number[]) => number> = {
    fd_read(fd, list, count, done) {
      if (fd !== 0) return BAD;
      let total = 0;
      for (const piece of pieces(list, count)) {
        const part = input.subarray(read, read + piece.length);
        piece.set(part);
        read += part.length;
        total += part.length;
      }
      view().setUint32(done, total, true);
      return 0;
    },
    fd_write(fd, list, count, done) {
      let total = 0;
      for (const piece of pieces(list, count)) {
        total += piece.length;
        if (fd === 1) out.push(piece.slice());
        else said += new TextDecoder().decode(piece);
      }
      view().setUint32(done, total, true);
      return 0;
    },
    environ_sizes_get(count, size) {
      view().setUint32(count, 0, true);
      view().setUint32(size, 0, true);
      return 0;
    },
    environ_get: () => 0,
    args_sizes_get(count, size) {
      view().setUint32(count, 0, true);
      view().setUint32(size, 0, true);
      return 0;
    },
    args_get: () => 0,
    random_get(at, length) {
      crypto.getRandomValues(new Uint8Array(memory.buffer, at, length));
      return 0;
    },
    clock_time_get: (_id, _low, at) => {
      view().setBigUint64(at, BigInt(Math.round(performance.now() * 1e6)), true);
      return 0;
    },
    proc_exit(code) {
      throw new Exit(code);
    },
  };
  const missing = () => 52;
  const imports = new Proxy(calls, { get: (known, name: string) => known[name] ?? missing });
  const names = WebAssembly.Module.imports(module).filter((entry) => entry.module === "wasi_snapshot_preview1");
  const wasi = Object.fromEntries(names.map(({ name }) => [name, imports[name]]));
  const instance = await WebAssembly.instantiate(module, { wasi_snapshot_preview1: wasi });
  memory = instance.exports.memory as WebAssembly.Memory;
  try {
    (instance.exports._start as () => void)();
  } catch (error) {
    if (!(error instanceof Exit)) throw new Error(said || String(error));
    if (error.code !== 0) throw new Error(said || `postform ended with ${error.code}`);
  }
  const all = new Uint8Array(out.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of out) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}
