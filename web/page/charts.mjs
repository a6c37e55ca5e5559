// Small charts in the page's colors, and the Fourier transform for spectra.

const NAMESPACE = 'http://www.w3.org/2000/svg';

export const drawn = (tag, attributes = {}, ...children) => {
  const made = document.createElementNS(NAMESPACE, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
};

const BOX = { width: 360, height: 210, left: 44, right: 8, top: 8, bottom: 34 };

/**
 * A chart: curves of points, filled or lines, with ticks along both axes; `label` is the
 * alternative text.
 */
export function chart({ label, across, up, xs, ys, curves }) {
  const { width, height, left, right, top, bottom } = BOX;
  const x = v => left + (v - xs.from) / (xs.to - xs.from) * (width - left - right);
  const y = v => height - bottom - (v - ys.from) / (ys.to - ys.from) * (height - top - bottom);
  const within = v => Math.min(Math.max(v, ys.from), ys.to);
  const svg = drawn('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': label, class: 'chart' });
  for (const [value, text] of xs.ticks) {
    svg.append(drawn('line', { x1: x(value), x2: x(value), y1: top, y2: height - bottom, class: 'tick' }));
    svg.append(drawn('text', { x: x(value), y: height - bottom + 14, 'text-anchor': 'middle' }, text));
  }
  for (const [value, text] of ys.ticks) {
    svg.append(drawn('line', { x1: left, x2: width - right, y1: y(value), y2: y(value), class: 'tick' }));
    svg.append(drawn('text', { x: left - 5, y: y(value) + 4, 'text-anchor': 'end' }, text));
  }
  svg.append(drawn('text', { x: (left + width - right) / 2, y: height - 4, 'text-anchor': 'middle' }, across));
  svg.append(drawn('text', { x: 11, y: (top + height - bottom) / 2, 'text-anchor': 'middle', transform: `rotate(-90 11 ${(top + height - bottom) / 2})` }, up));
  for (const { points, kind } of curves) {
    if (!points.length) continue;
    const line = points.map(([a, b]) => `${x(a).toFixed(1)} ${y(within(b)).toFixed(1)}`).join('L');
    const ends = [points.at(-1)[0], points[0][0]].map(a => `L${x(a).toFixed(1)} ${y(ys.from).toFixed(1)}`).join('');
    svg.append(drawn('path', { d: kind === 'area' ? `M${line}${ends}Z` : `M${line}`, class: kind }));
  }
  return svg;
}

/** Round numbers within a range. */
export function ticksOf(from, to, count = 4) {
  const rough = (to - from) / count, ten = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map(k => k * ten).find(step => step >= rough) ?? ten;
  const ticks = [];
  for (let k = Math.ceil(from / step - 1e-9); k * step <= to + 1e-9 * step; k++) ticks.push([k * step, String(+(k * step).toPrecision(6)).replace('-', '−')]);
  return ticks;
}

/** Transforms complex numbers in place: radix 2, from `start`, with a stride. */
function transform(re, im, start, stride, count) {
  for (let i = 1, j = 0; i < count; i++) {
    let bit = count >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      const [a, b] = [start + i * stride, start + j * stride];
      [re[a], re[b]] = [re[b], re[a]];
      [im[a], im[b]] = [im[b], im[a]];
    }
  }
  for (let length = 2; length <= count; length *= 2) {
    const half = length / 2;
    for (let k = 0; k < half; k++) {
      const angle = -2 * Math.PI * k / length, [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (let i = k; i < count; i += length) {
        const [a, b] = [start + i * stride, start + (i + half) * stride];
        const x = re[b] * c - im[b] * s, y = re[b] * s + im[b] * c;
        re[b] = re[a] - x;
        im[b] = im[a] - y;
        re[a] += x;
        im[a] += y;
      }
    }
  }
}

/**
 * Returns the power spectrum of a square of values: [frequency, power] of rings of equal ratio.
 * Frequencies are in cycles per unit, and the square is `extent` units wide. Powers are per squared
 * unit of frequency. The mean is subtracted, and a Hann window fades the borders.
 */
export function radialSpectrum(values, side, extent) {
  const mean = values.reduce((sum, x) => sum + x, 0) / values.length;
  const [re, im] = [new Float64Array(side * side), new Float64Array(side * side)];
  const window = Array.from({ length: side }, (_, k) => 1 - Math.cos(2 * Math.PI * (k + 0.5) / side));
  for (let k = 0; k < re.length; k++) re[k] = (values[k] - mean) * window[k % side] * window[Math.floor(k / side)];
  for (let k = 0; k < side; k++) transform(re, im, k * side, 1, side);
  for (let k = 0; k < side; k++) transform(re, im, k, side, side);
  // The mean square of the window is 9/4.
  const scale = (extent / (side * side)) ** 2 / 2.25, perOctave = 6, rings = new Map();
  for (let k = 0; k < re.length; k++) {
    const signed = i => i < side / 2 ? i : i - side;
    const waves = Math.hypot(signed(k % side), signed(Math.floor(k / side)));
    if (waves < 1.5 || waves > side / 2) continue;
    const ring = Math.round(perOctave * Math.log2(waves)), known = rings.get(ring) ?? { power: 0, waves: 0, count: 0 };
    rings.set(ring, { power: known.power + (re[k] ** 2 + im[k] ** 2) * scale, waves: known.waves + waves, count: known.count + 1 });
  }
  return [...rings.entries()].sort(([a], [b]) => a - b).map(([, { power, waves, count }]) => [waves / count / extent, power / count]);
}
