// The workers. Each does one job at a time; one that dies or falls silent is replaced, and its job is done again.
//
// A job is the request for some rows (see Instance.render) with functions: `done(pixels, milliseconds)`, `failed(sentence)`,
// and perhaps `wanted()`, which says whether anybody still waits for it.

// How often a job is tried: the second worker that dies of it is the last.
const TRIES = 2;
// A worker that takes this many times as long as the slowest of the last jobs is taken for dead, but not before PATIENCE
// milliseconds, nor before LONG if its job says that it is `long`. Each try has four times the patience of the last.
const SLOW = 20;
const PATIENCE = 10_000;
const LONG = 600_000;
// A worker that is busy for this long with what nobody waits for any more is replaced too, milliseconds.
const VAIN = 3000;
// How often workers are looked after, milliseconds.
const WATCH = 1000;
// Workers that die before they are ready, one after another, before the pool gives up.
const STILLBORN = 4;

export class Pool {
  #module;
  #take;
  #failed;
  #seats;
  // Jobs that go before those that are taken.
  #urgent = [];
  #slowest = 0;
  #stillborn = 0;

  /**
   * The module is a promise: workers start while it arrives. `take` gives the next job or nothing, whenever a worker is free; `failed` hears a sentence when no worker can be
   * started.
   */
  constructor(module, count, take, failed) {
    this.#module = module;
    this.#take = take;
    this.#failed = failed;
    this.#seats = Array.from({ length: count }, () => this.#start());
    setInterval(() => this.#watch(), WATCH);
  }

  get workers() {
    return this.#seats.length;
  }

  /** How many workers have ever been replaced. */
  replaced = 0;

  /** The workers themselves, for whoever wants to see one die. */
  get raw() {
    return this.#seats.map(seat => seat.worker);
  }

  /** Does a job before those that `take` gives. */
  first(job) {
    this.#urgent.push(job);
    this.wake();
  }

  /** Has every free worker ask for a job. */
  wake() {
    for (const seat of this.#seats) this.#feed(seat);
  }

  #start(seat = {}) {
    const worker = new Worker(new URL('./worker.js', import.meta.url), { type: 'module' });
    // Until it has the module nobody waits for it.
    Object.assign(seat, { worker, ready: false, job: undefined, since: Infinity });
    worker.onmessage = ({ data }) => {
      if (seat.worker === worker) this.#hear(seat, data);
    };
    worker.onerror = event => {
      event.preventDefault();
      if (seat.worker === worker) this.#bury(seat, event.message ?? 'a worker died');
    };
    const begin = module => {
      if (seat.worker !== worker) return;
      seat.since = performance.now();
      worker.postMessage({ module });
    };
    // Whoever loads it says what is wrong if it does not come.
    this.#module.then(begin, () => {});
    return seat;
  }

  #hear(seat, data) {
    if (data.ready) {
      seat.ready = true;
      this.#stillborn = 0;
    } else {
      const { job } = seat;
      seat.job = undefined;
      this.#slowest = Math.max(data.took, 0.95 * this.#slowest);
      // The next job first, so that the worker goes on while the page looks at what has come.
      this.#feed(seat);
      job?.done(data.pixels, data.took);
    }
    this.#feed(seat);
  }

  #feed(seat) {
    if (!seat.ready || seat.job) return;
    const job = this.#urgent.shift() ?? this.#take();
    if (!job) return;
    seat.job = job;
    seat.since = performance.now();
    const { scene, time, width, height, quality, values, first, last } = job;
    seat.worker.postMessage({ scene, time, width, height, quality, values, first, last });
  }

  // A worker has died. Its job goes to another, or fails.
  #bury(seat, why) {
    const { job, ready } = seat;
    if (!ready && ++this.#stillborn >= STILLBORN) {
      seat.worker.terminate();
      this.#failed(`No worker can be started: ${why}`);
      return;
    }
    this.#replace(seat);
    if (!job) return;
    job.tries = (job.tries ?? 0) + 1;
    if (job.tries < TRIES) this.#urgent.unshift(job);
    else job.failed(`A frame cannot be rendered: ${why}`);
    this.wake();
  }

  #replace(seat) {
    seat.worker.terminate();
    this.replaced += 1;
    this.#start(seat);
  }

  // A worker may end without a word, or be long in coming back from what is not wanted any more.
  #watch() {
    const now = performance.now();
    for (const seat of this.#seats) {
      const { job, since } = seat;
      if (!job && seat.ready) continue;
      const patience = Math.max(job?.long ? LONG : PATIENCE, SLOW * this.#slowest) * 4 ** (job?.tries ?? 0);
      if (job?.wanted?.() === false && now - since > VAIN) this.#replace(seat);
      else if (now - since > patience) this.#bury(seat, 'a worker says nothing');
    }
  }
}
