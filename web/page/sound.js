// The show's sound: samples that the module computes, in pieces, a little ahead of when they are heard.
//
// The sound leads, as in the program: the page's time follows what is heard, and where one jumps the sound jumps too.

// Samples per second, and in a piece.
const RATE = 44100;
const PIECE = 8192;
// How far ahead pieces are put in their place, seconds: longer than anything else keeps the page busy.
const AHEAD = 0.5;
// How often it is looked whether one is due, milliseconds.
const LOOK = 50;
// How far the sound may be from the page's time before it jumps, seconds, and the share of less by which time follows.
const APART = 0.08;
const NEARER = 0.05;

export class Sound {
  #instance;
  #player;
  #context;
  // The pieces that are heard or will be.
  #pieces = new Set();
  // The next sample of the show, and the second of the context's time at which it begins; none while all is silent.
  #next;
  #at;
  /** Whether silence was asked for. */
  silent = false;
  /** How often the sound has begun or jumped, and how far it was from the page's time at the last look, seconds. */
  jumps = 0;
  apart = 0;

  constructor(instance, player) {
    this.#instance = instance;
    this.#player = player;
    setInterval(() => this.#look(), LOOK);
    player.addEventListener('change', () => this.#look());
    // Browsers let a page sound once somebody has touched it.
    for (const kind of ['pointerdown', 'keydown']) addEventListener(kind, () => this.#wake(), { capture: true });
  }

  /** Whether there is sound. */
  get sounds() {
    return this.#next !== undefined;
  }

  toggle() {
    this.silent = !this.silent;
    this.#look();
  }

  #wake() {
    // Without a device there may be no context: then the page is silent.
    try {
      this.#context ??= new AudioContext({ sampleRate: RATE, latencyHint: 'interactive' });
      if (this.#context.state === 'suspended') this.#context.resume().catch(() => {});
    } catch {
      this.#context = undefined;
    }
  }

  #look() {
    const context = this.#context;
    const player = this.#player;
    if (context?.state !== 'running' || this.silent || !player.runs || !player.isShow) return this.#stop();
    // The second of the show at which what leaves the context now should be: it is heard a little later.
    const due = player.time + (context.outputLatency || context.baseLatency || 0);
    if (this.#next !== undefined) {
      this.apart = this.#next / RATE - (this.#at - context.currentTime) - due;
      if (Math.abs(this.apart) > APART || this.#at < context.currentTime) this.#stop();
      else player.follow(this.apart * NEARER);
    }
    if (this.#next === undefined) {
      this.#at = context.currentTime + 0.02;
      this.#next = Math.round((due + 0.02) * RATE);
      this.jumps += 1;
    }
    while (this.#at < context.currentTime + AHEAD) this.#put();
  }

  // Puts the next piece in its place.
  #put() {
    const samples = this.#instance.sound(this.#next, PIECE);
    const buffer = this.#context.createBuffer(2, PIECE, RATE);
    for (const ear of [0, 1]) {
      const channel = buffer.getChannelData(ear);
      for (let i = 0; i < PIECE; i += 1) channel[i] = samples[2 * i + ear] / 32768;
    }
    const piece = this.#context.createBufferSource();
    piece.buffer = buffer;
    piece.connect(this.#context.destination);
    piece.addEventListener('ended', () => this.#pieces.delete(piece));
    piece.start(this.#at);
    this.#pieces.add(piece);
    this.#next += PIECE;
    this.#at += PIECE / RATE;
  }

  #stop() {
    for (const piece of this.#pieces) piece.stop();
    this.#pieces.clear();
    this.#next = undefined;
  }
}
