// A painted density: a square of texels over the disk of normals, edited by pointer, keys, or from
// an image.

import { element } from './controls.mjs';

const SIDE = 40;
const LEVELS = 15;
const ALPHABET = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_';

/**
 * The editor of a painted density; `onchange(text)` is called for strokes, `onerror(error)` for
 * unreadable images.
 */
export class Painting {
  constructor() {
    this.side = SIDE;
    this.texels = new Uint8Array(SIDE * SIDE);
    this.cursor = [SIDE / 2, SIDE / 2];
    this.start('lobes');
    this.initial = this.text();
  }

  /** Returns texels as a density, bottom row first as in the crate. */
  density() {
    const texels = new Float32Array(SIDE * SIDE);
    for (let j = 0; j < SIDE; j++) {
      for (let i = 0; i < SIDE; i++) texels[j * SIDE + i] = (this.texels[(SIDE - 1 - j) * SIDE + i] / LEVELS) ** 2;
    }
    return { side: SIDE, texels };
  }

  /** Encodes the painting in a link: three texels in two letters. */
  text() {
    let text = '';
    for (let k = 0; k < SIDE * SIDE; k += 3) {
      const [a, b, c] = [0, 1, 2].map(i => this.texels[k + i] ?? 0), all = a << 8 | b << 4 | c;
      text += ALPHABET[all >> 6] + ALPHABET[all & 63];
    }
    return text;
  }

  /** Displays a link's painting, or the default painting. */
  show(text) {
    const wanted = text || this.initial;
    if (wanted === this.text()) return;
    for (let k = 0; 2 * k < wanted.length; k++) {
      const all = Math.max(0, ALPHABET.indexOf(wanted[2 * k])) << 6 | Math.max(0, ALPHABET.indexOf(wanted[2 * k + 1] ?? 'A'));
      [all >> 8, all >> 4 & 15, all & 15].forEach((level, i) => { if (3 * k + i < this.texels.length) this.texels[3 * k + i] = level; });
    }
    this.draw();
  }

  start(kind) {
    const lobe = (x, y, a, b, w) => Math.exp(-((x - a) ** 2 + (y - b) ** 2) / (w * w));
    const kinds = {
      lobes: (x, y) => lobe(x, y, 0, 0, 0.14) + 0.7 * lobe(x, y, 0.4, 0.1, 0.12) + 0.7 * lobe(x, y, -0.35, -0.25, 0.12),
      ring: (x, y) => lobe(Math.hypot(x, y), 0, 0.5, 0, 0.12),
      cross: (x, y) => lobe(x, 0, 0, 0, 0.07) * lobe(y, 0, 0, 0, 0.5) + lobe(y, 0, 0, 0, 0.07) * lobe(x, 0, 0, 0, 0.5),
      black: () => 0,
    };
    this.fill((x, y) => kinds[kind](x, y));
  }

  /** Sets texels from a function of the normal's x and y, scaled to its maximum. */
  fill(value) {
    const at = k => (2 * k + 1) / SIDE - 1, values = [];
    for (let j = 0; j < SIDE; j++) for (let i = 0; i < SIDE; i++) values.push(Math.hypot(at(i), at(j)) < 1 ? value(at(i), -at(j)) : 0);
    const most = values.reduce((a, b) => Math.max(a, b), 1e-9);
    values.forEach((x, k) => { this.texels[k] = Math.round(LEVELS * Math.sqrt(Math.max(0, x) / most)); });
    this.draw();
  }

  stroke(x, y, level) {
    const [i, j] = [x, y].map(Math.floor);
    for (let v = j - 2; v <= j + 2; v++) {
      for (let u = i - 2; u <= i + 2; u++) {
        const far = Math.hypot(u - i, v - j);
        if (u < 0 || v < 0 || u >= SIDE || v >= SIDE || far > 2.3) continue;
        const k = v * SIDE + u;
        this.texels[k] = Math.max(0, Math.min(LEVELS, this.texels[k] + Math.round(level * (1 - far / 3))));
      }
    }
    this.draw();
    this.onchange(this.text());
  }

  /** Sets the density from an image's gray values, or from the normals of a normal map. */
  async read(file) {
    const picture = await createImageBitmap(file).catch(() => { throw new Error(`${file.name} is not an image that this browser supports.`); });
    if (!picture.width || !picture.height) throw new Error(`${file.name} has no pixels.`);
    const size = Math.min(512, Math.max(picture.width, picture.height)), canvas = new OffscreenCanvas(size, size), context = canvas.getContext('2d');
    context.drawImage(picture, 0, 0, size, size);
    const { data } = context.getImageData(0, 0, size, size);
    let [coloured, count] = [0, 0];
    for (let k = 0; k < data.length; k += 4) { coloured += data[k + 2] > 1.2 * Math.max(1, Math.min(data[k], data[k + 1])); count++; }
    const cells = new Float32Array(SIDE * SIDE);
    for (let k = 0; k < data.length; k += 4) {
      const at = k / 4;
      // Most pixels of a normal map are blue, because normals are tilted little.
      const [i, j, weight] = coloured > 0.8 * count
        ? [Math.floor(data[k] / 256 * SIDE), Math.floor((255 - data[k + 1]) / 256 * SIDE), 1]
        : [Math.floor(at % size / size * SIDE), Math.floor(Math.floor(at / size) / size * SIDE), data[k] + data[k + 1] + data[k + 2]];
      cells[j * SIDE + i] += weight;
    }
    const cell = (x, y) => cells[Math.floor((1 - y) / 2 * SIDE) * SIDE + Math.floor((x + 1) / 2 * SIDE)];
    this.fill(cell);
    this.onchange(this.text());
  }

  draw() {
    if (!this.canvas) return;
    const context = this.canvas.getContext('2d'), image = context.createImageData(SIDE, SIDE);
    this.texels.forEach((level, k) => image.data.set([17 * level, 17 * level, 17 * level, 255], 4 * k));
    context.putImageData(image, 0, 0);
    if (document.activeElement === this.canvas) {
      context.strokeStyle = '#e07020';
      context.strokeRect(this.cursor[0] - 2, this.cursor[1] - 2, 4, 4);
    }
  }

  element() {
    this.canvas = element('canvas', {
      id: 'painting', width: SIDE, height: SIDE, tabindex: 0, role: 'application',
      'aria-label': 'The normal density as a painting. Paint with the pointer, or move with the arrow keys, paint with Space, erase with Delete.',
    });
    const at = event => {
      const box = this.canvas.getBoundingClientRect();
      return [(event.clientX - box.left) / box.width * SIDE, (event.clientY - box.top) / box.height * SIDE];
    };
    const paint = event => { if (event.buttons) this.stroke(...at(event), event.shiftKey || event.buttons > 1 ? -5 : 5); };
    this.canvas.addEventListener('pointerdown', event => { this.canvas.setPointerCapture(event.pointerId); paint(event); });
    this.canvas.addEventListener('pointermove', paint);
    this.canvas.addEventListener('contextmenu', event => event.preventDefault());
    this.canvas.addEventListener('keydown', event => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (step) {
        this.cursor = this.cursor.map((x, k) => Math.max(0, Math.min(SIDE - 1, x + step[k])));
        this.draw();
      } else if (event.key === ' ') this.stroke(...this.cursor, 5);
      else if (event.key === 'Delete' || event.key === 'Backspace') this.stroke(...this.cursor, -5);
      else return;
      event.preventDefault();
    });
    for (const name of ['focus', 'blur']) this.canvas.addEventListener(name, () => this.draw());
    const start = element('select', { id: 'painting-start' },
      ...[['', 'Start from …'], ['lobes', 'Three lobes'], ['ring', 'A ring'], ['cross', 'A cross'], ['black', 'Nothing']].map(([value, text]) => element('option', { value }, text)));
    start.addEventListener('change', () => { if (start.value) { this.start(start.value); this.onchange(this.text()); } start.value = ''; });
    const picture = element('input', { type: 'file', id: 'painting-file', accept: 'image/*' });
    picture.addEventListener('change', async () => {
      try { if (picture.files[0]) await this.read(picture.files[0]); } catch (error) { this.onerror(error); }
      picture.value = '';
    });
    queueMicrotask(() => this.draw());
    return element('div', { class: 'painting' }, this.canvas,
      element('div', { class: 'field' }, element('label', { for: 'painting-start' }, 'Painting'), start),
      element('div', { class: 'field' }, element('label', { for: 'painting-file' }, 'An image or a normal map as density'), picture));
  }
}
