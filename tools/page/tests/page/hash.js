// The hash of a frame of four bytes per pixel as the table of kept frames has it: FNV-1a of 64 bits over pixels 0RGB, the
// lowest byte first.
(pixels => {
  let hash = 0xcbf29ce484222325n;
  for (let at = 0; at < pixels.length; at += 4) {
    for (const byte of [pixels[at + 2], pixels[at + 1], pixels[at], 0]) {
      hash = BigInt.asUintN(64, (hash ^ BigInt(byte)) * 0x100000001b3n);
    }
  }
  return hash.toString(16).padStart(16, '0');
})
