// Materials with all parameters of the thesis, on a car, a room, the teapot, under environment
// light: Nilsson 2008, Cohen.

import { Mesh, sphere, teapot } from './mesh.mjs';
import { Looking, times } from './camera.mjs';
import { fitting } from './controls.mjs';
import { carBody, cup, ground, room, sky, wheels } from './scenery.mjs';
import { encoded, lightFor, linear, readLight } from './light.mjs';

/** Formats a length with a suitable unit. */
const metres = x => x < 1e-3 ? `${+(x * 1e6).toPrecision(3)} µm` : x < 0.1 ? `${+(x * 1e3).toPrecision(3)} mm` : `${+x.toPrecision(3)} m`;
const rustNumber = x => {
  const text = String(+x.toPrecision(4));
  return /[.e]/.test(text) ? text : `${text}.0`;
};
const colourOf = hex => [1, 3, 5].map(k => linear(parseInt(hex.slice(k, k + 2), 16) / 255));
const hexOf = colour => `#${colour.map(x => Math.round(encoded(x) * 255).toString(16).padStart(2, '0')).join('')}`;
const turnOf = degrees => [Math.cos(degrees * Math.PI / 180), Math.sin(degrees * Math.PI / 180)];

// Parameters: how a setting is displayed, which numbers the crate receives, how Rust writes it.
const share = (field, label, value, most = 1) =>
  ({ field, label, kind: 'range', min: 0, max: most, value, numbers: x => [x], rust: rustNumber });
const between = (field, label, value, min, max) => ({ ...share(field, label, value, max), min });
const whole = (field, label, value, min, max) =>
  ({ field, label, kind: 'range', min, max, step: 1, value, numbers: x => [x], rust: x => String(Math.round(x)) });
const seed = (value = 1) => whole('seed', 'Random seed', value, 0, 99);
const size = (field, label, value, min, max, says = metres) => ({
  field, label, kind: 'range', min: Math.log10(min), max: Math.log10(max), value: +Math.log10(value).toFixed(4),
  says: x => says(10 ** x), numbers: x => [10 ** x], rust: x => rustNumber(10 ** x),
});
const plainly = x => String(+x.toPrecision(3));
const colour = (field, label, value) => ({
  field, label, kind: 'colour', value: hexOf(value), numbers: colourOf,
  rust: hex => `Vec3::new(${colourOf(hex).map(rustNumber).join(', ')})`,
});
const angle = (field, label) => ({
  field, label, kind: 'range', min: -90, max: 90, step: 1, value: 0, says: x => `${x}°`, numbers: turnOf,
  rust: x => `Vec2::new(${turnOf(x).map(rustNumber).join(', ')})`,
});
const choice = (field, label, options, words) => ({
  field, label, kind: 'choice', value: '0', options: options.map((text, k) => [String(k), text]), numbers: x => [+x], rust: x => words[+x],
});
const check = (field, label, value) => ({ field, label, kind: 'check', value, numbers: x => [x ? 1 : 0], rust: String });

/**
 * Code of a material with a parameter structure: `less` are fields that it lacks, `more` are its
 * additional fields.
 */
const structure = (name, uses, less = [], more = () => []) => ({
  uses,
  code(rust, fields) {
    const words = [...fields.filter(field => !less.includes(field)).map(field => `${field}: ${rust(field)}`), ...more(rust)];
    return `${name}::new(${name}Parameters {\n        ${words.join(',\n        ')},\n        ..Default::default()\n    })?`;
  },
});

const FIBERS = ['fiber_length', 'fiber_width', 'fiber_bend', 'fiber_direction', 'fiber_spread', 'fiber_contrast'];

/**
 * Materials: parameters in the order of the crate's queries. `view` has settings that show a
 * material best.
 */
const MATERIALS = {
  paint: {
    title: 'Metallic paint', view: { shape: 'car', size: 0 },
    parameters: [
      colour('specular', 'Specular color of flakes', [0.25, 0.35, 0.6]),
      colour('pigment', 'Pigment', [0.02, 0.05, 0.14]),
      between('flake_roughness', 'Roughness α of the flakes', 0.32, 0.01, 1),
      between('flake_sparkle_pixel_size', 'Sparkles: width in pixels', 2, 0.2, 10),
      size('flake_sparkle_physical_size', 'Sparkles: maximum width', 0.001, 1e-5, 0.1),
      share('flake_sparkle_variation', 'Sparkles: variation', 0.5),
      share('flake_sparkle_boost', 'Sparkles: boost', 0.3),
      colour('flake_sparkle_boost_target', 'Sparkles: target of the boost', [1, 1, 1]),
      share('flake_sparkle_elimination', 'Sparkles: elimination', 0.4),
      check('smart', 'Smart: fewer omitted at a distance', true),
      size('unit', 'Smart: unit', 0.002, 1e-5, 1),
      size('passive_flake_size', 'Passive flakes: size', 0.004, 1e-4, 0.5),
      share('passive_flake_strength', 'Passive flakes: strength', 0.3),
      whole('passive_flake_detail', 'Passive flakes: detail', 4, 1, 8),
      share('orange_peel_strength', 'Orange peel: strength', 0.01, 0.3),
      size('orange_peel_size', 'Orange peel: size', 0.006, 1e-4, 0.5),
      between('coat_index', 'Coat: index', 1.5, 1, 3),
      share('coat_roughness', 'Coat: roughness α', 0),
      seed(),
    ],
    ...structure('MetallicPaint', 'MetallicPaint, MetallicPaintParameters, material::Elimination', ['smart', 'unit'], rust =>
      [`smart_flake_sparkle: ${rust('smart') === 'true' ? `Elimination::Adaptive { unit: ${rust('unit')} }` : 'Elimination::Fixed'}`]),
  },
  carpet: {
    title: 'Carpet', view: { shape: 'room', on: 'floor', size: 0, zoom: 0.6, height: 30 },
    parameters: [
      colour('diffuse', 'Diffuse color', [0.34, 0.08, 0.06]),
      colour('specular', 'Specular color', [0, 0, 0]),
      share('roughness', 'Roughness', 0.8),
      between('specular_roughness', 'Roughness α of specular threads', 0.45, 0.01, 1),
      size('diffuse_thread_size', 'Diffuse threads: size', 0.006, 1e-4, 0.5),
      share('diffuse_thread_strength', 'Diffuse threads: strength', 0.12),
      share('diffuse_thread_bump_strength', 'Diffuse threads: bumps', 0.12),
      size('specular_thread_size', 'Specular threads: size', 0.008, 1e-4, 0.5),
      share('specular_thread_strength', 'Specular threads: strength', 0.12),
      size('dark_area_size', 'Dark areas: size', 0.15, 0.005, 5),
      share('dark_area_strength', 'Dark areas: strength', 0.2),
      { ...choice('seams_pattern', 'Seams', ['none', 'lines', 'grid'], ['None', 'Lines', 'Grid'].map(x => `SeamPattern::${x}`)), value: '1' },
      angle('seams_propagation', 'Seams: direction across'),
      size('seam_distance', 'Seams: distance', 0.02, 0.001, 1),
      share('seams_amplitude', 'Seams: amplitude', 0.3),
      share('seams_bump_strength', 'Seams: bumps', 0.4),
      size('seam_crossover_size', 'Crossover of seams: size', 0.05, 0.001, 5),
      share('seam_crossover_strength', 'Crossover of seams: strength', 0.5),
      share('fiber_strength', 'Fibers: fraction of the colors', 0.8),
      share('fiber_bump_strength', 'Fibers: bumps', 0.3),
      size('fiber_length', 'Fibers: length', 0.004, 1e-4, 0.1),
      between('fiber_width', 'Fibers: width over length', 0.12, 0.01, 0.3),
      share('fiber_bend', 'Fibers: bend', 0.15, 0.3),
      angle('fiber_direction', 'Fibers: direction'),
      share('fiber_spread', 'Fibers: spread', 0.6),
      share('fiber_contrast', 'Fibers: contrast', 0.6),
      share('fake_rim_light', 'Rim light: strength', 0.15),
      share('fake_rim_light_width', 'Rim light: width', 0.4),
      colour('fake_rim_light_color', 'Rim light: color', [1, 1, 1]),
      seed(),
    ],
    ...structure('Carpet', 'Carpet, CarpetParameters, glam::Vec2, material::{FibersParameters, SeamPattern}', FIBERS, rust =>
      [`fibers: FibersParameters { ${FIBERS.map(field => `${field}: ${rust(field)}`).join(', ')}, ..Default::default() }`]),
  },
  glass: {
    title: 'Tempered glass', view: { shape: 'teapot', size: 0, behind: 'dark' },
    parameters: [
      size('wave_frequency', 'Waves: frequency, radians per meter', 20, 1, 1000, plainly),
      size('wave_amplitude', 'Waves: amplitude', 1e-4, 1e-7, 0.05),
      { ...angle('around', 'Waves: azimuth'), value: 90, max: 180, min: -180, numbers: x => turnOf(x) },
      { ...angle('up', 'Waves: slope of the direction, up'), numbers: x => [Math.tan(x * Math.PI / 180)], min: -85, max: 85 },
      choice('waves', 'Waves', ['a sine', 'noise'], ['GlassWaves::Sine', 'GlassWaves::Noise']),
      choice('body', 'Thickness', ['a pane', 'a body'], ['GlassBody::Pane', 'GlassBody::Solid']),
      between('index', 'Index', 1.52, 1, 3),
      colour('tint', 'Tint of a pane', [1, 1, 1]),
      share('roughness', 'Roughness α', 0),
      seed(),
    ],
    ...structure('TemperedGlass', 'TemperedGlass, TemperedGlassParameters, material::{GlassBody, GlassWaves}', ['around', 'up'],
      (rust, [x, y, z] = rust('direction')) => [`wave_propagation_vector: Vec3::new(${[x, y, z].map(rustNumber).join(', ')})`]),
  },
  scratches: {
    title: 'Scratches', view: { shape: 'teapot', size: 0 },
    parameters: [
      size('scratch_size', 'Size of a cell', 0.05, 0.001, 1),
      between('scratch_length', 'Length, in cells', 1, 0.01, 1),
      size('scratch_width', 'Width, in cells', 0.01, 1e-4, 0.5, plainly),
      share('scratch_strength', 'Strength', 0.5),
      share('scratch_cover', 'Cover: scratches per cell', 2, 4),
      angle('scratch_direction', 'Direction'),
      share('scratch_spread', 'Spread', 1),
      colour('specular', 'Specular color', [0.7, 0.7, 0.7]),
      between('roughness', 'Roughness α', 0.3, 0.01, 1),
      seed(),
    ],
    ...structure('Scratches', 'Scratches, ScratchesParameters, glam::Vec2'),
  },
  variations: {
    title: 'Variations: blemishes, dents', view: { shape: 'teapot', size: 0 },
    parameters: [
      colour('diffuse', 'Diffuse color', [0.3, 0.28, 0.25]),
      colour('specular', 'Specular color', [0.2, 0.2, 0.2]),
      share('roughness', 'Roughness', 0.3),
      between('gloss_roughness', 'Roughness α of the gloss', 0.25, 0.01, 1),
      size('small_blemish_size', 'Blemishes: size', 0.003, 1e-4, 0.5),
      share('small_blemish_bump_strength', 'Blemishes: bumps', 0.03),
      share('small_blemish_color_strength', 'Blemishes: color', 0.4),
      share('dent_strength', 'Dents: strength', 0.05),
      size('dent_size', 'Dents: size', 0.1, 0.001, 5),
      share('dent_cover', 'Dents: cover', 0.3),
      whole('dent_detail', 'Dents: detail', 2, 1, 8),
      seed(),
    ],
    ...structure('Variations', 'Variations, VariationsParameters'),
  },
  brick: {
    title: 'Brick wall', view: { shape: 'room', on: 'walls', size: 0 },
    parameters: [
      size('width', 'Brick: length', 0.25, 0.02, 2),
      size('height', 'Brick: height', 0.065, 0.01, 1),
      size('mortar', 'Mortar: width', 0.01, 0.001, 0.2),
      size('depth', 'Mortar: depth', 0.006, 1e-4, 0.1),
      colour('clay', 'Color of bricks', [0.38, 0.08, 0.045]),
      share('variation', 'Variation between bricks', 0.25),
      colour('mortar_color', 'Color of the mortar', [0.46, 0.42, 0.37]),
      share('roughness', 'Roughness', 0.7),
    ],
    uses: 'Brick, material::BrickWall',
    code: rust => `BrickWall {
        bricks: Brick::new(${rust('width')}, ${rust('height')}, ${rust('mortar')})?,
        depth: ${rust('depth')},
        clay: ${rust('clay')},
        variation: ${rust('variation')},
        mortar: ${rust('mortar_color')},
        roughness: ${rust('roughness')},
    }`,
  },
  marble: {
    title: 'Marble', view: { shape: 'teapot', size: 0.7 },
    parameters: [
      size('scale', 'Cells of the veins per meter', 2.5, 0.1, 100, plainly),
      seed(0),
      colour('tint', 'Tint', [1, 1, 1]),
      share('polish', 'Polish: roughness α, 0 for none', 0.05),
    ],
    uses: 'Marble, material::PolishedMarble, noise::Perlin',
    code: rust => `PolishedMarble {
        marble: Marble::new(Perlin::default(), ${rust('scale')}, ${rust('seed')})?,
        tint: ${rust('tint')},
        polish: ${rust('polish')},
    }`,
  },
  steam: {
    title: 'Steam over a cup', view: { shape: 'cup', size: 0, behind: 'dark' },
    parameters: [
      between('lacunarity', 'Noise: lacunarity', 2.17, 1.5, 4),
      between('gain', 'Noise: gain', 0.5, 0.05, 1),
      seed(0),
      between('octaves', 'Noise: octaves', 5, 1, 8),
      between('max_density', 'Maximum density', 2, 0.1, 4),
      between('exponent', 'Exponent', 3, 0.5, 8),
      check('veins', 'Veins: the sine of the turbulence', false),
      size('radius', 'Steam: radius', 0.05, 0.01, 0.2),
      size('height', 'Steam: height', 0.16, 0.02, 0.5),
      size('cells', 'Cells of the noise per meter', 40, 2, 500, plainly),
      size('extinction', 'Extinction per cell', 3, 0.01, 30, plainly),
      share('albedo', 'Scattering albedo', 0.9),
    ],
  },
};
const OF = Object.keys(MATERIALS);

/** The scene on a page. */
export const materials = {
  id: 'materials',
  short: 'Materials',
  title: 'Materials',
  about: 'Car paint, carpet, tempered glass, wear and tear with all parameters of Nilsson’s thesis; a wall, marble and steam of Cohen’s lectures. Each fades to its mean as pixels grow: zoom in.',
  keys: 'Drag or use the arrow keys to turn, Shift with them to move along the surface, scroll, pinch or use plus and minus to zoom in, double-click to focus on a point.',
  controls: [
    { kind: 'group', label: 'Material' },
    {
      name: 'material', kind: 'choice', label: 'Material', value: 'paint', options: OF.map(id => [id, MATERIALS[id].title]),
      also: id => ({ zoom: 0, at: '', behind: 'bright', height: 14, ...MATERIALS[id].view }),
    },
    {
      name: 'shape', kind: 'choice', label: 'On', value: 'car', options: [['car', 'a car'], ['room', 'a room'], ['teapot', 'the teapot'], ['sphere', 'a sphere'], ['cup', 'a cup']],
      when: ({ material }) => material !== 'steam', also: () => ({ zoom: 0, at: '' }),
    },
    {
      name: 'on', kind: 'choice', label: 'In the room, on', value: 'all', options: [['all', 'floor and walls'], ['floor', 'the floor'], ['walls', 'the walls']],
      when: ({ material, shape }) => shape === 'room' && material !== 'steam',
    },
    { name: 'size', kind: 'range', label: 'Size relative to reality', min: -1, max: 1.5, step: 0.01, value: 0, says: x => `× ${plainly(10 ** x)}` },
    ...OF.flatMap(id => [
      { kind: 'group', label: MATERIALS[id].title, when: ({ material }) => material === id },
      ...MATERIALS[id].parameters.map(({ field, ...control }) => ({ ...control, name: `${id}.${field}` })),
    ]),
    { kind: 'group', label: 'Light' },
    { name: 'light', kind: 'choice', label: 'Light', value: 'studio', options: [['studio', 'Studio'], ['day', 'Day'], ['own', 'Your own image']] },
    { kind: 'file', name: 'picture', label: 'Your own environment image (HDR, PNG, JPEG)', accept: '.hdr,.png,.jpg,.jpeg,image/*' },
    { name: 'lightTurn', kind: 'range', label: 'Light azimuth', min: -180, max: 180, step: 1, value: 0, says: x => `${x}°` },
    { name: 'lightHeight', kind: 'range', label: 'Sun elevation', min: 0, max: 90, step: 1, value: 38, says: x => `${x}°`, when: ({ light }) => light === 'day' },
    { name: 'lamps', kind: 'choice', label: 'Number of lamps for the light', value: '8', options: [['4', '4'], ['8', '8'], ['16', '16']] },
    { name: 'behind', kind: 'choice', label: 'Behind', value: 'bright', options: [['bright', 'Bright paper'], ['dark', 'Dark paper'], ['light', 'The light']] },
    { name: 'exposure', kind: 'range', label: 'Exposure', min: -3, max: 3, step: 0.1, value: 0, says: x => `${x > 0 ? '+' : ''}${x} stops` },
    { kind: 'group', label: 'View' },
    { name: 'zoom', kind: 'range', label: 'Zoom', min: 0, max: 4, step: 0.01, value: 0, says: z => times(10 ** z) },
    { name: 'turn', kind: 'range', label: 'Rotation', min: -180, max: 180, step: 0.1, value: -52, says: x => `${Math.round(x)}°` },
    { name: 'height', kind: 'range', label: 'Height', min: -89, max: 89, step: 0.1, value: 14, says: x => `${Math.round(x)}°` },
    { name: 'at', kind: 'place', label: 'Position', value: '', axes: 3 },
  ],
  async open(page) {
    return new Materials(page);
  },
};

/** Texture coordinates in units of length, if a mesh has them. */
const metric = mesh => new Mesh(mesh.corners.map(corner => ({ ...corner, uv: corner.metric ?? corner.uv })), mesh.name);

class Materials extends Looking {
  constructor(page) {
    super(page, {
      car: { field: 0.52, distance: 8.4, target: [0, 0, 0.62], made: carBody, metres: 1, kind: 1, ground: [6, 2.2, 0.95] },
      room: { field: 0.7, distance: 8.2, target: [0, 0.1, 0.9], metres: 1, kind: 2 },
      teapot: { field: 0.62, distance: 8.6, target: [0.35, 0, 1.35], made: () => metric(teapot(page.data.teapot)), metres: 0.04, kind: 0, ground: [9, 2.1, 1.9] },
      sphere: { field: 0.5, distance: 5.2, target: [0, 0, 1], made: sphere, metres: 0.1, kind: 0, ground: [4, 0.7, 0.7] },
      cup: { field: 0.5, distance: 0.52, target: [0, 0, 0.1], made: cup, metres: 1, kind: 0, ground: [0.5, 0.085, 0.085] },
    }, 4);
    this.lights = null;
    this.own = null;
    materials.controls.find(({ name }) => name === 'picture').read = file => this.drop(file);
  }

  /** Reads a user's environment image. */
  async drop(file) {
    try {
      this.own = await readLight(fitting(file));
      this.page.set({ light: 'own' });
    } catch (error) {
      this.page.complain(error);
    }
  }

  subject(settings) {
    return this.subjects[settings.material === 'steam' ? 'cup' : settings.shape];
  }

  /** Returns a ray's hit. */
  shape(settings) {
    const kind = settings.material === 'steam' ? 'cup' : settings.shape;
    return kind === 'room' ? this.room(settings).all : super.shape({ ...settings, shape: kind });
  }

  room({ on }) {
    const key = `room ${on}`;
    if (!this.shapes.has(key)) this.shapes.set(key, room(on));
    return this.shapes.get(key);
  }

  /** Returns a mesh other than the subject, created once. */
  thing(name, made) {
    if (!this.shapes.has(name)) this.shapes.set(name, made());
    return this.shapes.get(name);
  }

  /** Returns the value of a parameter in the settings. */
  numbers({ material, ...settings }) {
    return MATERIALS[material].parameters.flatMap(({ field, numbers }) => numbers(settings[`${material}.${field}`]));
  }

  /** Resources of the material's shader. Parameters rejected by the crate keep the last ones. */
  uniforms(settings) {
    const { material } = settings, key = [material, this.numbers(settings)].join();
    if (this.uniformsOf !== key) {
      const numbers = this.numbers(settings);
      const words = this.page.rust[`material_${material}`](numbers), count = words[0];
      const own = words.slice(1, 1 + count), sums = words.slice(1 + count);
      const name = { paint: 'metallic_paint', glass: 'tempered_glass', brick: 'brick_wall', marble: 'polished_marble' }[material] ?? material;
      const bound = { [`${name}_uniform`]: own, fbm_uniform_3d: sums };
      if (material === 'steam') {
        const [radius, height, cells, extinction, albedo] = numbers.slice(7);
        Object.assign(bound, { steam_gas: own, steam_view: new Float32Array([0, 0, 0.074, radius, height, cells, extinction, albedo]) });
      }
      this.bound = { program: `materials-${material}`, resources: bound };
      this.uniformsOf = key;
    }
    return this.bound;
  }

  /** The light of the settings, recomputed on change. */
  lit(settings) {
    const key = [settings.light, settings.lightTurn, settings.lightHeight, settings.lamps].join();
    if (this.lights?.key !== key || this.lights.own !== this.own) {
      if (this.lights) this.page.gpu.forget(this.lights.words);
      this.lights = { key, own: this.own, ...lightFor(settings, this.own) };
    }
    return this.lights;
  }

  exposure(settings) {
    const { mean } = this.lit(settings);
    return 0.6 * 2 ** settings.exposure / Math.max(mean, 1e-6);
  }

  view(settings, camera, size, kind) {
    const { eye, right, up, forward, half, focus, near } = camera, subject = this.subject(settings), { gpu } = this.page;
    const ground = subject.ground ?? [0, 1, 1];
    return new Float32Array([
      ...eye, 2 * half / size, ...right, size, ...up, this.exposure(settings), ...forward, subject.metres * 10 ** settings.size,
      ...focus, this.lit(settings).lamps, ...gpu.near(near), gpu.rows, kind, ...ground, { light: 1, dark: -1 }[settings.behind] ?? 0,
    ]);
  }

  passes(settings, size) {
    const camera = this.camera(settings), { focus } = camera, { program, resources: own } = this.uniforms(settings);
    const { words, uniform } = this.lit(settings);
    const { kind: seenAs } = this.subject(settings), lighting = { light: uniform, light_word: words };
    const resources = { ...own, ...lighting, materials_view: this.view(settings, camera, size, seenAs) };
    // Only a room is invisible from behind, and only a car body has windows.
    const about = { ...resources, materials_view: this.view(settings, camera, size, seenAs === 2 ? 3 : 0) };
    const placed = (role, shape) => this.placed(role, shape, focus), passes = [];
    const add = (of, mesh, bound = about) => passes.push({ program: of, resources: bound, mesh });
    const kind = settings.material === 'steam' ? 'cup' : settings.shape;
    const { ground: around } = this.subject(settings);
    add('materials-behind');
    if (kind === 'room') {
      const { own: mine, other } = this.room(settings);
      this.triangles = mine.triangles + other.triangles;
      add(program, placed('subject', mine), resources);
      if (other.triangles) add('materials-plain', placed('other', other));
      return passes;
    }
    const plain = settings.material === 'steam' ? program : 'materials-plain';
    add(program, this.mesh(settings, camera), resources);
    if (kind === 'car') add('materials-plain', placed('wheels', this.thing('wheels', wheels)));
    if (around) add(plain, placed('ground', this.thing(`ground ${around[0]}`, () => ground(around[0]))));
    if (settings.material === 'steam') add(program, placed('sky', this.thing('sky', () => sky(40))));
    return passes;
  }

  say(settings) {
    return `${this.lit(settings).lamps} lamps · ${this.triangles} triangles${settings.light === 'own' && !this.own ? ' · no image yet, using the studio' : ''}`;
  }

  alt(settings) {
    const { title } = MATERIALS[settings.material], on = { car: 'a car', room: 'a room', teapot: 'a teapot', sphere: 'a sphere', cup: 'a cup' }[settings.shape];
    return `${title}${settings.material === 'steam' ? '' : ` on ${on}`}, at zoom ${times(10 ** settings.zoom)}. ${materials.keys}`;
  }

  described(settings) {
    return { ...this.camera(settings), shape: settings.shape, settings };
  }

  program(settings) { return this.uniforms(settings).program; }

  rustCode(settings) {
    const { material } = settings, { parameters, uses, code } = MATERIALS[material];
    const setting = field => settings[`${material}.${field}`];
    const rust = field => field === 'direction' ? [...turnOf(setting('around')), Math.tan(setting('up') * Math.PI / 180)] : parameters.find(p => p.field === field).rust(setting(field));
    const at = this.focus(settings).map(x => x * this.subject(settings).metres * 10 ** settings.size);
    if (material === 'steam') return steamCode(rust);
    return `// asperity-shading with its default features
use asperity_shading::glam::Vec3;
use asperity_shading::{Footprint, Material, SurfacePoint, ${uses}};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let material = ${code(rust, parameters.map(({ field }) => field))};
    // A surface point in meters, and the width of a pixel there.
    let at = Vec3::new(${at.map(rustNumber).join(', ')});
    let point = SurfacePoint::new(at, Vec3::Z, Footprint::from_width(1e-3)).with_uv(at.truncate(), [Vec3::X, Vec3::Y]);
    let (light, eye) = (Vec3::new(0.48, 0.6, 0.64), Vec3::Z);
    // Reflectance times the cosine of the light, in 1/sr.
    println!("{}", material.bsdf(&point, eye).eval_cos(eye, light));
    Ok(())
}
`;
  }
}

const steamCode = rust => `// asperity-shading with its default features
use asperity_shading::Footprint;
use asperity_shading::glam::Vec3;
use asperity_shading::noise::{Fbm, FbmSpectrum, Normalization, Perlin, Turbulence};
use asperity_shading::texture::{Gas, Steam, march};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let octaves = Fbm::new(Perlin::new(${rust('seed')}), FbmSpectrum::new(${rust('lacunarity')}, ${rust('gain')}, 8)?)
        .with_normalization(Normalization::UnitRange)
        .with_shape(Turbulence)
        .with_octaves(${rust('octaves')});
    let gas = Gas::new(octaves, ${rust('max_density')}, ${rust('exponent')})?${rust('veins') === 'true' ? '.with_veins()' : ''};
    // Lengths are in cells of the noise.
    let cells: f32 = ${rust('cells')};
    let steam = Steam::new(Vec3::ZERO, ${rust('radius')} * cells, ${rust('height')} * cells)?;
    let (eye, direction) = (Vec3::new(0.0, -10.0, 1.0), Vec3::Y);
    let extinction = |p: Vec3| ${rust('extinction')} * steam.share(p) * gas.clamped_density(p * Vec3::new(1.0, 1.0, 0.5), Footprint::from_width(0.1));
    let seen = march(eye, direction, steam.interval(eye, direction), 0.35, 0.5, extinction, |_| Vec3::splat(${rust('albedo')}));
    println!("{} {}", seen.light, seen.transmittance);
    Ok(())
}
`;
