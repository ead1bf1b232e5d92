// Plays a scene on a canvas: says which frames are rendered, and when each is shown.
//
// While time runs, workers render whole frames ahead, each another one: a frame's layers are prepared once for all of its
// rows, so that this is what makes the most frames. Where time stands still, and for the first frame after a jump, all
// workers render bands of one frame, which is there sooner.

import { Clock, wrap } from './clock.js';

// The height of the renderer's bands, rows: what lies in one of them costs as much as the whole of it.
const BAND = 64;
// Frames per second that the governor holds, and the most that are rendered, as the program does.
const HELD = 30;
const MOST = 60;
// The first frame's size in eighths of each side, the governor's smallest: a picture is there soon on any machine.
const FIRST = 3;
// Frames that are rendered or wait to be shown, per worker.
const AHEAD = 3;
// How long a frame that is not wanted any more may hold up the next one, milliseconds.
const HURRY = 400;
// Qualities without shortcuts, whose frames may take minutes.
const LONG = ['exact', 'reference'];
// The weight of the latest frame in the mean time per frame.
const WEIGHT = 0.2;
// Why a still has no picture: it was asked for before anything was shown.
export const NOTHING_SHOWN = 'There is no frame yet.';

export class Player extends EventTarget {
  #canvas;
  #context;
  #instance;
  #pool;
  // What is rendered: scene, quality and values. Frames of an earlier epoch are not shown.
  #epoch = 0;
  #clock;
  // Frames of this epoch that are being rendered or wait to be shown.
  #ring = [];
  // The bands of a frame that nobody has taken yet.
  #bands = [];
  // A frame at rest that all workers are at, and whether another has been asked for meanwhile.
  #still;
  #again = false;
  // The time of the last frame that was asked for, and of that on the canvas, on the running clock.
  #asked = -Infinity;
  #shown;
  #mean = 0;
  #eighths = 8;
  #stamps = [];
  // Whether time runs, once there is something to show.
  #plays = false;
  #hidden = false;

  constructor(canvas, instance) {
    super();
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d', { alpha: false });
    this.#instance = instance;
    this.description = instance.describe();
    this.scene = this.description.scenes[0];
    this.quality = 'default';
    /** 'auto', or width and height. */
    this.size = 'auto';
    this.values = new Map();
    this.#clock = new Clock(this.scene.duration);
    requestAnimationFrame(() => this.#tick());
  }

  /** The workers, once there are some. */
  set pool(pool) {
    this.#pool = pool;
    this.#restart();
  }

  get pool() {
    return this.#pool;
  }

  /** What a worker is to do next, if anything. */
  take() {
    if (this.#bands.length > 0) return this.#bands.shift();
    if (!this.#plays || this.#clock.rests || this.#hidden) return undefined;
    if (this.#ring.length >= AHEAD * this.#pool.workers) return undefined;
    const now = this.#clock.running;
    const workers = this.#pool.workers;
    const interval = Math.max(1 / MOST, this.#mean / workers);
    const time = Math.max(this.#asked + interval, now + this.#mean);
    // No farther ahead than it takes to render what is shown meanwhile.
    if (time > now + this.#mean + 2 * workers * interval) return undefined;
    return this.#request(time, this.#playingSize(), 1)[0];
  }

  // Scenes, times and settings.

  get time() {
    return this.#clock.now;
  }

  /** The time of the frame on the canvas, seconds of the scene. */
  get shownTime() {
    return this.#shown?.request.time;
  }

  /** The name of the scene whose frame is on the canvas. */
  get shownScene() {
    return this.description.scenes[this.#shown?.request.scene]?.scene;
  }

  /** Whether time stands still and its frame is shown. */
  get atRest() {
    return this.#clock.rests && this.#still === undefined && !this.#plays && this.#shown?.epoch === this.#epoch;
  }

  get playing() {
    return this.#plays;
  }

  /** Whether time runs: it waits for the first frame after a jump. */
  get runs() {
    return !this.#clock.rests;
  }

  /** Whether the scene is the show, which alone has sound. */
  get isShow() {
    return this.scene.scene === this.description.show;
  }

  /** Moves time by a little, to where the sound is. */
  follow(seconds) {
    this.#clock.nudge(seconds);
  }

  play() {
    this.#plays = true;
    this.#restart();
    this.#changed();
  }

  pause() {
    this.#plays = false;
    this.#clock.stop();
    this.#restart();
    this.#changed();
  }

  toggle() {
    if (this.#plays) this.pause();
    else this.play();
  }

  go(time) {
    this.#clock.go(time);
    this.#restart();
    this.#changed();
  }

  seek(seconds) {
    this.go(this.#clock.now + seconds);
  }

  /** Goes to the start of a part, counted from 0. A scene other than the show has one, which starts at 0. */
  jump(part) {
    const start = this.parts[part];
    if (start) this.go(start.at);
  }

  /** The parts of the scene: where each starts, and the scene that it is. */
  get parts() {
    const { show, parts } = this.description;
    return this.scene.scene === show ? parts : [{ at: 0, scene: this.scene.scene }];
  }

  /** Shows another scene from its start. */
  choose(name) {
    const scene = this.description.scenes.find(scene => scene.scene === name);
    if (!scene || scene === this.scene) return;
    this.scene = scene;
    this.values = new Map();
    this.#clock.stop();
    this.#clock = new Clock(scene.duration);
    this.#forget();
    this.#restart();
    this.#changed();
  }

  setQuality(name) {
    this.quality = name;
    this.#forget();
    this.#restart();
    this.#changed();
  }

  setSize(size) {
    this.size = size;
    this.#forget();
    this.#restart();
    this.#changed();
  }

  /** Sets a parameter, or with nothing its default. */
  setValue(name, value) {
    if (value === undefined) this.values.delete(name);
    else this.values.set(name, value);
    this.#restart();
    this.#changed();
  }

  /** The canvas has another size on the screen. */
  resized() {
    if (this.size === 'auto' && !this.#plays) this.#restart();
  }

  /** The page is hidden, or is seen again: time stands still meanwhile. */
  set hidden(hidden) {
    if (hidden === this.#hidden) return;
    this.#hidden = hidden;
    if (hidden) this.#clock.stop();
    this.#restart();
  }

  /** Frames per second, of the last second. */
  get rate() {
    const now = performance.now();
    this.#stamps = this.#stamps.filter(stamp => now - stamp < 1000);
    return this.#stamps.length;
  }

  /** Width and height of the frame on the canvas. */
  get shownSize() {
    return [this.#canvas.width, this.#canvas.height];
  }

  /** The whole size: that of a frame at rest, and of a still. */
  get wholeSize() {
    if (this.size !== 'auto') return this.size;
    // The program's, or what the screen has room for, in steps of an eighth.
    const { width } = this.#canvas.getBoundingClientRect();
    const step = Math.min(Math.max(Math.ceil((width * devicePixelRatio) / 160), 1), 8);
    return [160 * step, 90 * step];
  }

  /** A frame of its own, apart from what is shown. Gives what a canvas takes. */
  render(request) {
    return new Promise((resolve, reject) => {
      const whole = { values: [], scene: this.#number(this.scene), quality: this.#qualityNumber(), ...request };
      const { width, height } = whole;
      const image = new ImageData(width, height);
      const jobs = bands(height);
      let left = jobs.length;
      for (const [first, last] of jobs) {
        const done = pixels => {
          image.data.set(new Uint8Array(pixels), 4 * width * first);
          if (--left === 0) resolve(image);
        };
        this.#pool.first({ ...whole, first, last, long: true, done, failed: why => reject(new Error(why)) });
      }
    });
  }

  /** The frame that is shown, at the whole size and at the nearest millisecond. */
  async still() {
    if (this.#shown === undefined) throw new Error(NOTHING_SHOWN);
    const time = Math.floor(this.#shown.request.time * 1000 + 0.5) / 1000;
    const [width, height] = this.wholeSize;
    return { image: await this.render({ ...this.#shown.request, time, width, height }), time, scene: this.scene.scene };
  }

  // Frames.

  #number(scene) {
    return this.description.scenes.indexOf(scene);
  }

  #qualityNumber() {
    return this.description.qualities.indexOf(this.quality);
  }

  #playingSize() {
    const [width, height] = this.wholeSize;
    const now = this.#shown === undefined ? FIRST : this.#eighths;
    const eighths = this.size === 'auto' ? now : 8;
    return [Math.max((width * eighths) >> 3, 1), Math.max((height * eighths) >> 3, 1)];
  }

  // A new frame of a time on the running clock, as jobs: one for all of its rows, or one per band.
  #request(time, [width, height], parts) {
    const scene = this.scene;
    const values = scene.parameters.map(({ name }) => this.values.get(name) ?? NaN);
    const request = { scene: this.#number(scene), time: wrap(time, scene.duration), width, height, quality: this.#qualityNumber(), values };
    const rows = parts === 1 ? [[0, height]] : bands(height);
    const frame = { request, time, epoch: this.#epoch, left: rows.length, pixels: undefined, began: performance.now() };
    if (rows.length > 1) frame.pixels = new Uint8ClampedArray(4 * width * height);
    this.#ring.push(frame);
    this.#asked = time;
    return rows.map(([first, last]) => ({
      ...request,
      first,
      last,
      long: LONG.includes(this.quality),
      wanted: () => frame.epoch === this.#epoch,
      done: (pixels, took) => this.#done(frame, first, pixels, rows.length === 1 ? took : undefined),
      failed: why => this.#failed(frame, why),
    }));
  }

  #done(frame, first, pixels, took) {
    if (frame.pixels) frame.pixels.set(new Uint8ClampedArray(pixels), 4 * frame.request.width * first);
    else frame.pixels = new Uint8ClampedArray(pixels);
    frame.left -= 1;
    if (frame.epoch !== this.#epoch) return;
    if (took !== undefined) {
      const seconds = took / 1000;
      this.#mean = this.#mean > 0 ? this.#mean + WEIGHT * (seconds - this.#mean) : seconds;
      // Workers share the time of a frame.
      if (this.size === 'auto') this.#eighths = this.#instance.govern((seconds / this.#pool.workers) * HELD);
    }
    if (frame !== this.#still) return;
    if (frame.left > 0) {
      // A picture that takes long is seen as it comes.
      if (performance.now() - frame.began > HURRY) this.#draw(frame, first, pixels);
      return;
    }
    this.#still = undefined;
    this.#ring = this.#ring.filter(other => other !== frame);
    this.#show(frame);
    // There is something to show, so time may run.
    if (this.#again) this.#restart();
    else if (this.#plays && !this.#hidden) this.#clock.start();
    this.#pool.wake();
  }

  #failed(frame, why) {
    this.#ring = this.#ring.filter(other => other !== frame);
    if (frame === this.#still) this.#still = undefined;
    this.dispatchEvent(new CustomEvent('trouble', { detail: why }));
  }

  // What is shown has changed: what was rendered ahead is void, and one frame is rendered by all workers.
  #restart() {
    if (!this.#pool) return;
    if (this.#still && performance.now() - this.#still.began < HURRY) {
      // Whoever drags the seek bar sees each frame that he has waited for.
      this.#again = true;
      return;
    }
    this.#again = false;
    this.#epoch += 1;
    this.#ring = [];
    this.#bands = [];
    this.#still = undefined;
    if (this.#hidden) return;
    const size = this.#plays ? this.#playingSize() : this.wholeSize;
    this.#bands = this.#request(this.#clock.running, size, 2);
    this.#still = this.#ring[0];
    this.#pool.wake();
  }

  // Whatever was learnt of the time that frames take.
  #forget() {
    this.#mean = 0;
    this.#eighths = 8;
    this.#instance.forget();
  }

  // Each display refresh: the latest frame whose time has come.
  #tick() {
    requestAnimationFrame(() => this.#tick());
    if (!this.#pool) return;
    if (this.#still && this.#again && performance.now() - this.#still.began >= HURRY) this.#restart();
    if (this.#still || this.#clock.rests) return;
    const now = this.#clock.running + 0.5 / MOST;
    const due = this.#ring.filter(frame => frame.left === 0 && frame.time <= now);
    if (due.length > 0) {
      const latest = due.reduce((a, b) => (b.time > a.time ? b : a));
      // Whatever is older than the latest one that can be shown is late for good.
      this.#ring = this.#ring.filter(frame => frame.time > latest.time);
      this.#show(latest);
    }
    this.#pool.wake();
  }

  #show(frame) {
    this.#draw(frame, 0, frame.pixels);
    this.#shown = frame;
    this.#stamps.push(performance.now());
    this.dispatchEvent(new Event('frame'));
  }

  // Draws rows of a frame from row `first` on.
  #draw({ request: { width, height } }, first, pixels) {
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      this.#canvas.width = width;
      this.#canvas.height = height;
    }
    const data = new Uint8ClampedArray(pixels.buffer ?? pixels);
    this.#context.putImageData(new ImageData(data, width), 0, first);
  }

  #changed() {
    this.dispatchEvent(new Event('change'));
  }
}

/** The bands of a frame: the first row of each, and the one after its last. */
function bands(height) {
  const count = Math.ceil(height / BAND);
  return Array.from({ length: count }, (_, band) => [BAND * band, Math.min(BAND * (band + 1), height)]);
}
