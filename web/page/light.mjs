// Environment light: a studio, a day, a user's image; as a map, lamps by median cut, and spherical
// harmonics of the rest.

import { direction, dot, towards } from './vector.mjs';

const [WIDE, HIGH] = [256, 128];

/** Returns the direction of a texel's center, z up. */
const directionAt = (x, y) => {
  const [a, b] = [(x + 0.5) / WIDE * 2 * Math.PI, (y + 0.5) / HIGH * Math.PI];
  return [Math.cos(a) * Math.sin(b), Math.sin(a) * Math.sin(b), Math.cos(b)];
};

const smooth = (low, high, x) => {
  const t = Math.min(Math.max((x - low) / (high - low), 0), 1);
  return t * t * (3 - 2 * t);
};

/** Returns the radiance of a map from a function of direction. */
function mapOf(radiance) {
  const map = new Float32Array(3 * WIDE * HIGH);
  for (let y = 0; y < HIGH; y++) for (let x = 0; x < WIDE; x++) map.set(radiance(directionAt(x, y)), 3 * (y * WIDE + x));
  return map;
}

/** Soft boxes in a dim room: centers, half width and height as tangents, radiance. */
function studio(turn) {
  const boxes = [
    [-60, 58, 0.75, 0.4, 9], [50, 22, 0.16, 0.75, 11], [165, 25, 0.5, 0.35, 3.5], [-150, 35, 0.12, 0.7, 6],
  ].map(([around, height, wide, high, radiance]) => {
    const n = towards(around + turn, height), u = direction([-n[1], n[0], 0]);
    return { n, u, v: [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]], wide, high, radiance };
  });
  return mapOf(d => {
    let sum = 0.1 + 0.22 * smooth(-0.3, 1, d[2]);
    for (const { n, u, v, wide, high, radiance } of boxes) {
      const c = dot(d, n);
      if (c < 0.1) continue;
      const edge = (x, half) => 1 - smooth(half - 0.03, half + 0.03, Math.abs(x));
      sum += radiance * edge(dot(d, u) / c, wide) * edge(dot(d, v) / c, high);
    }
    return [sum, sum, sum * 1.02];
  });
}

/** A clear sky with its sun, over dry ground. */
function day(turn, height) {
  const sun = towards(turn, height), low = smooth(25, 2, height), colour = [1, 0.94 - 0.3 * low, 0.86 - 0.55 * low];
  const bright = 0.35 + 0.65 * smooth(-4, 30, height);
  return mapOf(d => {
    const c = dot(d, sun), glow = Math.max(c, 0) ** 24, up = Math.max(d[2], 0), haze = (1 - up) ** 4;
    // Three degrees wide instead of half a degree, so that the map resolves it; with the same total
    // brightness.
    const disc = smooth(Math.cos(0.032), Math.cos(0.02), c) * 4000 * smooth(-3, 3, height);
    const sky = [0.16 + 0.55 * haze, 0.33 + 0.5 * haze, 0.75 + 0.15 * haze], ground = [0.3, 0.27, 0.22];
    const share = smooth(-0.02, 0.02, d[2]);
    return [0, 1, 2].map(k => (bright * (sky[k] * share + ground[k] * (1 - share)) + share * colour[k] * (disc + 1.2 * glow)));
  });
}

/** An environment image, from the upper left at +x, rotated. */
function turned({ width, height, data }, turn) {
  const map = new Float32Array(3 * WIDE * HIGH), shift = turn / 360 * width;
  for (let y = 0; y < HIGH; y++) {
    const rows = [Math.floor(y * height / HIGH), Math.max(Math.ceil((y + 1) * height / HIGH), Math.floor(y * height / HIGH) + 1)];
    for (let x = 0; x < WIDE; x++) {
      const first = Math.floor(x * width / WIDE - shift), count = Math.max(1, Math.ceil(width / WIDE)), sum = [0, 0, 0];
      for (let j = rows[0]; j < rows[1]; j++) {
        for (let i = first; i < first + count; i++) {
          // Azimuth increases to the left in an image viewed from inside.
          const column = width - 1 - (((i % width) + width) % width);
          for (let k = 0; k < 3; k++) sum[k] += data[3 * (j * width + column) + k];
        }
      }
      map.set(sum.map(s => s / (count * (rows[1] - rows[0]))), 3 * (y * WIDE + x));
    }
  }
  return map;
}

/** Packs texels of a map: nine bits per color, five of the exponent. */
function packed(map) {
  const words = new Uint32Array(WIDE * HIGH);
  for (let i = 0; i < words.length; i++) {
    const [r, g, b] = map.subarray(3 * i, 3 * i + 3), most = Math.min(Math.max(r, g, b, 1e-7), 60000);
    const exponent = Math.min(Math.max(Math.floor(Math.log2(most)) + 16, 0), 31), unit = 2 ** (24 - exponent);
    const bits = x => Math.min(Math.round(Math.max(x, 0) * unit), 511);
    words[i] = (bits(r) | (bits(g) << 9) | (bits(b) << 18) | (exponent << 27)) >>> 0;
  }
  return words;
}

const luminance = (r, g, b) => 0.2126 * r + 0.7152 * g + 0.0722 * b;

/**
 * Returns the map's light for the shaders: words of the map, and a uniform of harmonics and at most
 * `most` lamps.
 */
function lightOf(map, most) {
  const cells = WIDE * HIGH, energy = new Float64Array(cells);
  const area = y => 2 * Math.PI / WIDE * (Math.cos(y / HIGH * Math.PI) - Math.cos((y + 1) / HIGH * Math.PI));
  let mean = 0;
  for (let i = 0; i < cells; i++) mean += luminance(...map.subarray(3 * i, 3 * i + 3)) * area(Math.floor(i / WIDE)) / (4 * Math.PI);
  const limit = 1.5 * mean, uniform = new Float32Array(9 * 4 + 16 * 8), rest = new Float32Array(3 * cells);
  for (let i = 0; i < cells; i++) {
    const y = Math.floor(i / WIDE), [r, g, b] = map.subarray(3 * i, 3 * i + 3), l = luminance(r, g, b), dw = area(y);
    const lamp = l > limit ? 1 - limit / l : 0, d = directionAt(i % WIDE, y);
    rest.set([r * lamp, g * lamp, b * lamp], 3 * i);
    energy[i] = l * lamp * dw;
    // Higher bands are damped, so that no direction is negative.
    const basis = [
      0.2820948, 0.4886025 * d[1], 0.4886025 * d[2], 0.4886025 * d[0], 1.0925484 * d[0] * d[1], 1.0925484 * d[1] * d[2],
      0.31539157 * (3 * d[2] * d[2] - 1), 1.0925484 * d[0] * d[2], 0.54627422 * (d[0] * d[0] - d[1] * d[1])];
    [r, g, b].forEach((x, k) => basis.forEach((f, j) => { uniform[4 * j + k] += x * (1 - lamp) * f * dw * (j === 0 ? 1 : j < 4 ? 0.8 : 0.4); }));
  }
  const regionOf = (x0, y0, x1, y1) => {
    let total = 0;
    for (let y = y0; y < y1; y++) for (let x = x0; x < x1; x++) total += energy[y * WIDE + x];
    const wide = (x1 - x0) * Math.sin((y0 + y1) / 2 / HIGH * Math.PI), worth = Math.max(wide, y1 - y0) > 5 ? total * Math.max(wide, y1 - y0) : 0;
    return { x0, y0, x1, y1, total, wide, worth };
  };
  // The region with the largest product of light and width is split at half of its light.
  const regions = [regionOf(0, 0, WIDE, HIGH)];
  while (regions.length < most) {
    regions.sort((a, b) => b.worth - a.worth);
    const { x0, y0, x1, y1, total, wide, worth } = regions[0];
    if (!(worth > 0)) break;
    regions.shift();
    const across = x1 - x0 > 1 && (wide >= y1 - y0 || y1 - y0 < 2);
    let [half, at] = [0, across ? x0 : y0];
    const end = (across ? x1 : y1) - 1;
    for (; at < end; at++) {
      if (across) for (let y = y0; y < y1; y++) half += energy[y * WIDE + at];
      else for (let x = x0; x < x1; x++) half += energy[at * WIDE + x];
      if (half >= total / 2) { at++; break; }
    }
    regions.push(...(across ? [regionOf(x0, y0, at, y1), regionOf(at, y0, x1, y1)] : [regionOf(x0, y0, x1, at), regionOf(x0, at, x1, y1)]));
  }
  const lamps = regions.filter(({ total }) => total > 1e-6 * mean).map(({ x0, y0, x1, y1 }) => {
    let [middle, irradiance] = [[0, 0, 0], [0, 0, 0]];
    for (let y = y0; y < y1; y++) {
      for (let x = x0; x < x1; x++) {
        const i = y * WIDE + x;
        if (!(energy[i] > 0)) continue;
        const d = directionAt(x, y);
        for (let k = 0; k < 3; k++) {
          middle[k] += d[k] * energy[i];
          irradiance[k] += rest[3 * i + k] * area(y);
        }
      }
    }
    return { middle: direction(middle), irradiance };
  });
  lamps.forEach(({ middle, irradiance }, k) => uniform.set([...middle, 0, ...irradiance, 0], 36 + 8 * k));
  return { words: packed(map), uniform, lamps: lamps.length, mean };
}

/** Returns the light of settings; `own` is the user's image, if any. */
export function lightFor(settings, own) {
  const { light, lightTurn, lightHeight, lamps } = settings;
  const map = light === 'own' && own ? turned(own, lightTurn) : light === 'day' ? day(lightTurn, lightHeight) : studio(lightTurn);
  return lightOf(map, +lamps);
}

/** Decodes a Radiance image (.hdr) as floats, from the top. */
export function readRadiance(buffer, name) {
  const bytes = new Uint8Array(buffer), bad = what => new Error(`${name} ${what}.`);
  let at = 0;
  const line = () => {
    const end = bytes.indexOf(10, at);
    if (end < 0 || end - at > 4096) throw bad('is not a Radiance image');
    const text = new TextDecoder().decode(bytes.subarray(at, end));
    at = end + 1;
    return text;
  };
  if (!line().startsWith('#?')) throw bad('is not a Radiance image');
  for (let text = line(); text !== ''; text = line()) {
    if (text.startsWith('FORMAT=') && text !== 'FORMAT=32-bit_rle_rgbe') throw bad(`has the unsupported format ${text.slice(7)}`);
  }
  const size = /^-Y (\d+) \+X (\d+)$/.exec(line().trim());
  if (!size) throw bad('has an unsupported orientation');
  const [height, width] = [+size[1], +size[2]];
  if (!(width > 0 && height > 0 && width * height <= 4e7)) throw bad(`has ${width} by ${height} pixels`);
  const data = new Float32Array(3 * width * height), row = new Uint8Array(4 * width);
  const next = () => {
    if (at >= bytes.length) throw bad('is truncated');
    return bytes[at++];
  };
  for (let y = 0; y < height; y++) {
    if (width >= 8 && width < 32768 && bytes[at] === 2 && bytes[at + 1] === 2 && bytes[at + 2] < 128) {
      at += 4;
      for (let k = 0; k < 4; k++) {
        for (let x = 0; x < width;) {
          const count = next(), run = count > 128, value = run ? next() : 0;
          if (count === 0 || x + (run ? count - 128 : count) > width) throw bad('has a row that is too long');
          for (let n = run ? count - 128 : count; n > 0; n--) row[4 * x++ + k] = run ? value : next();
        }
      }
    } else {
      for (let i = 0; i < 4 * width; i++) row[i] = next();
    }
    for (let x = 0; x < width; x++) {
      const factor = row[4 * x + 3] ? 2 ** (row[4 * x + 3] - 136) : 0;
      for (let k = 0; k < 3; k++) data[3 * (y * width + x) + k] = row[4 * x + k] * factor;
    }
  }
  return { width, height, data };
}

/** Reads an environment image: Radiance, or any format that the browser supports. */
export async function readLight(file) {
  if (/\.(hdr|pic|rgbe)$/i.test(file.name)) return readRadiance(await file.arrayBuffer(), file.name);
  let picture;
  try {
    picture = await createImageBitmap(file);
  } catch {
    throw new Error(`${file.name} is not a supported image (Radiance .hdr, PNG or JPEG).`);
  }
  const width = Math.min(picture.width, 1024), height = Math.min(picture.height, 512);
  const context = new OffscreenCanvas(width, height).getContext('2d');
  context.drawImage(picture, 0, 0, width, height);
  const bytes = context.getImageData(0, 0, width, height).data, data = new Float32Array(3 * width * height);
  for (let i = 0; i < width * height; i++) for (let k = 0; k < 3; k++) data[3 * i + k] = linear(bytes[4 * i + k] / 255);
  return { width, height, data };
}

/** Converts an sRGB value, 0 to 1, to linear. */
export const linear = x => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;

/** Converts a linear value to sRGB. */
export const encoded = x => x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
