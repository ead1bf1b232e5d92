// A worker: one instance of the module, which renders the rows that it is sent.

import { Instance } from './module.js';

let instance;

addEventListener('message', async ({ data }) => {
  if (data.module) {
    instance = await Instance.of(data.module);
    postMessage({ ready: true });
    return;
  }
  const began = performance.now();
  // What goes wrong in here is an error event of the worker: its memory is not to be trusted any more.
  const pixels = instance.render(data);
  postMessage({ pixels, took: performance.now() - began }, [pixels]);
});

// A promise that fails would be silent otherwise.
addEventListener('unhandledrejection', ({ reason }) => {
  throw reason;
});
