// Noise of every type, dimension, sum, warp and view: it renders, with the mean and the deviation
// that the crate states.

import { open } from './launch.mjs';

/**
 * Renders every type, dimension and sum at 64², single octaves and all warped sums, also as a flow;
 * returns the names of blank images.
 */
const drawnAll = async all => {
  const page = globalThis.asperity, { controls } = page.scene, SIZE = 64;
  const options = name => controls.find(control => control.name === name).options.map(([value]) => value);
  const empty = [];
  let count = 0;
  for (const kind of options('kind')) {
    for (const dimension of options('dimension')) {
      if (page.instance.told({ ...page.settings, kind, dimension }).dimension !== +dimension) continue;
      for (const sum of options('sum')) {
        // White noise has no slopes.
        const shows = kind === 'white' ? ['value'] : ['value', 'flow'], further = shows.flatMap(show => [0, 0.7].map(warp => [warp, show]));
        for (const [warp, show] of dimension !== '4' && (all || sum === 'octaves') ? further : [[0, 'value']]) {
          Object.assign(page.settings, { kind, dimension, sum, warp, show });
          await page.picture(SIZE, SIZE, () => false);
          const data = await page.gpu.pixels(page.target), colours = new Set();
          for (let k = 0; k < data.length; k += 4) colours.add(data[k] << 16 | data[k + 1] << 8 | data[k + 2]);
          if (colours.size < 9) empty.push([kind, dimension, sum, warp, show, colours.size].join(' '));
          count++;
        }
      }
    }
  }
  return { count, empty };
};

/**
 * Returns mean and deviation of one octave and of sums of each type, relative to the crate's
 * statement, in standard errors.
 */
const measuredAll = async () => {
  const page = globalThis.asperity, { controls } = page.scene, rows = [];
  const options = name => controls.find(control => control.name === name).options.map(([value]) => value);
  for (const kind of options('kind')) {
    for (const dimension of options('dimension')) {
      for (const sum of ['one', 'octaves']) {
        const settings = { ...page.settings, kind, dimension, sum };
        if (page.instance.told(settings).dimension !== +dimension) continue;
        const values = await page.instance.everywhere(settings), moment = f => values.reduce((sum, x) => sum + f(x), 0) / values.length;
        const mean = moment(x => x), variance = moment(x => (x - mean) ** 2), deviation = Math.sqrt(variance);
        const fourth = moment(x => (x - mean) ** 4) / variance ** 2;
        const moments = page.rust.noise_moments(page.instance.spec(settings, 1)), own = [...new Float32Array(moments.buffer)];
        // A sum has variance 1, and mean 0 if its octaves do. Cellular octaves are distances.
        const stated = sum === 'one' ? own : [kind === 'cellular' && sum === 'octaves' ? mean : 0, 1];
        const errors = [deviation, deviation * Math.sqrt((fourth - 1) / 4)].map(x => x / Math.sqrt(values.length));
        rows.push({ name: `${kind} ${dimension} ${sum}`, off: [mean, deviation].map((x, k) => (x - stated[k]) / errors[k]), mean, deviation, stated });
      }
    }
  }
  return rows;
};

/** Measures and renders noise of every type. */
export async function noises(browser, api, address, tell, all = false) {
  const { page, said } = await open(browser, address(api, 64, '#noise?charts=false'));
  const rows = await page.evaluate(measuredAll), far = ({ off }) => Math.max(...off.map(Math.abs));
  const furthest = rows.reduce((a, b) => far(b) > far(a) ? b : a), wrong = rows.filter(row => !(far(row) < 5));
  const told = ({ name, mean, deviation, stated }) => `${name}: mean ${mean.toFixed(3)}, deviation ${deviation.toFixed(3)}, stated ${stated.map(x => x.toFixed(3)).join(', ')}`;
  const text = `${rows.length} kinds, dimensions and sums; furthest, by ${far(furthest).toFixed(1)} standard errors, ${told(furthest)}`;
  tell(`${api}: noise has the mean and deviation that the crate states`, wrong.length === 0 && rows.length > 50, wrong.length ? wrong.map(told).join(' | ') : text);
  const { count, empty } = await page.evaluate(drawnAll, all);
  tell(`${api}: noise of every kind, dimension, sum, warp and view is drawn`, empty.length === 0 && count > 200, `${count} pictures${empty.map(name => `, not ${name}`).join('')}`);
  // A driver's performance note about reading many images.
  const complaints = said.filter(line => !/GL_CLOSE_PATH_NV/.test(line));
  tell(`${api}: and says nothing`, complaints.length === 0, complaints.slice(0, 3).join(' | '));
  await page.context().close();
}
