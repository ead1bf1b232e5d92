// The WebAssembly module: how it is loaded, and one instance of it in words of JavaScript.

// The smallest module that has an instruction of SIMD: a function that gives the zero vector's first lane.
const SIMD = new Uint8Array([
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 127, 3, 2, 1, 0, 10, 11, 1, 9, 0, 65, 0, 253, 15, 253, 27, 0, 11,
]);

/** A sentence that says what the browser lacks; none if it lacks nothing. */
export function missing() {
  if (typeof WebAssembly !== 'object') {
    return 'This browser has no WebAssembly, which the pictures are computed in.';
  }
  if (!WebAssembly.validate(SIMD)) {
    return 'This browser has no WebAssembly SIMD, which the pictures are computed with: Chrome 91, Firefox 89, Safari 16.4 and later have it.';
  }
  return undefined;
}

/** Loads and compiles the module at an address; it compiles while it arrives where the host names its type. */
export async function load(address) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`${address}: ${response.status} ${response.statusText}`);
  if (response.headers.get('Content-Type')?.startsWith('application/wasm')) return WebAssembly.compileStreaming(response);
  return WebAssembly.compile(await response.arrayBuffer());
}

/** An instance with a memory of its own. */
export class Instance {
  #exports;

  constructor(instance) {
    this.#exports = instance.exports;
  }

  static async of(module) {
    return new Instance(await WebAssembly.instantiate(module, {}));
  }

  /** Scenes, parameters, parts and qualities. */
  describe() {
    const length = this.#exports.describe();
    return JSON.parse(new TextDecoder().decode(new Uint8Array(this.#exports.memory.buffer, this.#exports.output(), length)));
  }

  /** Pixels of rows `first` to `last`, four bytes each, in a buffer of their own. */
  render({ scene, time, width, height, quality, values, first, last }) {
    const address = this.#exports.input(values.length);
    new Float64Array(this.#exports.memory.buffer, address, values.length).set(values);
    const pixels = this.#exports.render(scene, time, width, height, quality, first, last);
    // The memory may have grown, so its buffer is asked for anew.
    const start = this.#exports.output();
    return this.#exports.memory.buffer.slice(start, start + 4 * pixels);
  }

  /** Samples of the show's sound from number `first` on, left and right in turn, as whole numbers of 16 bits. */
  sound(first, count) {
    this.#exports.sound(first, count);
    const start = this.#exports.output();
    return new Int16Array(this.#exports.memory.buffer.slice(start, start + 4 * count));
  }

  /** The size of the next frames in eighths, after one that took this share of its time. */
  govern(share) {
    return this.#exports.govern(share);
  }

  /** Has the governor begin with the whole size again. */
  forget() {
    this.#exports.forget();
  }
}
