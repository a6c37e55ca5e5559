// Bumps from a normal density at every zoom: Kautz, Heidrich, Seidel 2001, with the exact and the
// fractal rule.

import { floats } from './rust.mjs';
import { direction, towards } from './vector.mjs';
import { readGlb, readObj, sphere, teapot } from './mesh.mjs';
import { Looking, times } from './camera.mjs';
import { fitting } from './controls.mjs';
import { Painting } from './painting.mjs';

const MAX_OCTAVES = 16;
const ZOOMS = [1, 10, 100, 1000, 10000];
const analytic = ({ density }) => density !== 'painted';

/** The scene on a page. */
export const bumps = {
  id: 'bumps',
  short: 'Bumps',
  title: 'Bumps at every zoom',
  about: 'A single normal density shades the distant surface and shapes its bumps in close views. Zoom in ten thousand times: the exact rule preserves the mean brightness, the rule of 2001 does not.',
  keys: 'Drag or use the arrow keys to turn, Shift with them to move along the surface, scroll, pinch or use plus and minus to zoom in, double-click to focus on a point.',
  controls: [
    { kind: 'group', label: 'View' },
    { name: 'shape', kind: 'choice', label: 'Shape', value: 'teapot', options: [['teapot', 'Teapot'], ['sphere', 'Sphere'], ['plane', 'Plane up to the horizon'], ['own', 'Your own file']] },
    { kind: 'file', name: 'mesh', label: 'Your own OBJ or GLB', accept: '.obj,.glb' },
    { name: 'zoom', kind: 'range', label: 'Zoom', min: 0, max: 4, step: 0.01, value: 0, says: z => times(10 ** z) },
    { name: 'turn', kind: 'range', label: 'Rotation', min: -180, max: 180, step: 0.1, value: -66.8, says: x => `${Math.round(x)}°` },
    { name: 'height', kind: 'range', label: 'Height', min: -89, max: 89, step: 0.1, value: 17.9, says: x => `${Math.round(x)}°` },
    { name: 'at', kind: 'place', label: 'Position', value: '', axes: 3 },
    { name: 'lamp', kind: 'range', label: 'Lamp azimuth', min: -180, max: 180, step: 1, value: -132.5, says: x => `${Math.round(x)}°` },
    { name: 'lampHeight', kind: 'range', label: 'Lamp elevation', min: 0, max: 90, step: 1, value: 42.6, says: x => `${Math.round(x)}°` },
    { kind: 'group', label: 'Normal density' },
    { name: 'density', kind: 'choice', label: 'Density', value: 'ggx', options: [['ggx', 'GGX'], ['beckmann', 'Beckmann'], ['student-t', 'Student’s t'], ['painted', 'Painted below']] },
    { name: 'alphaX', kind: 'range', label: 'Roughness α along', min: 0.01, max: 1, step: 0.01, value: 0.2, when: analytic },
    { name: 'alphaY', kind: 'range', label: 'and across', min: 0.01, max: 1, step: 0.01, value: 0.4, when: analytic },
    { name: 'gamma', kind: 'range', label: 'Tails γ of Student’s t', min: 1.6, max: 40, step: 0.1, value: 3, when: ({ density }) => density === 'student-t' },
    { name: 'painting', kind: 'text', label: 'Painting', value: '', pattern: /^[\w-]*$/ },
    { kind: 'own', element: () => bumps.painting.element() },
    { kind: 'group', label: 'Bumps' },
    { name: 'rule', kind: 'choice', label: 'Level of detail', value: 'exact', options: [['exact', 'Exact'], ['fractal', 'Fractal, as in 2001'], ['both', 'Exact at the left, fractal at the right']] },
    { name: 'strip', kind: 'check', label: 'Strip of a flat patch, × 1 to × 10,000, with its mean brightness', value: false },
    { name: 'frequency', kind: 'range', label: 'Cells per unit', min: 0.5, max: 20, step: 0.1, value: 3 },
    { name: 'gain', kind: 'range', label: 'Gain', min: 0.3, max: 0.95, step: 0.01, value: 0.8 },
    { name: 'lacunarity', kind: 'range', label: 'Lacunarity', min: 1.5, max: 4, step: 0.01, value: 2.17 },
    { name: 'seed', kind: 'range', label: 'Seed', min: 0, max: 99, step: 1, value: 7 },
    { name: 'share', kind: 'range', label: 'Maximum resolved fraction', min: 0.5, max: 0.999, step: 0.001, value: 0.97 },
    { name: 'exposure', kind: 'range', label: 'Exposure', min: 0.2, max: 6, step: 0.1, value: 1.4 },
  ],
  painting: null,
  async open(page) {
    bumps.painting ??= new Painting();
    return new Bumps(page);
  },
};

class Bumps extends Looking {
  constructor(page) {
    super(page, {
      teapot: { field: 0.62, distance: 10.4, target: [0.2, 0, 1.35], made: () => teapot(page.data.teapot) },
      sphere: { field: 0.5, distance: 5.2, target: [0, 0, 1], made: sphere },
      plane: { field: 0.9, distance: 1 },
      own: { field: 0.62, distance: 8, target: [0, 0, 1], otherwise: 'teapot' },
    }, 4);
    this.levels = floats(page.rust.gaussian_levels());
    this.strip = null;
    bumps.painting.onchange = text => page.set({ painting: text, density: 'painted' });
    bumps.painting.onerror = error => page.complain(error);
    bumps.controls.find(({ name }) => name === 'mesh').read = file => this.drop(file);
  }

  close() {
    super.close();
    this.strip?.element.remove();
  }

  /** A user file: a mesh, or an image as density. */
  async drop(file) {
    try {
      const name = fitting(file).name.toLowerCase();
      if (name.endsWith('.obj')) this.shapes.set('own', readObj(await file.text(), file.name));
      else if (name.endsWith('.glb')) this.shapes.set('own', readGlb(await file.arrayBuffer(), file.name));
      else if (file.type.startsWith('image/')) return await bumps.painting.read(file);
      else throw new Error(`${file.name} is not an OBJ, GLB or image file.`);
      this.page.set({ shape: 'own', at: '', zoom: 0 });
    } catch (error) {
      this.page.complain(error);
    }
  }

  camera(settings) {
    return { ...super.camera(settings), light: towards(settings.lamp, settings.lampHeight) };
  }

  view(settings, camera, size, over = {}) {
    const { eye, right, up, forward, light, half } = camera;
    const rules = { exact: [0, 0], fractal: [1, 1], both: [0, 1] }[settings.rule];
    const painted = settings.density === 'painted';
    const share = Math.min(settings.share, painted ? 0.93 : 1);
    const all = { pixelAngle: 2 * half / size, rules, size, ...over };
    return new Float32Array([
      ...eye, all.pixelAngle, ...right, settings.frequency, ...up, Math.log2(settings.lacunarity), ...forward, MAX_OCTAVES,
      ...light, share, settings.alphaX, settings.alphaY, settings.exposure, all.size, ...all.rules, 0, settings.gamma,
      ...this.page.gpu.near(camera.near ?? 0), this.page.gpu.rows, 0,
    ]);
  }

  /** Resources of the density's shader. */
  resources(settings, focus) {
    const { rust } = this.page;
    const cells = focus.map(x => x * settings.frequency);
    const sum = [settings.lacunarity, settings.gain, MAX_OCTAVES, settings.seed, ...cells];
    if (String(sum) !== this.sumOf) {
      this.sum = rust.gaussian_anchors(sum);
      this.sumOf = String(sum);
    }
    const resources = { gaussian_level: this.levels, fbm_uniform_3d: this.sum };
    if (settings.density === 'painted') {
      bumps.painting.show(settings.painting);
      const text = bumps.painting.text();
      if (text !== this.mapOf) {
        const start = performance.now(), { side, texels } = bumps.painting.density();
        const words = rust.painted_map([side], texels);
        this.mapTime = performance.now() - start;
        if (this.map) this.page.gpu.forget(this.map);
        this.grid = words.slice(0, 24);
        this.map = words.slice(24);
        this.mapOf = text;
      }
      Object.assign(resources, { packed_map_grid: this.grid, packed_map_word: this.map });
    }
    return resources;
  }

  passes(settings, size) {
    const camera = this.camera(settings);
    const resources = { ...this.resources(settings, camera.focus), bumps_view: this.view(settings, camera, size) };
    return [{ program: `bumps-${settings.density}`, resources, mesh: this.mesh(settings, camera) }];
  }

  say(settings) {
    return settings.density === 'painted' ? `map of ${bumps.painting.side}² in ${this.mapTime.toFixed(1)} ms` : `${this.triangles} triangles`;
  }

  alt(settings) {
    const names = Object.fromEntries(bumps.controls.find(({ name }) => name === 'density').options);
    return `A copper ${settings.shape === 'own' ? 'object of yours' : settings.shape} with bumps of a ${names[settings.density]} density, at zoom ${times(10 ** settings.zoom)}. ${bumps.keys}`;
  }

  /** Called when the final image is rendered: updates the strip below it. */
  async after(settings, stop) {
    if (!settings.strip) {
      this.strip?.element.remove();
      this.strip = null;
      return;
    }
    this.strip ??= new Strip(this.page);
    await this.strip.draw(this, settings, stop);
  }

  /** Returns the data for rendering the same image by other means. */
  described(settings) {
    const camera = this.camera(settings);
    return { ...camera, shape: settings.shape, settings };
  }

  program(settings) { return `bumps-${settings.density}`; }

  rustCode(settings) {
    const [ax, ay] = [settings.alphaX, settings.alphaY].map(number);
    const density = {
      ggx: `Ggx::new(${ax}, ${ay})?`, beckmann: `Beckmann::new(${ax}, ${ay})?`,
      'student-t': `StudentT::new(${ax}, ${ay}, ${number(settings.gamma)})?`,
      painted: `NdfMap::from_texels(${bumps.painting.side}, ${bumps.painting.side}, &texels, Measure::ProjectedSolidAngle, Reconstruction::Bilinear)?`,
    }[settings.density];
    const kind = { ggx: 'Ggx', beckmann: 'Beckmann', 'student-t': 'StudentT', painted: '{Measure, NdfMap, Reconstruction}' }[settings.density];
    const { side, texels } = bumps.painting.density();
    const painted = settings.density !== 'painted' ? '' :
      `    // ${side} by ${side} texels over the disk of normals, from the bottom row up.\n    let texels = [${Array.from(texels, number).join(', ')}];\n`;
    const rule = settings.rule === 'fractal' ? 'Fractal' : 'Exact';
    return `// asperity-shading with its default features
use asperity_shading::ndf_sampling::${kind};
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise, glam::{DVec3, Vec3}};
use asperity_shading::{BumpField, Footprint, Frame, LevelOfDetail};

fn main() -> Result<(), Box<dyn std::error::Error>> {
${painted}    let density = ${density};
    let spectrum = FbmSpectrum::new(${number(settings.lacunarity)}, ${number(settings.gain)}, ${MAX_OCTAVES})?;
    let octaves = GaussianFbm::<Vec3>::new(GaussianNoise::new(${settings.seed}), spectrum);
    // Everything is relative to a focus, so that the zoom can be ten thousand.
    let focus = DVec3::new(${this.focus(settings).map(x => number(x)).join(', ')});
    let bumps = BumpField::new(octaves.anchored(focus * ${number(settings.frequency)}), ${number(settings.frequency)})?;
    // A surface point relative to the focus, and the width of a pixel there.
    let coordinates = bumps.coordinates(Vec3::new(1e-3, 2e-3, 0.0), &Frame::IDENTITY, Footprint::from_width(1e-3));
    let half_vector = Vec3::new(0.1, 0.05, 1.0).normalize();
    println!("{}", LevelOfDetail::${rule}.radiance(&density, half_vector, coordinates));
    Ok(())
}
`;
  }
}

/** Formats a number as a Rust literal. */
export function number(x) {
  const text = String(+x.toPrecision(9));
  return /[.e]/.test(text) ? text : `${text}.0`;
}

/**
 * Flat patches at five zooms with both rules, each with the mean brightness over the whole surface.
 */
class Strip {
  constructor(page) {
    this.page = page;
    this.element = document.createElement('figure');
    this.element.className = 'strip';
    this.rows = ['exact', 'fractal'].map(rule => {
      const row = document.createElement('div');
      row.className = 'row';
      const name = document.createElement('span');
      name.textContent = rule === 'exact' ? 'Exact' : 'Fractal';
      row.append(name);
      const cells = ZOOMS.map(zoom => {
        const cell = document.createElement('div'), canvas = document.createElement('canvas'), text = document.createElement('output');
        canvas.setAttribute('role', 'img');
        canvas.setAttribute('aria-label', `A flat patch at zoom ${times(zoom)} with the ${rule} rule`);
        cell.append(canvas, text);
        row.append(cell);
        return { zoom, canvas, text };
      });
      this.element.append(row);
      return { rule: rule === 'exact' ? 0 : 1, cells };
    });
    const caption = document.createElement('figcaption');
    caption.textContent = 'Flat patches at zoom × 1 to × 10,000. Below: the lamp’s mean brightness over the whole surface, relative to the density’s, ± its standard error.';
    this.element.append(caption);
    page.extra.append(this.element);
  }

  async draw(scene, settings, stop) {
    const { gpu } = this.page, SIDE = 112, POINTS = this.page.strip ?? 192;
    const key = JSON.stringify([settings, gpu.name]);
    if (this.drawn === key) return;
    const wo = direction([0.15, -0.35, 1]), light = direction([-0.3, 0.45, 1]);
    const [patch, points] = [gpu.target(SIDE, SIDE), gpu.target(POINTS, POINTS)];
    const resources = scene.resources(settings, [0, 0, 0.3]);
    const flat = { eye: [0, 0, 0.1], forward: wo, light, half: 0.5 };
    // The density itself: nothing is resolved if a pixel is as wide as the surface.
    const far = await this.mean(scene, settings, points, resources, { ...flat, zoom: 1 }, 1e4, 0);
    for (const { zoom, index } of ZOOMS.map((zoom, index) => ({ zoom, index }))) {
      for (const { rule, cells } of this.rows) {
        if (stop()) { patch.free(); points.free(); return; }
        // In the far view all bumps are smaller than a pixel.
        const side = 90 / settings.frequency / zoom, width = 2 * side / SIDE, { canvas, text } = cells[index];
        const camera = { ...flat, zoom, right: [side, 0, 0], up: [0, side, 0] };
        const view = scene.view(settings, camera, SIDE, { pixelAngle: width, rules: [rule, rule] });
        await gpu.draw(patch, { program: `patch-${settings.density}`, resources: { ...resources, bumps_view: view }, clear: [0, 0, 0] });
        const pixels = await gpu.pixels(patch);
        canvas.width = canvas.height = SIDE;
        canvas.getContext('2d').putImageData(new ImageData(pixels, SIDE, SIDE), 0, 0);
        const { mean, error } = await this.mean(scene, settings, points, resources, camera, width, rule);
        text.textContent = `${times(zoom)}: ${(mean / far.mean).toFixed(2)} ± ${(error / far.mean).toFixed(2)}`;
        await gpu.done();
      }
    }
    patch.free();
    points.free();
    this.drawn = key;
  }

  /**
   * Returns the mean radiance of the lamp over the surface for pixels of a width, with its standard
   * error.
   */
  async mean(scene, settings, points, resources, camera, width, rule) {
    const { gpu, rust } = this.page, side = points.width, BANDS = 32;
    const axes = { right: [1, 0, 0], up: [0, 1, 0], ...camera };
    const view = scene.view(settings, axes, side, { pixelAngle: width, rules: [rule, rule] });
    // Far from its anchor a sum loses precision, and near it all positions are alike, so use many
    // anchors.
    let state = 1;
    const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
    for (let band = 0; band < BANDS; band++) {
      const foci = Array.from({ length: 24 }, (_, k) => k % 3 === 2 ? 0.3 : 65536 * random());
      const sums = rust.gaussian_anchors([settings.lacunarity, settings.gain, MAX_OCTAVES, settings.seed, ...foci]);
      const box = [0, Math.floor(band * side / BANDS), side, Math.ceil(side / BANDS)];
      const bound = { ...resources, fbm_uniform_3d: sums, bumps_view: view };
      await gpu.draw(points, { program: `scattered-${settings.density}`, resources: bound, clear: band === 0 && [0, 0, 0], box });
    }
    const pixels = await gpu.pixels(points), bands = [];
    for (let i = 0; i < pixels.length; i += 4) {
      const k = Math.floor(i / 4 / side * BANDS / side);
      bands[k] = (bands[k] ?? 0) + decoded(pixels[i], pixels[i + 1], pixels[i + 2]) * BANDS / (side * side);
    }
    // Positions of one anchor are alike. Positions of one band differ from other anchors'
    // positions.
    const mean = bands.reduce((a, b) => a + b, 0) / BANDS;
    return { mean, error: Math.sqrt(bands.reduce((sum, x) => sum + (x - mean) ** 2, 0) / (BANDS * (BANDS - 1))) };
  }
}

/** Decodes the number in three bytes written by `display_encoded`. */
export function decoded(r, g, b) {
  return 2 ** (((r << 16) + (g << 8) + b) / 262144 - 30);
}
