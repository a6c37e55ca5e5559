// Motion: seamless zoom to ten thousand, pinch gestures, no unrequested changes.

import { open } from './launch.mjs';

/** Frames per tenth of a power of ten. */
const FINE = 4;

/**
 * The center of the image of bumps from × 1 to × 10,000: its mean brightness, and its correlation
 * with the previous frame.
 */
async function walked(page) {
  return page.evaluate(async steps => {
    const page = globalThis.asperity, SIZE = 96, frames = [];
    page.settings.at = page.instance.named(page.instance.focus(page.settings));
    let before = null;
    for (let k = 0; k <= steps; k++) {
      page.settings.zoom = 4 * k / steps;
      await page.picture(SIZE, SIZE, () => false);
      const data = await page.gpu.pixels(page.target), values = [];
      for (let y = 0; y < SIZE; y++) {
        for (let x = 0; x < SIZE; x++) if (Math.hypot(x + 0.5 - SIZE / 2, y + 0.5 - SIZE / 2) < SIZE / 6) values.push(data[4 * (y * SIZE + x) + 1]);
      }
      const mean = values.reduce((sum, x) => sum + x, 0) / values.length, apart = values.map(x => x - mean);
      const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
      frames.push({ mean, correlation: before ? dot(apart, before) / Math.sqrt(dot(apart, apart) * dot(before, before)) : 1 });
      before = apart;
    }
    return frames;
  }, 40 * FINE);
}

/**
 * Bumps zoom without a seam: a quarter of a zoom step changes the mean by less than the step,
 * whereas a jump would change it equally. More than half of the variance of a frame is in the next
 * frame, whereas other bumps would be uncorrelated.
 */
export async function seams(browser, api, address, tell) {
  const { page } = await open(browser, address(api, 96, '#bumps'));
  const frames = await walked(page), most = apart => Math.max(...frames.slice(apart).map(({ mean }, k) => Math.abs(mean - frames[k].mean)));
  const [whole, part] = [most(FINE), most(1)], alike = Math.min(...frames.map(({ correlation }) => correlation));
  const text = `${frames.length} frames; at most ${whole.toFixed(1)} of 255 in a tenth of a power of ten, ${part.toFixed(1)} in a quarter of that; correlation at least ${alike.toFixed(2)}`;
  tell(`${api}: bumps come nearer without a seam`, part < whole / 2 && whole > 1 && alike > Math.SQRT1_2, text);
  await page.context().close();
}

/**
 * The means printed below the strip: with the exact rule they are 1 within their errors at every
 * zoom, with the rule of 2001 they are not.
 */
export async function strip(browser, api, address, tell) {
  const { page } = await open(browser, address(api, 64, '#bumps?strip=true'));
  const rows = await page.evaluate(() => [...document.querySelectorAll('.strip .row')].map(row => [...row.querySelectorAll('output')].map(o => o.textContent)));
  const [exact, fractal] = rows.map(row => row.map(text => {
    const [, mean, error] = /: (-?[\d.]+) ± ([\d.]+)$/.exec(text).map(Number);
    // Both are rounded to hundredths.
    return Math.max(0, Math.abs(mean - 1) - 0.005) / (error + 0.005);
  }));
  tell(`${api}: the exact rule keeps the mean brightness`, exact.length === 5 && Math.max(...exact) < 4, rows[0].join(', '));
  tell(`${api}: the rule of 2001 has it from afar and loses it near by`, fractal[0] < 4 && Math.min(...fractal.slice(1)) > 4, rows[1].join(', '));
  await page.context().close();
}

/** Two fingers that move to three times their distance. */
async function pinched(page, selector) {
  await page.locator(selector).scrollIntoViewIfNeeded();
  const box = await page.locator(selector).boundingBox(), session = await page.context().newCDPSession(page);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  const touch = (type, half) => session.send('Input.dispatchTouchEvent', {
    type, touchPoints: half ? [-half, half].map((dx, id) => ({ x: x + dx, y, id })) : [],
  });
  await touch('touchStart', 30);
  for (let half = 40; half <= 90; half += 10) await touch('touchMove', half);
  await touch('touchEnd', 0);
  await page.evaluate(() => globalThis.asperity.rest());
  return page.evaluate(() => globalThis.asperity.settings);
}

/** A pinch on a phone zooms by the ratio of finger distances. */
export async function pinches(browser, address, tell) {
  const scenes = { bumps: ['#view', s => 10 ** s.zoom], noise: ['#view', s => 2 ** (3 - s.near)], fractals: ['.traced', s => 10 ** s.zoom], materials: ['#view', s => 10 ** s.zoom] };
  for (const [scene, [selector, nearer]] of Object.entries(scenes)) {
    const { page } = await open(browser, address('webgl2', 64, `#${scene}`), { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
    const times = nearer(await pinched(page, selector));
    tell(`phone: two fingers come nearer in ${scene}`, Math.abs(times / 3 - 1) < 0.01, `fingers 3 times as far apart, ${times.toFixed(3)} times nearer`);
    await page.context().close();
  }
}

/** Nothing is rendered without a request, with and without reduced motion. */
export async function rests(browser, address, tell) {
  for (const scene of ['bumps', 'noise', 'fractals', 'materials']) {
    for (const reducedMotion of ['reduce', 'no-preference']) {
      const { page } = await open(browser, address('webgl2', 64, `#${scene}`), { reducedMotion });
      const drawn = await page.evaluate(async () => {
        const { gpu } = globalThis.asperity, { draw } = gpu, { putImageData } = CanvasRenderingContext2D.prototype;
        let count = 0;
        gpu.draw = (...all) => { count++; return draw.apply(gpu, all); };
        CanvasRenderingContext2D.prototype.putImageData = function (...all) { count++; return putImageData.apply(this, all); };
        const seen = new MutationObserver(changes => { count += changes.length; });
        seen.observe(document.body, { subtree: true, childList: true, attributes: true, characterData: true });
        await new Promise(resolve => setTimeout(resolve, 1000));
        return count + document.getAnimations().length;
      });
      tell(`rest: ${scene} does not move unasked (${reducedMotion})`, drawn === 0, `${drawn} changes in a second`);
      await page.context().close();
    }
  }
}
