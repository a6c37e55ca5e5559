// Tests the live page in headless Chromium, with WebGPU and with WebGL 2:
// `node check.mjs FOLDER [OUT] [--times]`, where FOLDER contains the page's index.html. Prints a
// line per check, writes screenshots to OUT, and fails if a check fails. With --times it only
// measures time and memory.

import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { drops } from './dropped.mjs';
import { copies, nonsense, smooth } from './given.mjs';
import { launch, open, program } from './launch.mjs';
import { pinches, rests, seams, strip } from './motion.mjs';
import { noises } from './noises.mjs';
import { times } from './times.mjs';

const [folder, out = 'screens', ...options] = process.argv.slice(2);
const file = pathToFileURL(resolve(folder, 'index.html')).href;
const address = (api, size, link) => `${file}?api=${api}&size=${size}&strip=64${link}`;
if (!program) {
  console.log('skipped: no Chromium is installed (Debian’s chromium), and the variable CHROMIUM names none');
  process.exit(0);
}
mkdirSync(out, { recursive: true });

/** Scenes rendered with both interfaces, as links. */
const PICTURES = {
  'bumps': '#bumps',
  'bumps-near': '#bumps?zoom=2&density=beckmann',
  'bumps-nearest': '#bumps?zoom=4&density=student-t&at=0.1791,-1.7011,1.9478',
  'bumps-plane': '#bumps?shape=plane&turn=-90&height=21&rule=both',
  'bumps-painted': '#bumps?shape=sphere&density=painted&zoom=0.5',
  'fractals': '#fractals',
  'fractals-nearest': '#fractals?zoom=6&place=0.8,0.7&colours=contrast',
  'fractals-folded': '#fractals?surface=folded',
  'fractals-folded-nearest': '#fractals?surface=folded&zoom=6&place=0.8,0.7&colours=contrast',
  'fractals-curve': '#fractals?surface=none&nearer=6&at=0.634921',
  'noise': '#noise',
  'materials-paint': '#materials',
  'materials-carpet': '#materials?material=carpet&shape=room&on=floor&zoom=0.6&height=30',
  'materials-glass': '#materials?material=glass&shape=teapot&behind=dark',
  'materials-scratches': '#materials?material=scratches&shape=sphere',
  'materials-variations': '#materials?material=variations&shape=teapot',
  'materials-brick': '#materials?material=brick&shape=room&on=walls',
  'materials-marble': '#materials?material=marble&shape=teapot&size=0.7',
  'materials-steam': '#materials?material=steam&behind=dark',
};
/** Timed scenes: each scene, and each material. */
const TIMED = Object.fromEntries(Object.entries(PICTURES).filter(([name]) => !/nearest|near$|plane|curve/.test(name)));
const SCENES = ['bumps', 'noise', 'fractals', 'materials'];

let failed = 0;
function tell(name, passed, text = '') {
  if (!passed) failed++;
  console.log(`${passed ? 'ok    ' : 'FAILED'} ${name}${text ? ': ' + text : ''}`);
}

const pixelsOf = async page => {
  const { width, height, data } = await page.evaluate(async () => {
    const { width, height, data } = await globalThis.asperity.pixels();
    let text = '';
    for (let i = 0; i < data.length; i += 8192) text += String.fromCharCode(...data.subarray(i, i + 8192));
    return { width, height, data: btoa(text) };
  });
  return { width, height, data: Buffer.from(data, 'base64') };
};

/** Returns the fraction of pixels with a channel that differs by more than `most`. */
function differing(a, b, most) {
  if (a.data.length !== b.data.length) return 1;
  let count = 0;
  for (let i = 0; i < a.data.length; i += 4) {
    count += [0, 1, 2].some(k => Math.abs(a.data[i + k] - b.data[i + k]) > most);
  }
  return count / (a.data.length / 4);
}

/** Returns the deviation of the green channel: 0 for a blank image. */
function deviation({ data }) {
  let [sum, squares, count] = [0, 0, 0];
  for (let i = 1; i < data.length; i += 4) { sum += data[i]; squares += data[i] ** 2; count++; }
  return Math.sqrt(squares / count - (sum / count) ** 2);
}

const set = (page, values) => page.evaluate(async values => { globalThis.asperity.set(values); await globalThis.asperity.rest(); }, values);
const state = page => page.textContent('#state');
const givenTo = async (page, input, name, mimeType, buffer) => {
  await page.setInputFiles(input, { name, mimeType, buffer });
  await page.waitForTimeout(300);
  await page.evaluate(() => globalThis.asperity.rest());
};

if (options.includes('--times')) {
  for (const api of ['webgl2', 'webgpu']) {
    const browser = await launch(api);
    await times(browser, api, address, TIMED, tell);
    await browser.close();
  }
  process.exit(failed ? 1 : 0);
}

const drawn = {};
for (const api of ['webgpu', 'webgl2']) {
  const browser = await launch(api);
  for (const [name, link] of Object.entries(PICTURES)) {
    const { page, said } = await open(browser, address(api, 256, link));
    const name2 = await page.evaluate(() => globalThis.asperity?.gpu?.api ?? document.getElementById('state').textContent);
    tell(`${api}: ${name} renders`, name2 === { webgpu: 'WebGPU', webgl2: 'WebGL 2' }[api], name2);
    const pixels = await pixelsOf(page);
    (drawn[name] ??= []).push(pixels);
    const spread = deviation(pixels);
    tell(`${api}: ${name} is not blank`, spread > 5, `deviation ${spread.toFixed(1)} of 255`);
    tell(`${api}: ${name} logs nothing to the console`, said.length === 0, said.join(' | '));
    tell(`${api}: ${name} makes no further request`, said.requests.length === 1, `${said.requests.length} request`);
    await page.screenshot({ path: join(out, `${name}-${api}.png`) });
    await page.context().close();
  }

  // Images that the crates render too.
  for (const zoom of [0, 2, 4]) {
    const { page } = await open(browser, address(api, 256, `#bumps?zoom=${zoom}`));
    const name = join(out, `teapot-${10 ** zoom}-${api}`);
    writeFileSync(`${name}.rgba`, (await pixelsOf(page)).data);
    writeFileSync(`${name}.json`, JSON.stringify(await page.evaluate(() => globalThis.asperity.instance.described(globalThis.asperity.settings))));
    await page.context().close();
  }

  const { page, said } = await open(browser, address(api, 128, '#bumps?density=painted'));
  const before = await pixelsOf(page);
  await page.locator('#painting').scrollIntoViewIfNeeded();
  const box = await page.locator('#painting').boundingBox();
  await page.mouse.move(box.x + box.width * 0.5, box.y + box.height * 0.25);
  await page.mouse.down();
  for (let k = 0; k < 12; k++) await page.mouse.move(box.x + box.width * (0.5 + 0.02 * k), box.y + box.height * 0.25);
  await page.mouse.up();
  await page.evaluate(() => globalThis.asperity.rest());
  const after = await pixelsOf(page);
  const changed = differing(before, after, 2);
  tell(`${api}: painting changes the image`, changed > 0.02, `${(100 * changed).toFixed(1)} % of pixels`);

  // State restored by a link.
  await set(page, { zoom: 1.3, alphaX: 0.11, seed: 21, rule: 'both', lamp: -90 });
  await page.waitForTimeout(200);
  const wanted = await pixelsOf(page), link = await page.evaluate(() => location.href);
  const again = await open(browser, link);
  const restored = differing(wanted, await pixelsOf(again.page), 0);
  tell(`${api}: a link restores the image`, restored === 0, `${link.split('#')[1].slice(0, 60)}…, ${(100 * restored).toFixed(2)} % of pixels differ`);
  await again.page.context().close();

  // Editing a fractal function: a dragged knot, an added knot, an invalid factor.
  {
    const { page } = await open(browser, address(api, 64, '#fractals'));
    const shape = () => page.evaluate(() => [globalThis.asperity.settings.knots, globalThis.asperity.settings.factors].join(' '));
    const rest = () => page.evaluate(() => globalThis.asperity.rest());
    const begun = await pixelsOf(page), first = await shape(), knot = await page.locator('.plot .knot').nth(1).boundingBox();
    await page.mouse.move(knot.x + knot.width / 2, knot.y + knot.height / 2);
    await page.mouse.down();
    await page.mouse.move(knot.x + knot.width / 2 + 20, knot.y + knot.height / 2 + 60, { steps: 4 });
    await page.mouse.up();
    await rest();
    const pulled = await shape(), changed = differing(begun, await pixelsOf(page), 2);
    tell(`${api}: a knot is dragged, and the surface follows`, pulled !== first && changed > 0.05, `${pulled}; ${(100 * changed).toFixed(1)} % of pixels`);
    await page.locator('.plot .factor').nth(0).focus();
    await page.keyboard.press('ArrowDown');
    await page.locator('.plot .knot').nth(1).focus();
    await page.keyboard.press('Insert');
    const added = await shape();
    await page.keyboard.press('Delete');
    const removed = await shape();
    tell(`${api}: keys pull factors, add and remove knots`, added.split(';').length === 6 && removed.split(';').length === 5 && removed.split(' ')[1] !== pulled.split(' ')[1], `${added}, then ${removed}`);
    await set(page, { factors: '0.5,0.5,0.5,1.5' });
    const text = await state(page);
    tell(`${api}: a factor of 1.5 shows the crate's error`, /`alpha` of map 4 must be in \(-1, 1\), got 1.5/.test(text), text);
    await set(page, { factors: '0.5,0.5,0.5,0.3' });
    tell(`${api}: the curve recovers`, !(await state(page)).includes('alpha'), await state(page));
    await page.context().close();
  }

  // Invalid files and lost devices.
  const wrong = async (name, expected, act) => {
    await act();
    const text = await state(page), lines = text.trim().split('\n').length;
    tell(`${api}: ${name}`, lines === 1 && expected.test(text), text);
    await set(page, { zoom: 0, density: 'ggx', at: '' });
    const spread = deviation(await pixelsOf(page));
    tell(`${api}: the page recovers`, spread > 5, `deviation ${spread.toFixed(1)}`);
  };
  await wrong('a text as OBJ', /is not an OBJ file/, () => givenTo(page, '#bumps-mesh', 'a.obj', 'text/plain', Buffer.from('Hello, world\n')));
  await wrong('a text as GLB', /is not a binary glTF file/, () => givenTo(page, '#bumps-mesh', 'a.glb', 'text/plain', Buffer.from('Hello, world, this is a text\n')));
  await wrong('an OBJ with a missing vertex', /refers to a missing or invalid vertex/, () =>
    givenTo(page, '#bumps-mesh', 'b.obj', 'text/plain', Buffer.from('v 0 0 0\nv 1 0 0\nf 1 2 9\n')));
  await wrong('a picture of 0 by 0', /not an image that this browser supports/, () => givenTo(page, '#painting-file', 'empty.png', 'image/png', Buffer.alloc(0)));
  await wrong('a black painting', /The painting is not a density/, async () => {
    await set(page, { density: 'painted' });
    await page.selectOption('#painting-start', 'black');
    await page.waitForTimeout(200);
    await page.evaluate(() => globalThis.asperity.rest());
  });
  await wrong('a lost GPU', /was lost, and opened again/, async () => {
    await page.evaluate(() => globalThis.asperity.gpu.destroy());
    await page.waitForFunction(() => document.getElementById('state').textContent.includes('opened again'), null, { timeout: 20000 });
    await page.evaluate(() => globalThis.asperity.rest());
  });
  tell(`${api}: invalid input logs nothing to the console`, said.every(line => /lost|Destroyed|destroyed/i.test(line)), said.join(' | '));
  await page.context().close();
  if (api === 'webgpu') await copies(browser, address, tell);
  await browser.close();
}
for (const [name, [a, b]] of Object.entries(drawn)) {
  const share = differing(a, b, 1);
  tell(`both: ${name} has the same pixels`, share <= 1e-3, `${(100 * share).toFixed(3)} % differ by more than 1 of 255`);
}

{
  const browser = await launch('webgl2');
  const axe = readFileSync(new URL('./node_modules/axe-core/axe.min.js', import.meta.url), 'utf8');
  for (const scene of SCENES) {
    for (const colorScheme of ['light', 'dark']) {
      const { page } = await open(browser, address('webgl2', 96, `#${scene}`), { colorScheme });
      await page.evaluate(axe);
      const found = await page.evaluate(async () => (await globalThis.axe.run()).violations.map(v => [v.impact, v.id, v.nodes.map(n => n.target.join(' ')).join(', ')]));
      tell(`axe: ${scene}, ${colorScheme}`, found.length === 0, found.map(v => v.join(' ')).join(' | '));
      await page.context().close();
    }
    // Keyboard only: Tab reaches every control with a visible focus.
    const { page } = await open(browser, address('webgl2', 64, `#${scene}`));
    const all = await page.evaluate(() => [...document.querySelectorAll('a[href], button, input, select, [tabindex]')]
      .filter(e => e.offsetParent !== null && !e.closest('dialog')).map(e => e.id || e.textContent || e.tagName));
    const reached = new Set();
    for (let k = 0; k < all.length + 3; k++) {
      await page.keyboard.press('Tab');
      const at = await page.evaluate(() => {
        const e = document.activeElement;
        return e === document.body ? null : [e.id || e.textContent || e.tagName, getComputedStyle(e).outlineStyle !== 'none' || e.type === 'file'];
      });
      if (at?.[1]) reached.add(at[0]);
    }
    const missed = all.filter(name => !reached.has(name));
    tell(`keys: Tab reaches all ${all.length} controls of ${scene}`, missed.length === 0, missed.join(', '));
    await page.context().close();
    // A phone in portrait orientation: nothing is wider than the screen.
    const phone = await open(browser, address('webgl2', 64, `#${scene}`), { viewport: { width: 360, height: 740 }, hasTouch: true, isMobile: true });
    const wide = await phone.page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    tell(`phone: ${scene} is no wider than the screen`, wide <= 0, `${wide} px`);
    await phone.page.screenshot({ path: join(out, `${scene}-phone.png`), fullPage: true });
    await phone.page.context().close();
  }
  {
    const { page } = await open(browser, address('webgl2', 64, '#bumps'));
    await page.focus('#view');
    const at = await page.evaluate(() => JSON.stringify(globalThis.asperity.settings));
    for (const key of ['ArrowLeft', 'ArrowDown', '+', 'Shift+ArrowRight']) await page.keyboard.press(key);
    await page.evaluate(() => globalThis.asperity.rest());
    const turned = await page.evaluate(() => globalThis.asperity.settings);
    const begun = JSON.parse(at);
    tell('keys: the picture turns, comes nearer and moves', turned.turn !== begun.turn && turned.height !== begun.height && turned.zoom > 0 && turned.at !== '');
    await page.focus('#painting');
    const painted = await page.evaluate(() => globalThis.asperity.settings.painting);
    for (const key of ['ArrowUp', 'ArrowUp', 'ArrowUp', 'Space']) await page.keyboard.press(key);
    tell('keys: a density is painted', painted !== await page.evaluate(() => globalThis.asperity.settings.painting));
    await page.context().close();
  }
  await nonsense(browser, 'webgl2', address, tell, async page => deviation(await pixelsOf(page)));
  await drops(browser, 'webgl2', address, tell);
  await smooth(browser, file, tell);
  await noises(browser, 'webgl2', address, tell);
  await seams(browser, 'webgl2', address, tell);
  await strip(browser, 'webgl2', address, tell);
  await pinches(browser, address, tell);
  await rests(browser, address, tell);
  await browser.close();
}

{
  // A browser without graphics: a static image with a message, and the scenes that need no GPU.
  const browser = await launch('neither');
  const { page, said } = await open(browser, `${file}?size=64#bumps`);
  const image = page.locator('.missing img');
  const whole = await image.isVisible() && await image.evaluate(async image => { await image.decode(); return image.naturalWidth > 0 && image.alt !== ''; });
  tell('neither: a picture stands in for what cannot be drawn', whole && !await page.locator('#view').isVisible());
  const sentence = await page.locator('.missing figcaption').innerText();
  tell('neither: a sentence says why', /neither WebGPU nor WebGL 2/.test(sentence), sentence);
  await page.screenshot({ path: join(out, 'bumps-neither.png') });
  for (const scene of SCENES) {
    await page.click(`#scenes [data-scene=${scene}]`);
    await page.waitForFunction(scene => globalThis.asperity.scene.id === scene, scene);
    await page.evaluate(() => globalThis.asperity.rest());
    const stands = await image.isVisible();
    tell(`neither: ${scene} ${scene === 'fractals' ? 'moves' : 'stands still'}`, stands === (scene !== 'fractals') && await state(page) !== '' === !stands, await state(page));
    if (stands) continue;
    const spread = deviation(await pixelsOf(page));
    tell(`neither: ${scene} is a picture`, spread > 5, `deviation ${spread.toFixed(1)} of 255`);
  }
  // Chromium itself reports that it has no adapter.
  tell('neither: nothing on the console', said.every(line => /No available adapters/.test(line)), said.join(' | '));
  await browser.close();
}

writeFileSync(join(out, 'program.txt'), `${program}\n`);
console.log(failed ? `${failed} checks failed` : 'all checks passed');
process.exit(failed ? 1 : 0);
