// Renders rows of the table of kept frames by the page's module. Arguments: a copy of the page's module.js, the module, the
// rows as JSON, and the function that hashes. Prints a hash per row.
import { readFile } from 'node:fs/promises';
import { pathToFileURL } from 'node:url';

const [script, wasm, rows, hash] = process.argv.slice(2);
const { Instance, missing } = await import(pathToFileURL(script));
if (missing()) throw new Error(missing());
const module = await WebAssembly.compile(await readFile(wasm));
if (WebAssembly.Module.imports(module).length > 0) throw new Error('the module has imports');
const instance = await Instance.of(module);
const frameHash = eval(await readFile(hash, 'utf8'));
const { scenes, qualities } = instance.describe();
for (const { name, time, quality, width, height } of JSON.parse(await readFile(rows, 'utf8'))) {
  const scene = scenes.findIndex(({ scene }) => scene === name);
  const request = { scene, time, width, height, quality: qualities.indexOf(quality), values: [], first: 0, last: height };
  console.log(frameHash(new Uint8Array(instance.render(request))));
}
