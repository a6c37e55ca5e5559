// Copied code, invalid links, and the resolution of final images.

import { open } from './launch.mjs';

/**
 * Returns the WGSL of every program reachable by a scene's choices, from its button, and the errors
 * of Chromium.
 */
const refusedOf = async () => {
  const page = globalThis.asperity, { controls } = page.scene, refused = [], seen = new Set();
  const device = await (await navigator.gpu.requestAdapter()).requestDevice();
  const options = name => name ? controls.find(control => control.name === name).options.map(([value]) => value) : [undefined];
  const [first, second] = { bumps: ['density'], noise: ['kind', 'dimension'], fractals: ['surface'], materials: ['material'] }[page.scene.id];
  for (const a of options(first)) {
    for (const b of options(second)) {
      Object.assign(page.settings, { [first]: a, ...second && { [second]: b } });
      const code = await new Promise(resolve => {
        navigator.clipboard.writeText = async text => resolve(text);
        document.getElementById('wgsl').click();
      });
      if (seen.has(code)) continue;
      seen.add(code);
      const { messages } = await device.createShaderModule({ code }).getCompilationInfo();
      refused.push(...messages.map(({ type, lineNum, message }) => `${[a, b].filter(Boolean).join(' ')}: ${type} in line ${lineNum}: ${message}`));
    }
  }
  return { count: seen.size, refused };
};

/** Every scene copies WGSL that compiles. */
export async function copies(browser, address, tell) {
  for (const scene of ['bumps', 'noise', 'fractals', 'materials']) {
    const { page } = await open(browser, address('webgpu', 64, `#${scene}?charts=false`));
    await page.locator('#wgsl').waitFor({ timeout: 5000 }).catch(() => {});
    const shown = await page.locator('#wgsl').isVisible(), { count, refused } = shown ? await page.evaluate(refusedOf) : { count: 0, refused: [] };
    tell(`webgpu: Copy as WGSL compiles for ${scene}`, count > 0 && refused.length === 0, refused[0] ?? `${count} texts`);
    await page.context().close();
  }
}

/** Links with invalid parameters: the defaults apply, and the scene renders. */
export async function nonsense(browser, api, address, tell, spreadOf) {
  const links = {
    'bumps': 'zoom=NaN&turn=1e999&at=e,-,.&density=no&alphaX=-7&seed=&painting=!&strip=maybe',
    'bumps, at Infinity': 'at=1e999,0,0&zoom=2',
    'noise': 'kind=pink&at=e,e&near=NaN&octaves=many&third=Infinity&charts=false',
    'fractals': 'place=-,e&at=e&nearer=NaN&zoom=NaN&turn=x&surface=cube',
    'materials': 'material=gold&at=NaN,NaN,NaN&paint.specular=red&light=neon&zoom=-',
  };
  for (const [name, words] of Object.entries(links)) {
    const { page, said } = await open(browser, address(api, 96, `#${name.split(',')[0]}?${words}`));
    const state = await page.textContent('#state'), spread = await spreadOf(page);
    const whole = await page.evaluate(() => Object.values(globalThis.asperity.settings).every(value => typeof value !== 'number' || Number.isFinite(value)));
    tell(`${api}: a link of nonsense draws ${name}`, whole && spread > 5 && said.length === 0 && / ms/.test(state), `deviation ${spread.toFixed(1)}; ${state} ${said.join(' | ')}`);
    await page.context().close();
  }
}

/**
 * If rendering is fast, the final image has twice the screen's resolution for antialiasing,
 * otherwise the screen's resolution.
 */
export async function smooth(browser, file, tell) {
  const { page } = await open(browser, `${file}?api=webgl2#noise?kind=white&sum=one&charts=false`, { viewport: { width: 340, height: 400 } });
  // A fake clock that determines the render time independent of load.
  const drawnIn = ms => page.evaluate(async ms => {
    let now = 0;
    performance.now = () => now += ms;
    globalThis.asperity.changed();
    await globalThis.asperity.rest();
    return globalThis.asperity.canvas.width;
  }, ms);
  const shown = Math.round(await page.evaluate(() => globalThis.asperity.canvas.getBoundingClientRect().width));
  const [quick, slow] = [await drawnIn(0), await drawnIn(200)];
  tell('webgl2: a quick picture is finer than the screen at rest, a slow one is not', quick === 2 * shown && slow === shown, `${quick} and ${slow} pixels on ${shown}`);
  await page.context().close();
}
