// The time of a scene: real time, which can be paused, moved and looped. It is the program's clock, but that it can be held
// while there is nothing to show yet.

/** A time within a loop. */
export function wrap(time, duration) {
  return Math.max(time - Math.floor(time / duration) * duration, 0);
}

export class Clock {
  #base = 0;
  #since;

  constructor(duration) {
    this.duration = duration;
  }

  get rests() {
    return this.#since === undefined;
  }

  /** Seconds since the scene's start, counted on through its loops. */
  get running() {
    return this.rests ? this.#base : this.#base + (performance.now() - this.#since) / 1000;
  }

  /** Seconds of the scene. */
  get now() {
    return wrap(this.running, this.duration);
  }

  start() {
    this.#since ??= performance.now();
  }

  stop() {
    this.#base = this.now;
    this.#since = undefined;
  }

  /** Moves by a little, as what it follows is ahead or behind. */
  nudge(seconds) {
    if (!this.rests) this.#base += seconds;
  }

  go(time) {
    this.#base = wrap(time, this.duration);
    if (!this.rests) this.#since = performance.now();
  }
}
