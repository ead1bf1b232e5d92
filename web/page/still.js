// Stills: a frame as a PNG file, and the command line that renders the same one.

/** The name that the program gives a still, but for the ending. */
export function stillName(scene, time) {
  return `paprsek-${scene}-${time.toFixed(3)}.png`;
}

/** What a canvas takes, as a PNG file. Its pixels are opaque, so no byte of them changes on the way. */
export function png(image) {
  const canvas = document.createElement('canvas');
  canvas.width = image.width;
  canvas.height = image.height;
  canvas.getContext('2d', { alpha: false }).putImageData(image, 0, 0);
  return new Promise((resolve, reject) => {
    canvas.toBlob(blob => (blob ? resolve(blob) : reject(new Error('The picture is too large for a PNG file here.'))), 'image/png');
  });
}

/** Hands a file to whoever looks at the page. */
export function save(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  // The browser reads it after this.
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

/** The command line that renders the frame of that time, seconds, of that width and height. */
export function commandLine({ scene, time, size: [width, height], quality, values }) {
  const set = [...values].map(([name, value]) => ` --set ${name}=${plain(value)}`);
  return `paprsek ${scene} --at ${plain(time)} --size ${width}x${height} --quality ${quality}${set.join('')}`;
}

/** A number without an exponent, which the program's command line does not take. */
function plain(value) {
  return Number(value.toFixed(6)).toString();
}
