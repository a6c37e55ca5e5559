// Measures milliseconds per frame and of the module's map, and memory after a thousand brush
// strokes.

import { open } from './launch.mjs';

/** Strokes between two memory measurements. */
const STROKES = 250;

const middle = times => times.sort((a, b) => a - b)[times.length >> 1];

/** Renders an image of 512² per link, in bands while the page is open. */
async function frames(browser, api, address, links) {
  for (const [name, link] of Object.entries(links)) {
    const { page } = await open(browser, address(api, 512, link));
    const ms = await page.evaluate(() => {
      const { instance, perPixel } = globalThis.asperity;
      return instance.passes ? perPixel * 512 * 512 : instance.surface.busy;
    });
    console.log(`time   ${api}: ${name}, 512²: ${ms.toFixed(0)} ms`);
    await page.context().close();
  }
}

/** Starts counting GPU allocations. */
const counted = () => {
  const held = globalThis.held = { textures: 0, buffers: 0, others: 0 };
  const wrap = (owner, name, kind, by) => {
    const original = owner[name];
    owner[name] = function (...all) {
      if (by > 0 || all[0] !== null) held[kind] += by;
      return original.apply(this, all);
    };
  };
  if (globalThis.asperity.gpu.api === 'WebGPU') {
    wrap(GPUDevice.prototype, 'createTexture', 'textures', 1);
    wrap(GPUTexture.prototype, 'destroy', 'textures', -1);
    wrap(GPUDevice.prototype, 'createBuffer', 'buffers', 1);
    wrap(GPUBuffer.prototype, 'destroy', 'buffers', -1);
  } else {
    const gl = globalThis.asperity.canvas.getContext('webgl2');
    for (const [name, kind] of [['Texture', 'textures'], ['Buffer', 'buffers'], ['Framebuffer', 'others'], ['Renderbuffer', 'others'], ['VertexArray', 'others']]) {
      wrap(gl, `create${name}`, kind, 1);
      wrap(gl, `delete${name}`, kind, -1);
    }
  }
};

/** Memory after 250, 500, 750 and 1,000 rendered strokes. */
async function strokes(browser, api, address, tell) {
  const { page } = await open(browser, address(api, 64, '#bumps?shape=sphere&density=painted'));
  const session = await page.context().newCDPSession(page), rows = [];
  await page.evaluate(counted);
  let map = 0, ms = 0;
  for (let k = 0; k < 4; k++) {
    const told = await page.evaluate(async ([from, count]) => {
      const page = globalThis.asperity, start = performance.now();
      for (let k = from; k < from + count; k++) {
        page.scene.painting.stroke((k * 7) % 40, (k * 13) % 40, k % 3 ? 3 : -5);
        await page.rest();
      }
      return { ms: performance.now() - start, module: page.rust.bytes(), map: page.instance.map.byteLength, ...globalThis.held };
    }, [k * STROKES, STROKES]);
    for (let k = 0; k < 2; k++) await session.send('HeapProfiler.collectGarbage');
    const { usedSize, backingStorageSize = 0 } = await session.send('Runtime.getHeapUsage');
    ({ map } = told);
    ms += told.ms;
    rows.push({ ...told, script: usedSize + backingStorageSize });
  }
  const all = name => rows.map(row => row[name]), [first, last] = [rows[0], rows[3]];
  const megabytes = name => all(name).map(x => (x / 1e6).toFixed(2)).join(', ');
  console.log(`time   ${api}: a stroke, its map of 40² and a picture of 64²: ${(ms / 4 / STROKES).toFixed(1)} ms`);
  tell(`${api}: memory of the module does not grow by strokes`, last.module === first.module, `${megabytes('module')} MB`);
  const objects = ['textures', 'buffers', 'others'];
  tell(`${api}: nothing more is held on the graphics card`, objects.every(name => last[name] === first[name]), objects.map(name => `${name} ${all(name).join(', ')}`).join('; '));
  // If each stroke leaked a map, growth would be a map per stroke. A hundredth of that is a leak of
  // one map per hundred strokes.
  const most = 3 * STROKES * map / 100;
  tell(`${api}: memory of the scripts does not grow by strokes`, last.script - first.script < most, `${megabytes('script')} MB; a map has ${(map / 1e3).toFixed(0)} kB`);
  await page.context().close();
}

/** Runs all measurements. */
export async function times(browser, api, address, links, tell) {
  await frames(browser, api, address, links);
  const { page } = await open(browser, address(api, 64, '#bumps?density=painted'));
  const map = await page.evaluate(() => {
    const { rust } = globalThis.asperity, texels = Float32Array.from({ length: 65536 }, (_, k) => 1 + k % 7);
    return Array.from({ length: 9 }, () => {
      const start = performance.now();
      rust.painted_map([256], texels);
      return performance.now() - start;
    });
  });
  console.log(`time   ${api}: the module packs a map of 256²: ${middle(map).toFixed(1)} ms`);
  await page.context().close();
  await strokes(browser, api, address, tell);
}
