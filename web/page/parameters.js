// The scene's parameters as sliders, from their table.

// Positions of a slider.
const STEPS = 200;

/** Fills an element with a slider for each of the scene's parameters. */
export function fill(element, player) {
  const { parameters } = player.scene;
  const rows = parameters.map(parameter => row(parameter, player));
  element.replaceChildren(...(rows.length > 0 ? rows : [none()]));
}

function none() {
  const text = document.createElement('p');
  text.textContent = 'This scene has none.';
  return text;
}

function row({ name, unit, least, most, default: usual, about }, player) {
  const element = document.createElement('div');
  element.className = 'parameter';
  const label = document.createElement('label');
  label.htmlFor = `parameter-${name}`;
  label.textContent = name;
  const value = document.createElement('output');
  const slider = document.createElement('input');
  Object.assign(slider, { type: 'range', id: label.htmlFor, min: least, max: most, step: step(unit, least, most) });
  const text = document.createElement('p');
  text.id = `about-${name}`;
  text.textContent = about;
  slider.setAttribute('aria-describedby', text.id);
  const show = () => {
    const now = player.values.get(name) ?? usual;
    slider.value = now;
    value.textContent = words(now, unit);
    slider.setAttribute('aria-valuetext', value.textContent);
    element.classList.toggle('turned', player.values.has(name));
  };
  slider.addEventListener('input', () => {
    const turned = slider.valueAsNumber;
    player.setValue(name, turned === usual ? undefined : turned);
    show();
  });
  show();
  element.append(label, value, slider, text);
  return element;
}

/** A round step with some STEPS positions between the ends. */
function step(unit, least, most) {
  if (unit === 'count') return 1;
  return 10 ** Math.floor(Math.log10((most - least) / STEPS));
}

function words(value, unit) {
  const number = Number(value.toPrecision(6)).toString();
  return unit === '1' || unit === 'count' ? number : `${number} ${unit}`;
}
