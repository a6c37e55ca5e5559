// The page: scenes, settings in the link, rendering on change only.

import { loadData } from './data.mjs';
import { loadRust } from './rust.mjs';
import { openGpu, wgslOf } from './gpu.mjs';
import { fields, linkOf, settingsOf } from './controls.mjs';
import { bumps } from './bumps.mjs';
import { fractals } from './fractals.mjs';
import { noise } from './noise.mjs';
import { materials } from './materials.mjs';

const SCENES = [bumps, noise, fractals, materials];
const PAPER = [236 / 255, 234 / 255, 228 / 255];
/** Maximum time of a frame during movement, in ms. */
const FRAME = 25;
/** Maximum time of a band of a final image. */
const BAND = 120;
/** Maximum time of a supersampled image. */
const REST = 500;

const by = id => document.getElementById(id);
const asked = new URLSearchParams(location.search);

/** The interface of scenes: the GPU, the crates, the settings. */
class Page {
  constructor(data, rust) {
    Object.assign(this, { data, rust, extra: by('extra'), form: by('settings'), perPixel: 1e-3, change: 0 });
    this.strip = asked.has('strip') ? +asked.get('strip') : undefined;
  }

  /** Opens the GPU on a new canvas, because the old canvas's context cannot be replaced. */
  async openGpu() {
    const canvas = by('view').cloneNode();
    by('view').replaceWith(canvas);
    this.canvas = canvas;
    this.gpu = await openGpu(this.data, canvas, asked.get('api'));
    this.target = null;
    if (!this.gpu) {
      by('state').textContent = '';
      return;
    }
    listen(this, canvas);
    const mine = this.gpu;
    mine.lost.then(async () => {
      if (this.gpu !== mine) return;
      await this.openGpu();
      this.complain(new Error('The GPU was lost, and opened again.'));
      await this.show(this.scene, this.settings);
    });
  }

  /** Opens a scene with settings. */
  async show(scene, settings) {
    this.instance?.close?.();
    this.extra.replaceChildren();
    Object.assign(this, { scene, settings });
    this.instance = await scene.open(this);
    by('title').textContent = scene.title;
    by('about').textContent = scene.about;
    by('keys').textContent = scene.keys ?? '';
    document.title = `${scene.title} · Asperity`;
    for (const link of by('scenes').children) {
      if (link.dataset.scene === scene.id) link.setAttribute('aria-current', 'page'); else link.removeAttribute('aria-current');
    }
    this.setFields = fields(scene, this.form, settings, (name, value) => this.set({ [name]: value }, true));
    this.canvas.hidden = Boolean(this.instance.element);
    const still = !this.gpu && !this.instance.element;
    document.body.classList.toggle('no-gpu', still);
    if (still) by('state').textContent = '';
    by('save').hidden = !this.gpu && !this.instance.pixels;
    document.body.classList.remove('waiting');
    by('own').replaceChildren(...(this.instance.element ? [this.instance.element] : []));
    this.changed();
  }

  /** Applies new settings, from a control or from dragging the image. */
  set(values, fromField = false) {
    Object.assign(this.settings, values);
    if (!fromField) this.setFields(this.settings);
    this.complaint = '';
    this.changed();
  }

  changed() {
    this.change++;
    const link = linkOf(this.scene, this.settings);
    clearTimeout(this.linking);
    this.linking = setTimeout(() => history.replaceState(null, '', link), 120);
    this.resting ??= [];
    this.draw();
  }

  /** Displays one sentence. */
  complain(error) {
    this.complaint = String(error.message ?? error).split('\n')[0];
    by('state').textContent = this.complaint;
  }

  /** Renders changes, small at first if the whole would take too long, then whole. */
  async draw() {
    if (this.drawing) return;
    this.drawing = true;
    try {
      for (let done = -1; done !== this.change;) {
        done = this.change;
        await this.frame(done);
      }
    } catch (error) {
      this.complain(error);
    }
    this.drawing = false;
    for (const rested of this.resting.splice(0)) rested();
  }

  async frame(change) {
    const { scene, instance, settings } = this, stop = () => this.change !== change || this.instance !== instance;
    if (instance.paint) {
      await instance.paint(settings, stop);
      if (!stop()) this.say('');
    } else if (this.gpu) {
      const full = this.full(), fine = asked.has('size') || devicePixelRatio > 1 ? full : 2 * full;
      const quick = Math.min(full, Math.max(64, 32 * Math.floor(Math.sqrt(FRAME / this.perPixel) / 32)));
      await this.picture(quick, quick, stop);
      for (const size of [full, fine]) {
        // Idle: render the whole image in bands, antialiased if twice as many pixels are fast
        // enough.
        if (size <= this.target.width || (size > full && size * size * this.perPixel > REST)) continue;
        if (!stop()) await new Promise(resolve => setTimeout(resolve, 150));
        if (!stop()) await this.picture(size, Math.max(16, Math.floor(BAND / this.perPixel / size)), stop);
      }
    }
    if (this.canvas && instance.alt) (instance.element ?? this.canvas).setAttribute('aria-label', instance.alt(settings));
    by('wgsl').hidden = !instance.program;
    by('rust').hidden = !instance.rustCode;
    if (!stop()) await instance.after?.(settings, stop);
    this.drawn = { scene: scene.id, change };
  }

  /** Side of the final image in pixels. */
  full(canvas = this.canvas) {
    if (asked.has('size')) return +asked.get('size');
    const side = canvas.getBoundingClientRect().width * Math.min(devicePixelRatio, 2);
    return Math.max(64, Math.min(1024, Math.round(side)));
  }

  async picture(size, rows, stop) {
    const { gpu, instance, settings } = this;
    const passes = instance.passes(settings, size);
    await Promise.all(passes.map(({ program }) => gpu.program(program)));
    if (this.target?.width !== size || this.target?.gpu !== gpu) {
      if (this.target?.gpu === gpu) this.target.free();
      this.target = Object.assign(gpu.target(size, size), { gpu });
    }
    const start = performance.now();
    for (let y = 0; y < size; y += rows) {
      if (y > 0 && stop()) return;
      const height = Math.min(rows, size - y);
      for (const [k, pass] of passes.entries()) {
        await gpu.draw(this.target, { ...pass, clear: y === 0 && k === 0 && (instance.background ?? PAPER), box: [0, y, size, height] });
      }
      await gpu.done();
      gpu.show(this.target);
    }
    const ms = performance.now() - start;
    this.perPixel = ms / (size * size);
    this.say(`${size} × ${size} in ${ms.toFixed(1)} ms`);
  }

  say(text) {
    const more = this.instance.say?.(this.settings);
    by('state').textContent = this.complaint || [this.instance.element ? 'WebAssembly' : this.gpu?.name, text, more].filter(Boolean).join(' · ');
  }

  /** Pointer handling of a scene's element. */
  hands(canvas, acts) { listen(this, canvas, () => acts); }

  /** Resolves when everything is rendered. */
  rest() {
    return this.drawing ? new Promise(resolve => this.resting.push(resolve)) : Promise.resolve();
  }

  /** Returns the pixels of the final image, from the top. */
  async pixels() {
    await this.rest();
    if (this.instance.pixels) return this.instance.pixels();
    const { width, height } = this.target;
    return { width, height, data: await this.gpu.pixels(this.target) };
  }
}

/** Pointer and keyboard handling of the image: drag, pinch, wheel, keys. */
function listen(page, canvas, acts = () => page.instance) {
  const pointers = new Map();
  const act = values => { if (values && Object.keys(values).length) page.set(values); };
  const place = event => {
    const box = canvas.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width * 2 - 1, 1 - (event.clientY - box.top) / box.height * 2];
  };
  canvas.addEventListener('pointerdown', event => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
  });
  for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, event => pointers.delete(event.pointerId));
  const apart = () => { const [a, b] = [...pointers.values()]; return Math.hypot(a[0] - b[0], a[1] - b[1]); };
  canvas.addEventListener('pointermove', event => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = pointers.size > 1 ? apart() : 0, side = canvas.getBoundingClientRect().width;
    pointers.set(event.pointerId, [event.clientX, event.clientY]);
    if (pointers.size > 1) act(acts().nearer?.(apart() / Math.max(before, 1), page.settings));
    const share = 1 / (side * pointers.size);
    act(acts().drag?.((event.clientX - last[0]) * share, (event.clientY - last[1]) * share, event.shiftKey || pointers.size > 1, page.settings));
  });
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    act(acts().nearer?.(Math.exp(-event.deltaY / 400), page.settings, ...place(event)));
  }, { passive: false });
  canvas.addEventListener('dblclick', event => {
    act(acts().pick?.(...place(event), page.settings));
  });
  canvas.addEventListener('keydown', event => {
    const step = { ArrowLeft: [-0.04, 0], ArrowRight: [0.04, 0], ArrowUp: [0, -0.04], ArrowDown: [0, 0.04] }[event.key];
    const factor = { '+': 1.25, '=': 1.25, '-': 0.8 }[event.key];
    if (step) act(acts().drag?.(...step, event.shiftKey, page.settings));
    else if (factor) act(acts().nearer?.(factor, page.settings));
    else return;
    event.preventDefault();
  });
}

async function copied(text, what) {
  try {
    await navigator.clipboard.writeText(text);
    by('state').textContent = `${what} copied to the clipboard.`;
  } catch {
    by('text').value = text;
    by('copy').showModal();
    by('text').select();
  }
}

/** Returns scene and settings of the URL. */
function addressed() {
  const [id, words] = location.hash.slice(1).split('?');
  const scene = SCENES.find(scene => scene.id === id) ?? SCENES[0];
  return [scene, settingsOf(scene, words)];
}

async function begin() {
  const data = await loadData();
  const page = new Page(data, await loadRust(data.wasm));
  for (const scene of SCENES) {
    const link = document.createElement('a');
    link.href = `#${scene.id}`;
    link.dataset.scene = scene.id;
    link.textContent = scene.short;
    by('scenes').append(link);
  }
  await page.openGpu();
  addEventListener('hashchange', () => page.show(...addressed()));
  addEventListener('resize', () => page.changed());
  addEventListener('dragover', event => event.preventDefault());
  addEventListener('drop', event => {
    event.preventDefault();
    const file = event.dataTransfer.files[0];
    if (file && page.instance.drop) page.instance.drop(file);
    else if (file) page.complain(new Error(`${file.name}: this scene does not accept files.`));
  });
  const copies = {
    link: ['The link', () => location.href.split('#')[0] + linkOf(page.scene, page.settings)],
    wgsl: ['The WGSL', () => wgslOf(data, page.instance.program(page.settings))],
    rust: ['The Rust', () => page.instance.rustCode(page.settings)],
  };
  for (const [id, [what, text]] of Object.entries(copies)) {
    by(id).addEventListener('click', () => {
      try {
        copied(text(), what);
      } catch (refused) {
        page.complain(refused);
      }
    });
  }
  by('reset').addEventListener('click', () => page.show(page.scene, settingsOf(page.scene, '')));
  by('save').addEventListener('click', async () => {
    const { width, height, data: pixels } = await page.pixels();
    const canvas = new OffscreenCanvas(width, height);
    canvas.getContext('2d').putImageData(new ImageData(pixels, width, height), 0, 0);
    const link = document.createElement('a');
    link.href = URL.createObjectURL(await canvas.convertToBlob());
    link.download = `asperity-${page.scene.id}.png`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  });
  await page.show(...addressed());
  await page.rest();
  globalThis.asperity = page;
}

begin().catch(error => {
  by('state').textContent = `The page could not start: ${String(error.message ?? error).split('\n')[0]}`;
});
