// Runs a program of the WebAssembly System Interface in node, with this program's arguments and its stdout.
import { readFile } from 'node:fs/promises';
import { WASI } from 'node:wasi';

const [file, ...rest] = process.argv.slice(2);
const wasi = new WASI({ version: 'preview1', args: [file, ...rest] });
const { instance } = await WebAssembly.instantiate(await readFile(file), wasi.getImportObject());
// Not `process.exit`: node 20 has crashed in it while its compiler was still at work.
process.exitCode = wasi.start(instance);
