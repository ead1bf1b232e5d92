// The controls: buttons, seek bar, keys and touch, and what they say.

import { fill } from './parameters.js';
import { commandLine, png, save, stillName } from './still.js';

// How far an arrow key moves, seconds.
const SEEK = 5;
// How long controls stay while it plays and nobody touches anything, and how long a word stays, milliseconds.
const QUIET = 3000;
const WORD = 6000;
// How often figures change, milliseconds.
const FIGURES = 500;

const $ = id => document.getElementById(id);

/** Connects everything on the page with a player. */
export class Controls {
  #player;
  #sound;
  #quiet;
  #word;

  constructor(player, sound) {
    this.#player = player;
    this.#sound = sound;
    this.#fillLists();
    this.#scene();
    this.#listen();
    this.#keys();
    player.addEventListener('change', () => this.#update());
    player.addEventListener('frame', () => this.#frame());
    player.addEventListener('trouble', ({ detail }) => this.say(detail));
    setInterval(() => this.#figures(), FIGURES);
    this.#update();
    this.#awake();
  }

  /** Says a sentence for some seconds. */
  say(sentence) {
    $('status').textContent = sentence;
    clearTimeout(this.#word);
    this.#word = setTimeout(() => ($('status').textContent = ''), WORD);
  }

  /** Saves the frame that is shown as a PNG file. */
  async still() {
    try {
      const { image, time, scene } = await this.#player.still();
      const name = stillName(scene, time);
      save(await png(image), name);
      this.say(`Saved ${name}`);
    } catch (error) {
      this.say(error.message);
    }
  }

  /** The command line of the frame that is shown. */
  commandLine() {
    const { scene, quality, values, wholeSize, shownTime } = this.#player;
    return commandLine({ scene: scene.scene, time: Math.floor((shownTime ?? 0) * 1000 + 0.5) / 1000, size: wholeSize, quality, values });
  }

  async copy() {
    const line = this.commandLine();
    try {
      await navigator.clipboard.writeText(line);
      this.say(`Copied: ${line}`);
    } catch {
      // Without https there may be no clipboard; then it can be selected.
      this.say(line);
    }
  }

  async fullScreen() {
    try {
      if (document.fullscreenElement) await document.exitFullscreen();
      else await document.documentElement.requestFullscreen();
    } catch {
      this.say('This browser does not give pages the full screen.');
    }
  }

  /** Opens or closes the parameters. */
  turn(open = $('drawer').hidden) {
    $('drawer').hidden = !open;
    $('turn').setAttribute('aria-expanded', open);
  }

  #mute() {
    this.#sound.toggle();
    this.#update();
  }

  #fillLists() {
    const { scenes, qualities } = this.#player.description;
    $('scene').replaceChildren(...scenes.map(({ scene, about }) => Object.assign(new Option(scene), { title: about })));
    $('quality').replaceChildren(...qualities.map(name => new Option(name)));
    $('quality').value = this.#player.quality;
  }

  // Another scene: its length, its parts, its parameters.
  #scene() {
    const player = this.#player;
    const { scene: name, about, duration } = player.scene;
    this.shown = name;
    $('scene').value = name;
    $('about').textContent = about;
    $('picture').setAttribute('aria-label', `${name}: ${about}`);
    $('seek').max = duration - 0.01;
    $('end').textContent = clock(duration);
    const { parts } = player;
    const buttons = parts.map(({ at, scene }, place) => {
      const button = document.createElement('button');
      Object.assign(button, { type: 'button', textContent: scene, title: `${scene}, ${clock(at)} (${place + 1})` });
      button.setAttribute('aria-label', `Part ${place + 1}: ${scene}`);
      const end = parts[place + 1]?.at ?? duration;
      Object.assign(button.style, { left: `${(100 * at) / duration}%`, width: `${(100 * (end - at)) / duration}%` });
      button.addEventListener('click', () => player.jump(place));
      return button;
    });
    $('parts').replaceChildren(...(parts.length > 1 ? buttons : []));
    fill($('parameters'), player);
  }

  #update() {
    const player = this.#player;
    if (this.shown !== player.scene.scene) this.#scene();
    document.body.classList.toggle('playing', player.playing);
    const does = player.playing ? 'Pause' : 'Play';
    $('play').setAttribute('aria-label', does);
    $('play').title = `${does} (Space)`;
    const silent = this.#sound.silent;
    document.body.classList.toggle('silent', silent);
    const sounds = silent ? 'Sound' : 'Silence';
    $('sound').setAttribute('aria-label', sounds);
    $('sound').title = `${sounds} (M)`;
    this.#time(player.time);
    this.#awake();
  }

  #frame() {
    document.body.classList.remove('loading');
    if ($('status').textContent === 'Loading') $('status').textContent = '';
    if (this.#player.playing) this.#time(this.#player.shownTime);
  }

  #time(time) {
    const { parts, scene } = this.#player;
    $('seek').value = time;
    $('seek').setAttribute('aria-valuetext', `${clock(time)} of ${clock(scene.duration)}`);
    $('now').textContent = clock(time);
    const current = parts.findLastIndex(({ at }) => at <= time);
    [...$('parts').children].forEach((button, place) => {
      if (place === current) button.setAttribute('aria-current', 'true');
      else button.removeAttribute('aria-current');
    });
  }

  #figures() {
    const { rate, pool, shownSize, playing } = this.#player;
    const workers = pool?.workers ?? 0;
    const parts = [`${workers} ${workers === 1 ? 'worker' : 'workers'}`, shownSize.join('x')];
    if (playing) parts.unshift(`${rate} fps`);
    $('figures').textContent = parts.join(' · ');
  }

  #listen() {
    const player = this.#player;
    $('play').addEventListener('click', () => player.toggle());
    $('sound').addEventListener('click', () => this.#mute());
    $('seek').addEventListener('input', () => player.go($('seek').valueAsNumber));
    $('scene').addEventListener('change', () => player.choose($('scene').value));
    $('quality').addEventListener('change', () => player.setQuality($('quality').value));
    $('size').addEventListener('change', () => {
      const { value } = $('size');
      player.setSize(value === 'auto' ? value : value.split('x').map(Number));
    });
    $('turn').addEventListener('click', () => this.turn());
    $('defaults').addEventListener('click', () => {
      for (const name of [...player.values.keys()]) player.setValue(name);
      fill($('parameters'), player);
    });
    $('still').addEventListener('click', () => this.still());
    $('copy').addEventListener('click', () => this.copy());
    $('full').addEventListener('click', () => this.fullScreen());
    $('ask').addEventListener('click', () => $('help').showModal());
    // A tap brings the controls first; a click, or a tap while they are there, pauses.
    let wasQuiet = false;
    $('picture').addEventListener('pointerdown', event => {
      wasQuiet = event.pointerType !== 'mouse' && document.body.classList.contains('quiet');
    });
    $('picture').addEventListener('click', () => {
      if (!wasQuiet) player.toggle();
    });
    for (const kind of ['pointermove', 'pointerdown', 'keydown', 'focusin']) {
      addEventListener(kind, () => this.#awake());
    }
    new ResizeObserver(() => player.resized()).observe($('picture'));
    // Panels end where the controls begin.
    const height = () => document.documentElement.style.setProperty('--controls', `${$('controls').offsetHeight - 12}px`);
    new ResizeObserver(height).observe($('controls'));
    document.addEventListener('visibilitychange', () => (player.hidden = document.hidden));
    player.hidden = document.hidden;
  }

  #keys() {
    const player = this.#player;
    addEventListener('keydown', event => {
      if (event.ctrlKey || event.altKey || event.metaKey || $('help').open) return;
      const { target, key } = event;
      // Lists, sliders and buttons keep the keys that they have.
      if (target instanceof HTMLSelectElement) return;
      const slides = target instanceof HTMLInputElement && target.id !== 'seek';
      const actions = {
        ' ': () => player.toggle(),
        ArrowLeft: () => player.seek(-SEEK),
        ArrowRight: () => player.seek(SEEK),
        m: () => this.#mute(),
        f: () => this.fullScreen(),
        s: () => this.still(),
        c: () => this.copy(),
        p: () => this.turn(),
        '?': () => $('help').showModal(),
        Escape: () => this.turn(false),
      };
      const own = (slides && key.startsWith('Arrow')) || (target instanceof HTMLButtonElement && key === ' ');
      const action = actions[key] ?? actions[key.toLowerCase()];
      if (own) return;
      if (key >= '1' && key <= '9') player.jump(Number(key) - 1);
      else if (action) action();
      else return;
      event.preventDefault();
    });
  }

  // Somebody is there: controls are shown, for a while.
  #awake() {
    document.body.classList.remove('quiet');
    clearTimeout(this.#quiet);
    this.#quiet = setTimeout(() => {
      const busy = $('drawer').hidden === false || $('help').open || document.querySelector('.bar :focus-visible');
      document.body.classList.toggle('quiet', this.#player.playing && !busy);
    }, QUIET);
  }
}

/** Seconds as minutes and seconds. */
function clock(seconds) {
  const whole = Math.floor(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, '0')}`;
}
