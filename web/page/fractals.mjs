// Fractal functions: Cochran, Lewis, Hart 2000. An editable curve, and its surface, ray traced in
// 64 bits.

import { element } from './controls.mjs';
import { CURVES, KnotFields, Plot, doubles, functionOf, numbersOf } from './plot.mjs';
import { add, cross, direction, dot, scale, towards } from './vector.mjs';
import { floats } from './rust.mjs';

const SURFACE_FIELD = 0.62;
/** From the viewer to the target, in halves of the domain's width. */
const FAR = 5;
/** Maximum time that the module may block the page, in ms. */
const TURN = 30;
/** Pixel order: every eighth of every eighth row first. */
const COARSEST = 8;

const zoomed = power => `× ${power < 1 ? (10 ** power).toFixed(1) : Math.round(10 ** power).toLocaleString('en')}`;
const degrees = x => `${Math.round(x)}°`;

/** Initial functions: knots, factors, visible curves, surface. */
const STARTS = {
  f: ['f of the paper', '0,0;1,1;2,0', '0.5,0.5', 'f', 'f'],
  g: ['g of the paper', '0,0;1,1;2,0', '0.85,-0.85', 'f', 'f'],
  'f-hat': ['f̂ of the paper, the integral of f', '0,0;1,1;2,0', '0.5,0.5', 'f,integral', 'integral'],
  'g-hat': ['ĝ of the paper, the integral of g', '0,0;1,1;2,0', '0.85,-0.85', 'f,integral', 'integral'],
  cushion: ['A cushion', '0,0;0.5,1;1,0;1.5,-1;2,0', '0.5,0.5,0.5,0.5', 'f,integral', 'integral'],
  ground: ['Rough ground', '0,1.675;1,0.075;2,1.175;3,-0.125;4,1.775;5,0.475;6,1.375;7,-0.025;8,1.475', '0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5', 'f,integral', 'integral'],
  parabola: ['A parabola, as a fractal', '0,0;1,1;2,0', '0.25,0.25', 'f', 'f'],
};
/** Surfaces by their type in the module. */
const SURFACES = {
  integral: [1, 'f̂(x) f̂(y), smooth'],
  f: [0, 'f(x) f(y), rough'],
  folded: [2, 'Folded, smooth, not a product'],
};
/** The folded surface in Rust, as in the module. */
const FOLDED = `// Heights of the knots along diagonals, there and back; slopes from neighbour to neighbour.
    let last = x.len() - 1;
    let height = |i: usize, j: usize| y[(i + j).min(2 * last - i - j)];
    let around = |k: usize| (k.saturating_sub(1), (k + 1).min(last));
    let (mut heights, mut slopes) = (Vec::new(), Vec::new());
    for (i, j) in (0..=last).flat_map(|i| (0..=last).map(move |j| (i, j))) {
        let ((left, right), (near, far)) = (around(i), around(j));
        heights.push(height(i, j));
        slopes.push([
            (height(right, j) - height(left, j)) / (x[right] - x[left]),
            (height(i, far) - height(i, near)) / (x[far] - x[near]),
        ]);
    }
    // Slopes converge for factors below the fraction of the narrowest cell, quickly for three
    // quarters of it.
    let narrowest = x.windows(2).map(|ends| ends[1] - ends[0]).fold(f64::INFINITY, f64::min);
    let mean = factors.iter().sum::<f64>() / last as f64;
    let factor = 0.75 * mean * narrowest / (x[last] - x[0]);
    let surface = FoldedSurface::new(&x, &x, factor, &heights, &slopes)?.tabulated();`;
const LISTS = /^[-+.\deE,;]{0,900}$/;

/** The scene on a page. */
export const fractals = {
  id: 'fractals',
  short: 'Fractals',
  title: 'Fractal functions',
  about: 'A curve through a few points, made of smaller copies of itself. Its integrals are exact and smooth, and so are the normals of the resulting surfaces. Zoom in a million times.',
  keys: 'Curve: drag knots and factors, or reach them with Tab and use the arrow keys, Shift for larger steps; Insert and Delete add and remove knots; drag or scroll elsewhere to move and zoom, double-click to add a knot. Surface: drag or use the arrow keys to turn, Shift with them to move along it, scroll, pinch or plus and minus to zoom in, double-click to focus on a point.',
  controls: [
    { kind: 'group', label: 'Function' },
    { kind: 'own', element: () => started() },
    { name: 'knots', kind: 'text', label: 'Knots', value: STARTS.cushion[1], pattern: LISTS },
    { name: 'factors', kind: 'text', label: 'Factors', value: STARTS.cushion[2], pattern: LISTS },
    { kind: 'own', element: () => fractals.fields.element },
    { kind: 'group', label: 'Curve' },
    { name: 'f', kind: 'check', label: 'f', value: true },
    { name: 'integral', kind: 'check', label: 'f̂, its integral', value: true },
    { name: 'bounds', kind: 'check', label: 'Proven bounds between knots', value: false },
    { name: 'nearer', kind: 'range', label: 'Zoom', min: 0, max: 6, step: 0.01, value: 0, says: zoomed },
    { name: 'at', kind: 'place', label: 'Position', value: '', axes: 1 },
    { kind: 'group', label: 'Surface' },
    { name: 'surface', kind: 'choice', label: 'Surface', value: 'integral', options: [...Object.entries(SURFACES).map(([value, [, text]]) => [value, text]), ['none', 'None']] },
    { name: 'relief', kind: 'range', label: 'Height', min: 0.05, max: 2, step: 0.05, value: 0.7 },
    { name: 'zoom', kind: 'range', label: 'Zoom', min: 0, max: 6, step: 0.01, value: 0, says: zoomed },
    { name: 'turn', kind: 'range', label: 'Rotation', min: -180, max: 180, step: 0.1, value: -62, says: degrees },
    { name: 'height', kind: 'range', label: 'Camera elevation', min: 5, max: 89, step: 0.1, value: 34, says: degrees },
    { name: 'place', kind: 'place', label: 'Position', value: '', axes: 2 },
    { name: 'colours', kind: 'choice', label: 'Colors', value: 'light', options: [['light', 'Lamp and sky'], ['normals', 'Normals'], ['contrast', 'Normals, differences amplified'], ['heights', 'Height bands'], ['proof', 'Hits proven to be first']] },
    { name: 'lamp', kind: 'range', label: 'Lamp azimuth', min: -180, max: 180, step: 1, value: -130, says: degrees },
    { name: 'lampHeight', kind: 'range', label: 'Lamp elevation', min: 1, max: 90, step: 1, value: 32, says: degrees },
    { name: 'shadows', kind: 'check', label: 'Shadows', value: true },
  ],
  async open(page) {
    return new Fractals(page);
  },
};

/** The choice of an initial function. */
function started() {
  const id = 'fractals-start', select = element('select', { id },
    element('option', { value: '' }, 'Start from …'), ...Object.entries(STARTS).map(([value, [text]]) => element('option', { value }, text)));
  select.addEventListener('change', () => {
    if (STARTS[select.value]) {
      const [, knots, factors, curves, surface] = STARTS[select.value];
      const shown = Object.fromEntries(CURVES.map(([name]) => [name, curves.split(',').includes(name)]));
      fractals.change({ knots, factors, ...shown, surface, at: '', nearer: 0, place: '', zoom: 0 });
    }
    select.value = '';
  });
  return element('div', { class: 'field' }, element('label', { for: id }, 'A function'), select);
}

class Fractals {
  constructor(page) {
    this.page = page;
    const change = fractals.change = values => values && page.set(values);
    this.took = 0;
    this.plot = new Plot(page, change);
    this.fields = fractals.fields = new KnotFields(this.plot, change);
    this.surface = new Traced(page);
    this.element = element('div', { class: 'fractals', role: 'group' }, this.plot.element, this.surface.canvas);
  }

  async paint(settings, stop) {
    this.fields.show(functionOf(settings));
    this.element.classList.toggle('alone', settings.surface === 'none');
    try {
      const start = performance.now();
      this.plot.draw(settings);
      this.took = performance.now() - start;
      this.surface.canvas.hidden = settings.surface === 'none';
      if (settings.surface !== 'none') await this.surface.draw(settings, stop);
    } catch (error) {
      this.page.complain(error);
    }
  }

  say({ surface }) { return surface === 'none' ? `in ${this.took.toFixed(1)} ms` : this.surface.said; }

  alt({ surface }) {
    const { x, y, d } = this.plot.shape;
    const places = x.map((x, k) => `(${x}, ${y[k]})`).join(', ');
    return `The fractal function through ${places} with the factors ${d.join(', ')}${surface === 'none' ? '' : `, and a surface: ${SURFACES[surface][1]}`}.`;
  }

  program({ surface }) { return surface === 'folded' ? 'fractals-folded' : 'fractals'; }

  pixels() { return this.surface.canvas.hidden ? this.plot.pixels() : this.surface.pixels(); }

  rustCode(settings) {
    const { x, y, d } = functionOf(settings), list = numbers => `[${numbers.map(exact).join(', ')}]`;
    const exact = x => /[.e]/.test(x) ? `${x}` : `${x}.0`;
    const { ray: [origin, along] } = this.surface.camera ?? { ray: [[x[0], x[0], 9], [0.1, 0.1, -1]] };
    const vector = p => `DVec3::new(${p.map(exact).join(', ')})`;
    const name = settings.surface === 'f' ? 'f' : 'f_hat', isFolded = settings.surface === 'folded';
    const surface = isFolded ? FOLDED : `let surface = HeightField::new(${name}.clone(), ${name}).tabulated();`;
    return `// asperity-fif with its default features
use asperity_fif::{Fif, ${isFolded ? 'FoldedSurface' : 'HeightField'}, Intersect, Ray, glam::DVec3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (x, y, factors) = (${[x, y, d].map(list).join(', ')});
    let f = Fif::affine(&x, &y, &factors)?;
    println!("{:?}", f.evaluate(${exact(this.plot.window.middle)}, 1e-12));
    println!("{:?}, integral {}", f.extrema(1e-9), f.total_integral());
    let f_hat: Fif<3> = f.integral(0.0)?;
    println!("{:?}", f_hat.extrema(1e-9));
    ${surface}
    // The ray through the image center, in the units of the heights.
    let origin = ${vector(origin)};
    let ray = Ray { origin, direction: ${vector(along)} };
    println!("{:?}", surface.intersect(&ray));
    Ok(())
}
`;
  }
}

/** The surface, ray traced by the module, coarse first. */
class Traced {
  constructor(page) {
    this.page = page;
    this.said = '';
    this.canvas = element('canvas', { tabindex: 0, role: 'img', class: 'traced', width: 64, height: 64 });
    page.hands(this.canvas, this);
  }

  /** The surface for rays: its numbers, domain, height factor, target. */
  ground(settings) {
    const key = JSON.stringify([settings.surface, settings.knots, settings.factors, settings.relief, settings.place]);
    if (this.known?.key === key) return this.known;
    const { rust } = this.page, numbers = [SURFACES[settings.surface][0], ...numbersOf(functionOf(settings))];
    const [x, right, y, back, low, high] = doubles(rust.fractal_ground(numbers));
    const half = (right - x) / 2, rise = settings.relief * half / (Math.max(high, -low, high - low) || 1);
    const place = settings.place ? settings.place.split(',').map(Number) : [x + half, (y + back) / 2];
    const [px, py] = [Math.min(Math.max(place[0], x), right), Math.min(Math.max(place[1], y), back)];
    const over = rise * high + half;
    const focus = this.hit({ numbers, rise }, [px, py, over], [0, 0, -1], 0) ?? [px, py, 0];
    return this.known = { key, numbers, half, rise, focus };
  }

  hit({ numbers, rise }, origin, along, tolerance) {
    const words = this.page.rust.fractal_hit([...numbers, rise, ...origin, ...along, tolerance]);
    return words.length ? [...doubles(words)] : null;
  }

  view(settings, ground) {
    const away = towards(settings.turn, settings.height), distance = FAR * ground.half / 10 ** settings.zoom;
    const forward = scale(away, -1), wide = Math.tan(SURFACE_FIELD / 2), right = direction(cross(forward, [0, 0, 1]));
    return { forward, eye: scale(away, distance), distance, right: scale(right, wide), up: scale(cross(right, forward), wide) };
  }

  async draw(settings, stop) {
    const { page, canvas } = this, ground = this.ground(settings), view = this.view(settings, ground), size = page.full(canvas);
    const lamp = towards(settings.lamp, settings.lampHeight);
    this.camera = { ray: [add(ground.focus, view.eye), view.forward].map(([x, y, z]) => [x, y, z / ground.rise]) };
    canvas.setAttribute('aria-label', `The ray traced surface at zoom ${zoomed(settings.zoom)}. Arrow keys turn, Shift with them moves along it, plus and minus zoom.`);
    const numbers = [...ground.numbers, ground.rise, ...ground.focus, ...view.eye, ...view.right, ...view.up, ...view.forward, ...lamp, +settings.shadows, size];
    const key = JSON.stringify(settings.shadows ? numbers : numbers.map((x, k) => k > numbers.length - 6 && k < numbers.length - 2 ? 0 : x));
    if (this.key !== key) Object.assign(this, { key, numbers, size, done: 0, words: new Uint32Array(5 * size * size), order: inOrder(size), busy: 0 });
    const look = JSON.stringify([key, settings.colours, lamp]), colour = this.colour(settings, lamp);
    this.said = '';
    this.enlarged(settings);
    if (this.look !== look) {
      if (canvas.width !== size) canvas.width = canvas.height = size;
      this.image = new ImageData(size, size);
      this.look = look;
      this.fill(0, this.done, colour);
    }
    let shown = performance.now();
    while (this.done < this.order.length) {
      const start = performance.now(), count = Math.max(16, Math.floor(TURN / (this.perRay ?? 0.05)));
      const batch = this.order.subarray(this.done, this.done + count);
      this.words.set(page.rust.fractal_rays(this.numbers, batch), 5 * this.done);
      const ms = performance.now() - start;
      this.perRay = Math.max(ms, 0.1) / batch.length;
      this.busy += ms;
      this.fill(this.done, this.done + batch.length, colour);
      this.done += batch.length;
      if (performance.now() - shown > 90) {
        canvas.getContext('2d').putImageData(this.image, 0, 0);
        shown = performance.now();
        page.say(`${Math.floor(100 * this.done / this.order.length)} % of ${size} × ${size} rays`);
      }
      await new Promise(resolve => setTimeout(resolve));
      if (stop()) break;
    }
    if (this.enlarged(settings)) this.fill(0, this.done, colour);
    canvas.getContext('2d').putImageData(this.image, 0, 0);
    this.said = `${size} × ${size} rays in ${Math.round(this.busy)} ms, ${Math.round(this.done / Math.max(this.busy, 0.1)).toLocaleString('en')} thousand a second`;
  }

  /** The mean of the normals and their spread, for colors that amplify it. */
  enlarged({ colours }) {
    if (colours !== 'contrast') return false;
    const values = floats(this.words), mean = [0, 0, 0], every = [0, 1, 2];
    let [count, square] = [1e-9, 1e-30];
    const all = visit => { for (let k = 0; k < this.done; k++) if (this.words[5 * k]) visit(5 * k + 1); };
    all(at => { count++; for (const i of every) mean[i] += values[at + i]; });
    for (const i of every) mean[i] /= count;
    all(at => { for (const i of every) square += (values[at + i] - mean[i]) ** 2 / count; });
    this.contrast = { mean, by: 70 / Math.sqrt(square) };
    return true;
  }

  /** Draws a range of pixels as squares that cover pixels not computed yet. */
  fill(from, to, colour) {
    const { size } = this, pixels = new Uint32Array(this.image.data.buffer), values = floats(this.words);
    for (let k = from; k < to; k++) {
      const at = this.order[k], [x, y] = [at & 0xffff, at >> 16], side = (x | y | COARSEST) & -(x | y | COARSEST);
      const shade = colour(this.words[5 * k], values[5 * k + 1], values[5 * k + 2], values[5 * k + 3], values[5 * k + 4]);
      for (let v = y; v < Math.min(y + side, size); v++) pixels.fill(shade, v * size + x, v * size + Math.min(x + side, size));
    }
  }

  /** Returns the color of a ray's hit as an image word. */
  colour({ colours }, lamp) {
    const word = (r, g, b) => (255 << 24 | Math.round(b) << 16 | Math.round(g) << 8 | Math.round(r)) >>> 0;
    const shown = light => 255 * (1 - Math.exp(-light)) ** (1 / 2.2);
    const nothing = word(236, 234, 228);
    return (shows, x, y, z, height) => {
      if (!shows) return nothing;
      if (colours === 'normals') return word(127.5 + 127.5 * x, 127.5 + 127.5 * y, 127.5 + 127.5 * z);
      if (colours === 'contrast') {
        const { mean, by } = this.contrast, part = (x, k) => Math.min(255, Math.max(0, 127.5 + by * (x - mean[k])));
        return word(part(x, 0), part(y, 1), part(z, 2));
      }
      const sun = shows & 4 ? 0 : Math.max(0, dot([x, y, z], lamp)), sky = 0.5 + 0.5 * z;
      let albedo = [0.82, 0.7, 0.55];
      if (colours === 'proof') albedo = shows & 2 ? [0.9, 0.2, 0.12] : [0.45, 0.72, 0.62];
      if (colours === 'heights') {
        const band = Math.floor(height * 25);
        albedo = [[0.25, 0.45, 0.62], [0.86, 0.82, 0.66], [0.42, 0.6, 0.34], [0.93, 0.9, 0.86], [0.68, 0.42, 0.28]][(band % 5 + 5) % 5];
      }
      return word(...albedo.map((a, k) => shown(a * (sun * [1.9, 1.72, 1.45][k] + sky * [0.3, 0.37, 0.5][k]))));
    };
  }

  drag(dx, dy, moving, settings) {
    if (!moving) {
      const turn = settings.turn - 180 * dx;
      return { turn: turn - 360 * Math.round(turn / 360), height: Math.min(89, Math.max(5, settings.height + 120 * dy)) };
    }
    const ground = this.ground(settings), { right, up, distance } = this.view(settings, ground);
    const along = direction([up[0], up[1], 0]), reach = 2 * distance * Math.tan(SURFACE_FIELD / 2);
    return this.looking(add(ground.focus, add(scale(direction(right), -dx * reach), scale(along, dy * reach))));
  }

  pick(x, y, settings) {
    const ground = this.ground(settings), { eye, forward, right, up, distance } = this.view(settings, ground);
    const hit = this.hit(ground, add(ground.focus, eye), add(forward, add(scale(right, x), scale(up, y))), 1e-4 * distance);
    return hit && this.looking(hit);
  }

  looking([x, y]) { return { place: [x, y].map(x => +x.toPrecision(13)).join(',') }; }

  nearer(factor, settings) {
    return { zoom: Math.min(6, Math.max(0, settings.zoom + Math.log10(factor))), ...this.looking(this.ground(settings).focus) };
  }

  pixels() {
    return { width: this.size, height: this.size, data: this.canvas.getContext('2d').getImageData(0, 0, this.size, this.size).data };
  }
}

/** Returns all pixels of an image, column and row in one word, coarse first. */
function inOrder(size) {
  const order = new Uint32Array(size * size);
  let count = 0;
  for (let step = COARSEST; step >= 1; step /= 2) {
    for (let y = 0; y < size; y += step) {
      for (let x = 0; x < size; x += step) {
        if (step === COARSEST || (x | y) & step) order[count++] = y << 16 | x;
      }
    }
  }
  return order;
}
