// Runs a program of the WebAssembly System Interface with this program's arguments and stdout: the few of its functions that
// the program asks for. Node's own WASI has crashed at the end of one run in four (20.20, after the last row).
import { readFileSync, writeSync } from 'node:fs';

const words = process.argv.slice(2).map(word => new TextEncoder().encode(`${word}\0`));
let memory;

function put(at, ...numbers) {
  new Uint32Array(memory.buffer, at, numbers.length).set(numbers);
}

const wasi_snapshot_preview1 = {
  args_sizes_get(count, size) {
    put(count, words.length);
    put(size, words.reduce((sum, word) => sum + word.length, 0));
    return 0;
  },
  args_get(places, text) {
    words.forEach((word, i) => {
      put(places + 4 * i, text);
      new Uint8Array(memory.buffer).set(word, text);
      text += word.length;
    });
    return 0;
  },
  environ_sizes_get(count, size) {
    put(count, 0);
    put(size, 0);
    return 0;
  },
  environ_get: () => 0,
  fd_write(file, pieces, count, written) {
    let sum = 0;
    for (let i = 0; i < count; i++) {
      const [at, length] = new Uint32Array(memory.buffer, pieces + 8 * i, 2);
      sum += writeSync(file, new Uint8Array(memory.buffer.slice(at, at + length)));
    }
    put(written, sum);
    return 0;
  },
  proc_exit: code => process.exit(code),
};

const module = new WebAssembly.Module(readFileSync(process.argv[2]));
const { exports } = new WebAssembly.Instance(module, { wasi_snapshot_preview1 });
memory = exports.memory;
exports._start();
