// The page's start: loads the module, starts the workers, and plays.

import { Controls } from './controls.js';
import { Instance, load, missing } from './module.js';
import { Player } from './player.js';
import { Pool } from './pool.js';
import { Sound } from './sound.js';

// Where a scene stands for whoever wants no motion: the show begins in the dark.
const REST = 9.2;

function trouble(sentence) {
  document.body.classList.remove('loading');
  document.getElementById('status').textContent = '';
  const element = document.getElementById('trouble');
  element.textContent = sentence;
  element.hidden = false;
}

async function start() {
  const lacks = missing();
  if (lacks) return trouble(lacks);
  let player;
  const loading = load(new URL('./paprsek.wasm', import.meta.url));
  const pool = new Pool(loading, navigator.hardwareConcurrency || 1, () => player?.take(), trouble);
  const module = await loading;
  const arrived = performance.now();
  const instance = await Instance.of(module);
  player = new Player(document.getElementById('picture'), instance);
  const sound = new Sound(instance, player);
  const controls = new Controls(player, sound);
  player.addEventListener('frame', () => (paprsek.firstFrame = performance.now() - arrived), { once: true });
  // For the console, and for tests.
  globalThis.paprsek = { instance, player, controls, sound };
  if (matchMedia('(prefers-reduced-motion: reduce)').matches) player.go(REST);
  else player.play();
  player.pool = pool;
}

start().catch(error => trouble(`The page cannot start: ${error.message}`));
