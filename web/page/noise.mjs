// Noise of every type, dimension and sum: its image, gradients, distribution, spectrum and speed.

import { floats } from './rust.mjs';
import { element } from './controls.mjs';
import { number } from './bumps.mjs';
import { chart, drawn, radialSpectrum, ticksOf } from './charts.mjs';

/**
 * Noises by their names in links and programs: number in the module, name, Rust constructor,
 * whether there is a fourth dimension.
 */
const KINDS = {
  white: [0, 'White', 'WhiteNoise', false],
  value: [1, 'Value', 'ValueNoise', true],
  'catmull-rom': [2, 'Value by Catmull–Rom splines', 'ValueCatmullRom', false],
  'perlin-1985': [3, 'Perlin, 1985', 'PerlinClassic', false],
  'perlin-2002': [4, 'Perlin, 2002', 'Perlin', true],
  'value-gradient': [5, 'Value and gradient', 'ValueGradient', false],
  simplex: [6, 'Simplex', 'Simplex', true],
  'simplex-wide': [7, 'Simplex, usual wide kernel', 'Simplex', true],
  sparse: [8, 'Sparse convolution', 'SparseConvolution', false],
  gaussian: [9, 'Exactly Gaussian', 'GaussianNoise', false],
  cellular: [10, 'Cellular', 'Cellular', false],
};
/** Sums: number in the module, number of the shape, name, the shape in Rust. */
const SUMS = {
  one: [0, 0, 'One octave'],
  octaves: [1, 0, 'Octaves'],
  turbulence: [1, 1, 'Turbulence, |n|', 'Turbulence'],
  plasma: [1, 2, 'Plasma, 1 − |n|', 'Plasma'],
  billow: [1, 3, 'Billow, 2|n| − 1', 'Billow'],
  ridged: [1, 4, 'Ridged, (1 − |n|)²', 'Ridged'],
  multifractal: [2, 4, 'Ridged multifractal'],
};
const BASES = ['F1', 'F2', 'F2MinusF1', 'Cell'], METRICS = ['Euclidean', 'Manhattan', 'Chebyshev'];
const NOISE_OCTAVES = 16;
const summed = ({ sum }) => sum !== 'one', moving = ({ dimension }) => dimension !== '4';
const ARROWS = 17;
/**
 * Points per side of measured squares; step between points that samples cells uniformly; cells of a
 * spectrum.
 */
const MEASURED_SIDE = 256, MEASURED_STEP = 2.618034, SPECTRUM_CELLS = 32;

const titled = names => Object.entries(names).map(([value, of]) => [value, of.find((text, k) => k > 0 && typeof text === 'string')]);
const signed = x => (Math.abs(x) < 0.005 ? 0 : x).toFixed(2).replace('-', '−');

/** The scene on a page. */
export const noise = {
  id: 'noise',
  short: 'Noise',
  title: 'Noise',
  about: 'Smooth random functions: every noise in two, three and four dimensions, alone, summed in octaves, warped, or as a flow, with statistics.',
  keys: 'Drag or use the arrow keys to move, Shift with them to move along the third and fourth axis, scroll, pinch or use plus and minus to zoom in.',
  controls: [
    { kind: 'group', label: 'Noise' },
    { name: 'kind', kind: 'choice', label: 'Kind', value: 'perlin-2002', options: titled(KINDS) },
    { name: 'dimension', kind: 'choice', label: 'Dimensions', value: '3', options: [['2', '2'], ['3', '3, seen in a slice'], ['4', '4, a slice at a time']] },
    { name: 'seed', kind: 'range', label: 'Seed', min: 0, max: 99, step: 1, value: 7 },
    { kind: 'group', label: 'Sum' },
    { name: 'sum', kind: 'choice', label: 'Octaves', value: 'octaves', options: titled(SUMS) },
    { name: 'octaves', kind: 'range', label: 'Number, may be fractional', min: 0, max: 12, step: 0.05, value: 6, when: summed },
    { name: 'lacunarity', kind: 'range', label: 'Lacunarity', min: 1.5, max: 4, step: 0.01, value: 2.17, when: summed },
    { name: 'gain', kind: 'range', label: 'Gain', min: 0.2, max: 1, step: 0.01, value: 0.5, when: summed },
    { name: 'feedback', kind: 'range', label: 'Feedback of the multifractal', min: 0, max: 8, step: 0.1, value: 2, when: ({ sum }) => sum === 'multifractal' },
    { name: 'normalised', kind: 'choice', label: 'Normalized to', value: 'variance', options: [['variance', 'variance 1'], ['range', 'the range of one octave']], when: summed },
    { name: 'clamp', kind: 'check', label: 'Omit details finer than a pixel', value: false },
    { name: 'warp', kind: 'range', label: 'Warp by similar sums, in cells', min: 0, max: 2, step: 0.01, value: 0, when: moving },
    { name: 'show', kind: 'choice', label: 'Shown', value: 'value', options: [['value', 'Value'], ['flow', 'Divergence-free flow (curl)']], when: moving },
    { kind: 'group', label: 'Position' },
    { name: 'near', kind: 'range', label: 'Cells across', min: -2, max: 8, step: 0.01, value: 3, says: x => String(+(2 ** x).toPrecision(3)) },
    { name: 'at', kind: 'place', label: 'Middle', value: '0,0', axes: 2 },
    { name: 'third', kind: 'range', label: 'Position along the third axis', min: -4, max: 4, step: 0.01, value: 0.5, when: ({ dimension }) => dimension !== '2' },
    { name: 'time', kind: 'range', label: 'Time, the fourth axis', min: -4, max: 4, step: 0.01, value: 0.5, when: ({ dimension }) => dimension === '4' },
    { name: 'contrast', kind: 'range', label: 'Contrast', min: 0.2, max: 4, step: 0.05, value: 1 },
    { kind: 'group', label: 'Measured' },
    { name: 'arrows', kind: 'check', label: 'Gradients (or velocities) as arrows', value: false },
    { name: 'charts', kind: 'check', label: 'Distribution and spectrum', value: true },
    { kind: 'group', label: 'Of cellular noise', when: ({ kind }) => kind === 'cellular' },
    { name: 'basis', kind: 'choice', label: 'Displayed value', value: 'F1', options: [['F1', 'F₁, the distance to the nearest point'], ['F2', 'F₂, to the second nearest'], ['F2MinusF1', 'F₂ − F₁, their difference'], ['Cell', 'a number of the nearest']] },
    { name: 'metric', kind: 'choice', label: 'Metric', value: 'Euclidean', options: METRICS.map(name => [name, name]) },
    { name: 'jitter', kind: 'range', label: 'Jitter', min: 0, max: 1, step: 0.01, value: 1 },
  ],
  async open(page) {
    return new Noise(page);
  },
};

class Noise {
  constructor(page) {
    this.page = page;
    this.levels = floats(page.rust.gaussian_levels());
    this.answers = new Map();
    this.overlay = drawn('svg', { class: 'overlay', viewBox: '-1 -1 2 2', 'aria-hidden': 'true' });
    page.canvas.after(this.overlay);
    this.distribution = element('figure');
    this.spectrum = element('figure');
    const button = element('button', { type: 'button' }, 'Measure speed');
    this.speed = element('output', { class: 'small' });
    button.addEventListener('click', () => this.measure(button));
    page.extra.append(element('div', { class: 'charts' }, this.distribution, this.spectrum), element('p', {}, button, ' ', this.speed));
  }

  close() { this.overlay.remove(); }

  /**
   * Returns valid settings: not every noise has a fourth dimension, which supports neither warp nor
   * flow.
   */
  told(settings) {
    const [kind, , , inTime] = KINDS[settings.kind], [sum, shape] = SUMS[settings.sum];
    const dimension = settings.dimension === '4' && !inTime ? 3 : +settings.dimension;
    const still = dimension === 4;
    return { kind, sum, shape, dimension, warp: still ? 0 : settings.warp, flow: !still && settings.show === 'flow', octaves: sum ? settings.octaves : 1 };
  }

  name(settings) { return `noise-${settings.kind}-${this.told(settings).dimension}d`; }

  program(settings) { return this.name(settings); }

  /** Returns the numbers of the module's field. */
  spec(settings, size) {
    const told = this.told(settings);
    return [
      told.dimension, told.kind, settings.seed, told.sum, told.shape, settings.lacunarity, settings.gain, told.octaves,
      settings.normalised === 'variance' ? 1 : 0, settings.clamp ? this.footprint(settings, size) : 0, settings.feedback, told.warp,
      BASES.indexOf(settings.basis), METRICS.indexOf(settings.metric), settings.jitter,
    ];
  }

  footprint(settings, size) { return Math.fround(2 ** settings.near / size); }

  /** Caches an answer of the module while the query is unchanged. */
  kept(question, numbers, made = words => words) {
    const key = numbers.join();
    if (this.answers.get(question)?.key !== key) this.answers.set(question, { key, answer: made(this.page.rust[question](numbers)) });
    return this.answers.get(question).answer;
  }

  /** Returns the image center and the vectors to its right and upper border, in four dimensions. */
  place(settings) {
    const [x, y] = settings.at.split(',').map(Number), half = 2 ** settings.near / 2, { dimension } = this.told(settings);
    const further = [dimension > 2 ? settings.third : 0, dimension > 3 ? settings.time : 0];
    return { centre: [x, y, ...further], right: [half, 0, 0, 0], up: [0, half, 0, 0] };
  }

  /** Returns the values of black and white: approximately the field's range. */
  shades(settings) {
    const { sum, shape, kind, octaves } = this.told(settings);
    let [low, high] = sum === 1 && settings.normalised === 'variance' ? [-2.3, 2.3]
      : shape ? [0, 1] : kind === 10 ? [settings.basis === 'Cell' ? -1 : 0, 1.1] : kind === 9 || kind === 8 ? [-2.3, 2.3] : [-0.9, 0.9];
    if (kind === 10 && sum === 1 && !shape && settings.normalised === 'variance') {
      // Distances have a nonzero mean, and so do their sums.
      const [mean, deviation] = this.kept('noise_moments', this.spec(settings, 1), floats), own = Array.from({ length: Math.ceil(octaves) }, (_, k) => settings.gain ** k * Math.min(1, octaves - k));
      const middle = mean / deviation * own.reduce((sum, a) => sum + a, 0) / (Math.hypot(...own) || 1);
      [low, high] = [middle + low, middle + high];
    }
    const middle = (low + high) / 2, half = (high - low) / 2 / settings.contrast;
    return [middle - half, middle + half];
  }

  /** The uniform of the shaders; `asked` selects a pixel's output, 0 is a color. */
  view(settings, size, place = this.place(settings), asked = 0) {
    const told = this.told(settings), spec = this.spec(settings, size), { centre, right, up } = place;
    const [black, white] = this.shades(settings), fast = settings.normalised === 'variance' || !told.sum ? 3 : 1.5;
    const buffer = new ArrayBuffer(96), numbers = new Float32Array(buffer), words = new Uint32Array(buffer);
    numbers.set([...centre, ...right, ...up, told.octaves, spec[9], settings.feedback, told.warp,
      black, 1 / (white - black), told.flow ? settings.contrast / fast : 0, settings.jitter]);
    words.set([spec[12], spec[13], told.sum === 2 ? 1 : 0, asked], 20);
    return words;
  }

  resources(settings, size, ...further) {
    const uniform = this.kept('noise_uniform', this.spec(settings, size)), { dimension } = this.told(settings);
    return { noise_view: this.view(settings, size, ...further), gaussian_level: this.levels, [`fbm_uniform_${dimension}d`]: uniform };
  }

  passes(settings, size) {
    this.overlay.replaceChildren();
    return [{ program: this.name(settings), resources: this.resources(settings, size) }];
  }

  /**
   * Returns bit-exact numbers at a square of points from the GPU, top row first: 1 for values, 2
   * and 3 for slopes or the flow.
   */
  async numbers(settings, place, side, asked) {
    const { gpu } = this.page, target = gpu.target(side, side), ROWS = 32;
    const pass = { program: this.name(settings), resources: this.resources(settings, this.page.full(), place, asked) };
    for (let y = 0; y < side; y += ROWS) {
      await gpu.draw(target, { ...pass, clear: y === 0 && [0, 0, 0], box: [0, y, side, Math.min(ROWS, side - y)] });
      await gpu.done();
    }
    const pixels = await gpu.pixels(target);
    target.free();
    return new Float32Array(pixels.buffer);
  }

  /** Slopes, or velocities, over the image. */
  async arrows(settings, stop) {
    const { canvas } = this.page;
    this.overlay.style.cssText = `left:${canvas.offsetLeft}px;top:${canvas.offsetTop}px;width:${canvas.offsetWidth}px;height:${canvas.offsetHeight}px`;
    if (!settings.arrows) return;
    const [us, vs] = [await this.numbers(settings, this.place(settings), ARROWS, 2), await this.numbers(settings, this.place(settings), ARROWS, 3)];
    if (stop()) return;
    const longest = us.reduce((most, u, k) => Math.max(most, Math.hypot(u, vs[k])), 1e-20), scale = 1.7 / ARROWS / longest;
    const at = k => (2 * k + 1) / ARROWS - 1, n = p => p.toFixed(4);
    const lines = Array.from(us, (way, k) => {
      const [x, y, u, v] = [at(k % ARROWS), at(Math.floor(k / ARROWS)), way * scale, -vs[k] * scale];
      const head = [1, -1].map(side => `m${n(-0.3 * u - 0.16 * side * v)} ${n(-0.3 * v + 0.16 * side * u)}L${n(x + u)} ${n(y + v)}`);
      return `M${n(x)} ${n(y)}l${n(u)} ${n(v)}${head.join('')}`;
    });
    for (const kind of ['under', 'over']) this.overlay.append(drawn('path', { class: kind, d: lines.join('') }));
  }

  say(settings) {
    const { dimension } = this.told(settings);
    if (settings.dimension === '4' && dimension === 3) return `${KINDS[settings.kind][1]} has no fourth dimension in shaders: three are shown`;
    if (settings.kind === 'white' && settings.show === 'flow') return 'white noise has no slopes';
    return dimension === 4 && (settings.warp || settings.show === 'flow') ? 'warps and flows are in two and three dimensions' : '';
  }

  alt(settings) {
    const told = this.told(settings), across = +(2 ** settings.near).toPrecision(3);
    return `${KINDS[settings.kind][1]} noise in ${told.dimension} dimensions, ${SUMS[settings.sum][2].toLowerCase()}${told.warp ? ', warped' : ''}, ${told.flow ? 'as a flow in colours of its direction' : 'in grey'}, ${across} cells across. ${noise.keys}`;
  }

  /**
   * Values throughout the noise: the square is tilted, because a slice would sample only some
   * positions of cells.
   */
  everywhere(settings) {
    const half = MEASURED_SIDE * MEASURED_STEP / 2, { centre } = this.place(settings);
    const right = [half, 0, 0.317 * half, 0.239 * half], up = [0, half, 0.211 * half, 0.421 * half];
    return this.numbers(settings, { centre: [0, 0, ...centre.slice(2)], right, up }, MEASURED_SIDE, 1);
  }

  /** Updates arrows, distribution and spectrum when the image is final. */
  async after(settings, stop) {
    this.distribution.hidden = this.spectrum.hidden = !settings.charts;
    if (!this.page.gpu) return;
    await this.arrows(settings, stop);
    const { centre } = this.place(settings), key = [...this.spec(settings, this.page.full()), ...centre.slice(2), settings.show].join();
    if (!settings.charts || this.charted === key || stop()) return;
    const values = await this.everywhere(settings);
    if (stop()) return;
    this.distribution.replaceChildren(...distributionOf(values));
    const half = SPECTRUM_CELLS / 2, slice = { centre: [0, 0, ...centre.slice(2)], right: [half, 0, 0, 0], up: [0, half, 0, 0] };
    const near = await this.numbers(settings, slice, MEASURED_SIDE, 1);
    if (stop()) return;
    this.spectrum.replaceChildren(...spectrumOf(radialSpectrum(near, MEASURED_SIDE, SPECTRUM_CELLS)));
    this.charted = key;
  }

  /** Whether the module also evaluates the field. */
  hasValues({ kind, sum, dimension, warp }) { return kind === 4 && sum < 2 && dimension === 3 && !warp; }

  /** Returns values and slopes from the module at points of the image, x and y from −1 to 1. */
  samples(settings, size, places) {
    const spec = this.spec(settings, size), { centre, right, up } = this.place(settings);
    const points = places.flatMap(([x, y]) => centre.map((c, k) => c + x * right[k] + y * up[k]).slice(0, spec[0]));
    return floats(this.page.rust.noise_samples(spec, new Float32Array(points)));
  }

  /** Measures values per second of this field, on the GPU and with the crate in WebAssembly. */
  async measure(button) {
    const { page } = this, { settings, gpu } = page, said = [];
    button.disabled = true;
    const tell = (name, rate) => {
      said.push(`${name} ${rate >= 1e9 ? `${(rate / 1e9).toPrecision(3)} billion` : `${(rate / 1e6).toPrecision(3)} million`}`);
      this.speed.textContent = `Values per second: ${said.join('; ')}.`;
    };
    this.speed.textContent = 'Measuring …';
    await new Promise(resolve => setTimeout(resolve, 20));
    if (gpu) {
      let best = Infinity;
      for (let side = 64, spent = 0; side <= 2048 && spent < 300; side *= 2) {
        const target = gpu.target(side, side), pass = { program: this.name(settings), resources: this.resources(settings, side), clear: [0, 0, 0] };
        await gpu.draw(target, pass);
        await gpu.done();
        const start = performance.now();
        await gpu.draw(target, pass);
        await gpu.done();
        const ms = Math.max(performance.now() - start, 0.05);
        target.free();
        spent += 2 * ms;
        best = Math.min(best, ms / (side * side));
      }
      tell(gpu.api, 1000 / best);
    }
    if (this.hasValues(this.told(settings))) {
      const places = Array.from({ length: 4096 }, (_, k) => [k % 64 / 32 - 1, Math.floor(k / 64) / 32 - 1]);
      let best = Infinity;
      for (let spent = 0; spent < 200;) {
        const start = performance.now();
        this.samples(settings, 512, places);
        const ms = performance.now() - start;
        spent += Math.max(ms, 1);
        best = Math.min(best, Math.max(ms, 0.01) / places.length);
      }
      tell('the crate as WebAssembly, one point after the other with its gradient,', 1000 / best);
    }
    button.disabled = false;
  }

  drag(dx, dy, moving, settings) {
    const across = 2 ** settings.near;
    if (moving) {
      const within = x => Math.min(4, Math.max(-4, +x.toFixed(4)));
      return { third: within(settings.third - dy * across), time: within(settings.time + dx * across) };
    }
    const [x, y] = settings.at.split(',').map(Number);
    const named = x => String(Math.min(99999, Math.max(-99999, +x.toFixed(6))));
    return { at: `${named(x - dx * across)},${named(y + dy * across)}` };
  }

  nearer(factor, settings) {
    return { near: Math.min(8, Math.max(-2, +(settings.near - Math.log2(factor)).toFixed(3))) };
  }

  /**
   * Compares values and slopes of the GPU with the module's, if available, and returns the maximum
   * difference.
   */
  async compared(side = 32) {
    const { settings } = this.page, told = this.told(settings), place = this.place(settings);
    if (!this.hasValues(told)) return null;
    const at = k => (2 * k + 1) / side - 1, places = Array.from({ length: side * side }, (_, k) => [at(k % side), -at(Math.floor(k / side))]);
    const ours = this.samples(settings, this.page.full(), places), of = 1 + told.dimension;
    const drawn = [];
    for (const asked of [1, 2, 3]) drawn.push(await this.numbers({ ...settings, show: 'value' }, place, side, asked));
    return drawn.map((numbers, asked) => numbers.reduce((most, x, k) => Math.max(most, Math.abs(x - ours[of * k + asked])), 0));
  }

  rustCode(settings) { return rustOf(settings, this.told(settings), this.place(settings).centre, this.spec(settings, this.page.full())[9]); }
}

/** A histogram with the Gaussian curve of its mean and variance, and its statistics. */
function distributionOf(values) {
  const count = values.length, mean = values.reduce((sum, x) => sum + x, 0) / count;
  const [second, third, fourth] = [2, 3, 4].map(k => values.reduce((sum, x) => sum + (x - mean) ** k, 0) / count);
  const deviation = Math.sqrt(second), says = {
    mean: signed(mean), variance: signed(second), skewness: signed(second ? third / deviation ** 3 : 0), kurtosis: signed(second ? fourth / second ** 2 - 3 : 0),
  };
  const caption = element('figcaption', {}, `Distribution of ${count.toLocaleString('en')} values, shaded, and the Gaussian curve of its mean ${says.mean} and variance ${says.variance}. Skewness ${says.skewness}, excess kurtosis ${says.kurtosis}.`);
  if (!(second > 1e-12)) return [caption];
  const bins = 80, from = mean - 4 * deviation, width = 8 * deviation / bins, bars = new Float64Array(bins);
  for (const x of values) {
    const bin = Math.floor((x - from) / width);
    if (bin >= 0 && bin < bins) bars[bin] += 1 / (count * width);
  }
  const steps = Array.from(bars).flatMap((height, k) => [[from + k * width, height], [from + (k + 1) * width, height]]);
  const curve = Array.from({ length: 121 }, (_, k) => {
    const x = from + 8 * deviation * k / 120;
    return [x, Math.exp(-((x - mean) ** 2) / (2 * second)) / (deviation * Math.sqrt(2 * Math.PI))];
  });
  // A single value, such as an octave that is 0 in places, would hide the rest.
  const most = Math.min(bars.reduce((a, b) => Math.max(a, b), 0), 3 * curve[60][1]) * 1.06;
  const svg = chart({
    label: caption.textContent, across: 'value', up: 'density', curves: [{ points: steps, kind: 'area' }, { points: curve, kind: 'line' }],
    xs: { from, to: from + 8 * deviation, ticks: ticksOf(from, from + 8 * deviation, 6) }, ys: { from: 0, to: most, ticks: ticksOf(0, most) },
  });
  return [svg, caption];
}

/** Power by frequency, both logarithmic, and the frequency of maximum power. */
function spectrumOf(rings) {
  const known = rings.filter(([, power]) => power > 1e-14), logs = known.map(ring => ring.map(Math.log10));
  const powers = logs.map(([, power]) => power), top = powers.reduce((a, b) => Math.max(a, b), -14);
  const peak = known[powers.indexOf(top)], ends = [known[0], known.at(-1)];
  const text = peak
    ? `Power spectrum of ${MEASURED_SIDE}² values of a slice ${SPECTRUM_CELLS} cells wide, mean over all directions. The greatest power is at ${peak[0].toPrecision(2)} waves a cell; at ${ends[1][0].toPrecision(2)} it is ${(top - powers.at(-1)).toFixed(1)} powers of ten lower.`
    : 'No power: the slice is constant.';
  const caption = element('figcaption', {}, text);
  if (!peak) return [caption];
  const power = k => `10${[...String(k)].map(c => '⁰¹²³⁴⁵⁶⁷⁸⁹'[+c] ?? '⁻').join('')}`;
  const bottom = Math.floor(Math.max(powers.reduce((a, b) => Math.min(a, b), top), top - 8)), high = Math.ceil(top + 0.1);
  const xs = { from: logs[0][0], to: logs.at(-1)[0], ticks: [0.05, 0.1, 0.2, 0.5, 1, 2, 4].map(f => [Math.log10(f), String(f)]).filter(([f]) => f >= logs[0][0] && f <= logs.at(-1)[0] + 1e-9) };
  const every = Math.ceil((high - bottom) / 5), ticks = [];
  for (let k = bottom; k <= high; k += every) ticks.push([k, power(k)]);
  return [chart({ label: text, across: 'waves a cell', up: 'power', xs, ys: { from: bottom, to: high, ticks }, curves: [{ points: logs, kind: 'line' }] }), caption];
}

/** A program of the crate with the same values. */
function rustOf(settings, { sum, dimension, warp, flow, octaves }, centre, footprint) {
  const [, , type] = KINDS[settings.kind], shape = SUMS[settings.sum][3], names = new Set([type]);
  const use = name => { names.add(name); return name; };
  const made = {
    'simplex-wide': `Simplex::new(${settings.seed}).with_classic_radius()`,
    cellular: `Cellular::new(${settings.seed}).with_output(CellularOutput::${settings.basis}).with_metric(Metric::${settings.metric}).with_jitter(${number(settings.jitter)})?`,
  }[settings.kind] ?? `${type}::new(${settings.seed})`;
  if (settings.kind === 'cellular') ['CellularOutput', 'Metric'].forEach(use);
  const clamped = footprint > 0 ? `.band_limited(${number(footprint)})` : '';
  const lines = [`let noise = ${made};`];
  const vector = `Vec${dimension}`, seeds = from => Array.from({ length: dimension }, (_, k) => settings.seed + from + k).join(', ');
  // The sum of a seed, before its shape. Warp fields have no shape.
  const needsSums = sum === 1 || sum && warp;
  if (sum) lines.push(`let spectrum = ${use('FbmSpectrum')}::new(${number(settings.lacunarity)}, ${number(settings.gain)}, ${NOISE_OCTAVES})?;`);
  if (needsSums) {
    use('Fbm');
    const range = settings.normalised === 'range' ? `.with_normalization(${use('Normalization')}::UnitRange)` : '';
    lines.push(`let octaves = |seed| Fbm::<_, ${vector}>::new(noise.with_seed(seed), spectrum)${range}.with_octaves(${number(octaves)});`);
  } else if (!sum) {
    use('Fbm');
    lines.push(`let octaves = |seed| Fbm::<_, ${vector}>::single(noise.with_seed(seed));`);
  }
  const shaped = seed => sum === 2
    ? `${use('RidgedMultifractal')}::<_, ${vector}>::new(noise.with_seed(${seed}), spectrum, ${number(settings.feedback)})?.with_octaves(${number(octaves)})`
    : `octaves(${seed})${shape && sum ? `.with_shape(${use(shape)})` : ''}${clamped}`;
  lines.push(`let field = ${shaped(settings.seed)};`);
  if (warp) {
    const by = clamped ? `[${seeds(1)}].map(|seed| octaves(seed)${clamped})` : `[${seeds(1)}].map(octaves)`;
    lines.push(`let field = ${use('Warp')}::new(field, ${by}, ${number(warp)})?;`);
  }
  lines.push(`let p = ${vector}::new(${centre.slice(0, dimension).map(x => number(x)).join(', ')});`);
  const imports = [];
  if (flow) {
    imports.push(`use asperity_noise::curl::Curl${dimension};`);
    lines.push(dimension === 2 ? 'let flow = Curl2(field);' : `let flow = Curl3(field, ${shaped(settings.seed + 4)});`, 'println!("{}", flow.velocity(p));');
  } else {
    use('Field');
    lines.push('let sample = field.sample(p);', 'println!("{} {}", sample.value, sample.gradient);');
  }
  imports.unshift(`use asperity_noise::{${[...names].sort().join(', ')}, glam::${vector}};`);
  return `// asperity-noise with its default features\n${imports.join('\n')}\n\nfn main() -> Result<(), Box<dyn std::error::Error>> {\n${lines.map(line => `    ${line}\n`).join('')}    Ok(())\n}\n`;
}
