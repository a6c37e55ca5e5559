// A fractal interpolation function as a curve with bounds and draggable knots and factors.

import { drawn } from './charts.mjs';
import { element } from './controls.mjs';

const MOST_KNOTS = 24;
const EDGE = { left: 52, right: 10, top: 10, bottom: 24 };
/** The plotted functions: setting, order of integration, name. */
export const CURVES = [['f', 0, 'f'], ['integral', 1, 'f̂']];

/** Converts knots and factors to link text, and back. */
export function functionOf({ knots, factors }) {
  const points = knots.split(';').map(point => point.split(',').map(word => word === '' ? NaN : Number(word)));
  return { x: points.map(([x]) => x), y: points.map(([, y]) => y ?? NaN), d: factors.split(',').map(Number) };
}

export function settingsOfFunction({ x, y, d }) {
  return { knots: x.map((x, k) => `${x},${y[k]}`).join(';'), factors: d.join(',') };
}

/** The function in the module's encoding. */
export const numbersOf = ({ x, y, d }) => [x.length, ...x, ...y, ...d];

export const doubles = words => new Float64Array(words.buffer, 0, words.length >> 1);

/** Rounds a number to about a thousandth of a span. */
const sharpened = (x, span) => +x.toFixed(Math.max(0, Math.min(15, Math.ceil(3 - Math.log10(span)))));
const numeral = (x, span = 0) => String(Math.abs(x) < 1e-9 * span ? 0 : +x.toPrecision(6)).replaceAll('-', '−');

/** The curve: a drawing with handles. `change(values)` is called for edits. */
export class Plot {
  constructor(page, change) {
    Object.assign(this, { page, change, selected: 1, handles: [] });
    this.back = drawn('g');
    this.front = drawn('g');
    this.svg = drawn('svg', { class: 'plot', tabindex: 0, role: 'group' }, this.back, this.front);
    this.facts = element('div', { class: 'facts' });
    this.element = element('figure', {}, this.svg, this.facts);
    page.hands(this.svg, {
      drag: dx => this.held ? null : this.moved(this.window.middle - dx * this.svg.clientWidth / this.inside() * this.window.span),
      nearer: (factor, { nearer }, at = 0) => {
        const next = Math.min(6, Math.max(0, nearer + Math.log10(factor)));
        const place = this.window.middle + at / 2 * this.window.span;
        return { nearer: next, ...this.moved(place + (this.window.middle - place) * 10 ** (nearer - next), this.window.span * 10 ** (nearer - next)) };
      },
      pick: x => this.added(this.window.middle + x / 2 * this.window.span),
    });
  }

  /** The function of the settings, plotted already or not. */
  get shape() { return functionOf(this.page.settings); }

  inside() { return this.width - EDGE.left - EDGE.right; }

  moved(middle, span = this.window.span) {
    const { x } = this.shape;
    return { at: String(sharpened(Math.min(Math.max(middle, Math.min(...x)), Math.max(...x)), span)) };
  }

  ask(order, from, to, columns, tolerance) {
    return doubles(this.page.rust.fractal_curve([order, from, to, columns, tolerance, ...numbersOf(this.shape)]));
  }

  bounds(order, from, to, width) {
    return doubles(this.page.rust.fractal_bounds([order, from, to, width, ...numbersOf(this.shape)]));
  }

  /** Returns the settings with one more knot, on the curve. */
  added(place) {
    const { x, y, d } = this.shape, k = x.findIndex(knot => knot > place);
    if (k < 1 || x.length >= MOST_KNOTS) return null;
    const at = sharpened(place, Math.min(this.window.span, x[k] - x[k - 1])), [value] = this.bounds(0, at, at, 1e-6 * this.rise);
    if (!(at > x[k - 1] && at < x[k]) || !Number.isFinite(value)) return null;
    this.selected = k;
    return settingsOfFunction({
      x: x.toSpliced(k, 0, at), y: y.toSpliced(k, 0, sharpened(value, this.rise)), d: d.toSpliced(k, 0, d[k - 1]),
    });
  }

  /** Returns the settings without the last edited knot. */
  removed(k = this.selected) {
    const { x, y, d } = this.shape;
    if (x.length <= 3 || k >= x.length) return null;
    this.selected = Math.min(k, x.length - 2);
    return settingsOfFunction({ x: x.toSpliced(k, 1), y: y.toSpliced(k, 1), d: d.toSpliced(Math.min(k, d.length - 1), 1) });
  }

  /** Plots the settings; throws the crate's error for invalid settings. */
  draw(settings) {
    const { x, y } = this.shape, finite = x.every(Number.isFinite) && Math.max(...x) > Math.min(...x);
    const [first, last] = finite ? [Math.min(...x), Math.max(...x)] : [0, 1];
    this.width = Math.max(260, Math.round(this.svg.clientWidth || 600));
    this.height = Math.round(this.width * (settings.surface === 'none' ? 0.6 : 1));
    this.svg.setAttribute('viewBox', `0 0 ${this.width} ${this.height}`);
    this.svg.style.aspectRatio = `${this.width} / ${this.height}`;
    const span = 1.06 * (last - first) / 10 ** settings.nearer;
    this.window = { middle: settings.at === '' ? (first + last) / 2 : Math.min(Math.max(+settings.at, first), last), span };
    const spread = Math.max(...y) - Math.min(...y);
    /** Distance of a factor of 1 from its chord. */
    this.rise = spread > 0 && spread < Infinity ? spread / 2 : 1;
    const shown = CURVES.filter(([name]) => settings[name]);
    const [from, to] = [-1, 1].map(side => this.window.middle + side / 2 * span);
    let error = null, curves = [];
    try {
      const rough = shown.map(([, order]) => this.bounds(order, from, to, 2e-3 * this.rise / 10 ** settings.nearer));
      // At high zoom curves are far apart: the first curve fills the drawing.
      if (!this.held) this.fit(settings.nearer > 0.3 ? rough.slice(0, 1) : rough, settings.nearer > 0.3);
      const step = (this.top - this.bottom) / this.height / 3, columns = Math.round(this.inside() * 1.5);
      curves = shown.map(([, order]) => this.ask(order, from, to, columns, step));
      this.tell(shown, settings.bounds);
    } catch (refused) {
      error = refused;
      if (!(this.top > this.bottom)) [this.bottom, this.top] = [-1, 1];
      this.facts.replaceChildren();
    }
    this.paint(settings, shown, curves, from, to, error);
    this.grip(settings, finite);
    if (error) throw error;
  }

  /** The plotted range of heights: all curves in view, and handles. */
  fit(ranges, isNear) {
    const { x, y, d } = this.shape, within = at => Math.abs(at - this.window.middle) < this.window.span / 2;
    const here = y.filter((_, k) => within(x[k]));
    d.forEach((factor, k) => { if (within((x[k] + x[k + 1]) / 2)) here.push((y[k] + y[k + 1]) / 2 + factor * this.rise); });
    const all = [...ranges.flatMap(range => [...range]).filter(Number.isFinite), ...isNear ? [] : here];
    const [lo, hi] = [Math.min(...all), Math.max(...all)], room = 0.06 * (hi - lo) || 0.5;
    [this.bottom, this.top] = [lo - room, hi + room];
  }

  px(x) { return EDGE.left + (0.5 + (x - this.window.middle) / this.window.span) * this.inside(); }

  py(y) { return EDGE.top + (this.top - y) / (this.top - this.bottom) * (this.height - EDGE.top - EDGE.bottom); }

  paint(settings, shown, curves, from, to, error) {
    const { width, height, shape } = this, right = width - EDGE.right, floor = height - EDGE.bottom;
    const ticks = (low, high, count) => {
      const raw = (high - low) / count, power = 10 ** Math.floor(Math.log10(raw)), step = power * [1, 2, 5, 10].find(k => k * power >= raw);
      const digits = Math.max(0, Math.min(15, Math.ceil(-Math.log10(step) - 1e-9)));
      return Array.from({ length: Math.floor(high / step) - Math.ceil(low / step) + 1 }, (_, k) => (Math.ceil(low / step) + k) * step)
        .map(at => [at, at.toFixed(digits).replace(/^-(0\.?0*$)/, '$1').replace('-', '−')]);
    };
    let text = '';
    for (const [at, word] of ticks(from, to, Math.max(2, this.inside() / (70 + 35 * (settings.nearer > 2))))) {
      text += `<path class="grid" d="M${this.px(at).toFixed(1)} ${EDGE.top}V${floor}"/><text x="${this.px(at).toFixed(1)}" y="${height - 7}" text-anchor="middle">${word}</text>`;
    }
    for (const [at, word] of ticks(this.bottom, this.top, height / 55)) {
      text += `<path class="grid" d="M${EDGE.left} ${this.py(at).toFixed(1)}H${right}"/><text x="${EDGE.left - 6}" y="${(this.py(at) + 4).toFixed(1)}" text-anchor="end"${word.length > 7 ? ` textLength="${EDGE.left - 8}" lengthAdjust="spacingAndGlyphs"` : ''}>${word}</text>`;
    }
    let inner = '';
    const move = (x, y) => `${(this.px(x) - EDGE.left).toFixed(2)} ${(this.py(y) - EDGE.top).toFixed(2)}`;
    if (settings.bounds && !error) {
      const { x } = shape;
      for (const [name, order] of shown) {
        for (let k = 1; k < x.length; k++) {
          const [lo, hi] = this.bounds(order, x[k - 1], x[k], 1e-3 * this.rise);
          inner += `<path class="bound ${name}" d="M${move(x[k - 1], lo)}L${move(x[k], lo)}L${move(x[k], hi)}L${move(x[k - 1], hi)}Z"/>`;
        }
      }
    }
    shown.forEach(([name], k) => {
      const ends = curves[k], columns = (ends?.length ?? 0) / 2, [over, under] = [[], []];
      for (let i = 0; i < columns; i++) {
        if (Number.isNaN(ends[2 * i])) continue;
        const at = from + (to - from) * (i + 0.5) / columns;
        over.push(move(at, ends[2 * i + 1]));
        under.unshift(move(at, ends[2 * i]));
      }
      if (over.length) inner += `<path class="curve ${name}" d="M${over.join('L')}L${under.join('L')}Z"/>`;
    });
    this.back.innerHTML = `${text}<svg x="${EDGE.left}" y="${EDGE.top}" width="${this.inside()}" height="${floor - EDGE.top}">${inner}</svg>` +
      shown.map(([name, , letter], k) => `<text class="name ${name}" x="${right - 14 - 26 * (shown.length - 1 - k)}" y="${EDGE.top + 18}">${letter}</text>`).join('');
  }

  /** Describes the functions in words. */
  tell(shown, bounds) {
    const key = JSON.stringify([this.shape, shown, bounds]), { x } = this.shape, unit = 10 ** (Math.floor(Math.log10(this.rise)) - 3);
    if (this.told === key && this.facts.children.length) return;
    this.told = key;
    this.facts.replaceChildren(...shown.map(([, order, name]) => {
      const [least, , leastAt, , most, mostAt, total, rough, rougher] = doubles(this.page.rust.fractal_facts([order, ...numbersOf(this.shape)]));
      const dimension = rougher - rough < 1e-6 ? numeral(rough) : `${numeral(rough)} to ${numeral(rougher)}`;
      // Proven bounds are rounded outward.
      const outwards = (end, round) => String(+(round(end / unit) * unit).toPrecision(12)).replace('-', '−');
      const ends = k => { const [lo, hi] = this.bounds(order, x[k - 1], x[k], 1e-3 * this.rise); return `${outwards(lo, Math.floor)} to ${outwards(hi, Math.ceil)}`; };
      const between = bounds ? ` Proven between knots: ${x.slice(1).map((_, k) => ends(k + 1)).join('; ')}.` : '';
      return element('p', {}, `${name} lies between ${numeral(least, this.rise)}, at ${numeral(leastAt, 1)}, and ${numeral(most, this.rise)}, at ${numeral(mostAt, 1)}; its integral is ${numeral(total, this.rise)}, and its graph has dimension ${dimension}.${between}`);
    }));
  }

  /** Handles at knots and factors. */
  grip(settings, finite) {
    const { x, y, d } = this.shape, count = 2 * x.length - 1;
    if (this.handles.length !== count) {
      const had = this.handles.findIndex(handle => handle === document.activeElement);
      this.handles = Array.from({ length: count }, (_, k) => this.handle(k));
      this.front.replaceChildren(...this.handles);
      if (had >= 0) this.handles[Math.min(had, count - 1) & ~1].focus();
    }
    this.handles.forEach((handle, at) => {
      const k = at >> 1, isKnot = at % 2 === 0, middle = isKnot ? 0 : (y[k] + y[k + 1]) / 2;
      const place = isKnot ? [x[k], y[k]] : [(x[k] + x[k + 1]) / 2, middle + d[k] * this.rise];
      const [px, py] = [this.px(place[0]), this.py(place[1])];
      const visible = finite && settings.f && px >= EDGE.left - 1 && px <= this.width - EDGE.right + 1 && py >= EDGE.top - 1 && py <= this.height - EDGE.bottom + 1;
      handle.style.display = visible ? '' : 'none';
      if (!visible) return;
      handle.setAttribute('transform', `translate(${px.toFixed(1)} ${py.toFixed(1)})`);
      handle.setAttribute('aria-label', isKnot ? `Knot ${k + 1}` : `Factor ${k + 1}`);
      handle.setAttribute('aria-valuenow', isKnot ? y[k] : d[k]);
      handle.setAttribute('aria-valuetext', isKnot ? `x ${numeral(x[k])}, y ${numeral(y[k])}` : numeral(d[k]));
      if (!isKnot) handle.firstChild.setAttribute('d', `M0 0V${(this.py(middle) - py).toFixed(1)}`);
    });
  }

  handle(at) {
    const k = at >> 1, isKnot = at % 2 === 0;
    const shapes = isKnot ? [drawn('circle', { r: 6 })] : [drawn('path', { class: 'stem' }), drawn('path', { d: 'M0-7L6 0 0 7-6 0Z' })];
    const handle = drawn('g', { class: isKnot ? 'knot' : 'factor', tabindex: 0, role: 'slider' }, ...shapes, drawn('circle', { class: 'reach', r: 15 }));
    if (!isKnot) { handle.setAttribute('aria-valuemin', -0.999); handle.setAttribute('aria-valuemax', 0.999); }
    const move = (dx, dy) => this.change(this.pulled(at, dx, dy));
    handle.addEventListener('focus', () => { if (isKnot) this.selected = k; });
    handle.addEventListener('pointerdown', event => {
      event.stopPropagation();
      handle.setPointerCapture(event.pointerId);
      handle.focus();
      this.held = [event.clientX, event.clientY];
    });
    handle.addEventListener('pointermove', event => {
      if (!this.held || !handle.hasPointerCapture(event.pointerId)) return;
      event.stopPropagation();
      const share = this.width / this.svg.getBoundingClientRect().width;
      const [dx, dy] = [event.clientX - this.held[0], event.clientY - this.held[1]].map(x => x * share);
      this.held = [event.clientX, event.clientY];
      move(dx, dy);
    });
    const let_go = () => { if (this.held) { this.held = null; this.change({}); } };
    for (const name of ['pointerup', 'pointercancel', 'lostpointercapture']) handle.addEventListener(name, let_go);
    handle.addEventListener('keydown', event => {
      const far = event.shiftKey ? 20 : 4;
      const step = { ArrowLeft: [-far, 0], ArrowRight: [far, 0], ArrowUp: [0, -far], ArrowDown: [0, far] }[event.key];
      if (step) move(...step);
      else if (isKnot && (event.key === 'Delete' || event.key === 'Backspace')) this.change(this.removed(k) ?? {});
      else if (event.key === 'Insert') this.change(this.added((this.shape.x[k] + (this.shape.x[k + 1] ?? this.shape.x[k - 1])) / 2) ?? {});
      else return;
      event.preventDefault();
      event.stopPropagation();
    });
    return handle;
  }

  /** Returns the settings with a handle moved, in units of the drawing. */
  pulled(at, dx, dy) {
    const { x, y, d } = this.shape, k = at >> 1;
    if (at > 2 * x.length - 2) return null;
    const high = this.top - this.bottom;
    const up = -dy * high / (this.height - EDGE.top - EDGE.bottom);
    if (at % 2) {
      const factor = Math.min(0.999, Math.max(-0.999, d[k] + up / this.rise));
      return settingsOfFunction({ x, y, d: d.with(k, +factor.toFixed(3)) });
    }
    const near = 1e-4 * this.window.span, place = x[k] + dx * this.window.span / this.inside();
    const between = Math.min(Math.max(place, (x[k - 1] ?? -Infinity) + near), (x[k + 1] ?? Infinity) - near);
    const moved = dx === 0 ? x[k] : sharpened(between, this.window.span);
    return settingsOfFunction({ x: x.with(k, moved), y: dy === 0 ? y : y.with(k, sharpened(y[k] + up, high)), d });
  }

  /** Returns the drawing as pixels, in its current colors. */
  async pixels() {
    const copy = this.svg.cloneNode(true), [mine, theirs] = [this.svg, copy].map(svg => [svg, ...svg.querySelectorAll('*')]);
    mine.forEach((part, k) => {
      const style = getComputedStyle(part);
      for (const name of ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'font', 'opacity']) theirs[k].style.setProperty(name, style.getPropertyValue(name));
    });
    const [width, height] = [2 * this.width, 2 * this.height];
    for (const [name, value] of Object.entries({ width, height })) copy.setAttribute(name, value);
    const image = new Image();
    image.src = `data:image/svg+xml,${encodeURIComponent(new XMLSerializer().serializeToString(copy))}`;
    await image.decode();
    const context = new OffscreenCanvas(width, height).getContext('2d');
    context.fillStyle = getComputedStyle(document.body).backgroundColor;
    context.fillRect(0, 0, width, height);
    context.drawImage(image, 0, 0);
    return { width, height, data: context.getImageData(0, 0, width, height).data };
  }
}

/** Fields of all knots and factors; `change(values)` is called for input. */
export class KnotFields {
  constructor(plot, change) {
    Object.assign(this, { plot, change, inputs: [] });
    this.table = element('div', { class: 'knots' });
    const button = (text, press) => {
      const made = element('button', { type: 'button' }, text);
      made.addEventListener('click', () => change(press() ?? {}));
      return made;
    };
    this.more = button('Add a knot', () => {
      const { x } = plot.shape, gaps = x.slice(1).map((right, k) => right - x[k]), k = gaps.indexOf(Math.max(...gaps));
      return plot.added((x[k] + x[k + 1]) / 2);
    });
    this.fewer = button('Remove the knot', () => plot.removed());
    this.element = element('div', {}, this.table, element('div', { class: 'pair' }, this.more, this.fewer));
  }

  show(shape) {
    const lists = ['x', 'y', 'd'], { x } = shape;
    if (this.inputs.length !== x.length) {
      const field = (k, list) => {
        const name = { x: 'x', y: 'y', d: 'Factor after' }[list];
        const input = element('input', { type: 'number', step: { x: 'any', y: 'any', d: 0.01 }[list], 'aria-label': `${name} ${list === 'd' ? '' : 'of '}knot ${k + 1}` });
        input.addEventListener('focus', () => { this.plot.selected = k; });
        input.addEventListener('input', () => {
          if (input.value === '') return;
          const next = { ...this.plot.shape };
          next[list] = next[list].with(k, +input.value);
          this.change(settingsOfFunction(next));
        });
        return input;
      };
      this.inputs = x.map((_, k) => lists.filter(list => list !== 'd' || k < x.length - 1).map(list => field(k, list)));
      const head = ['x', 'y', 'factor d'].map(text => element('span', { 'aria-hidden': 'true' }, text));
      this.table.replaceChildren(...head, ...this.inputs.flatMap((row, k) => k < x.length - 1 ? row : [...row, element('span')]));
    }
    this.inputs.forEach((row, k) => row.forEach((input, at) => {
      const value = shape[lists[at]][k];
      if (document.activeElement !== input || +input.value !== value) input.value = Number.isFinite(value) ? value : '';
    }));
    this.more.disabled = x.length >= MOST_KNOTS;
    this.fewer.disabled = x.length <= 3;
  }
}
