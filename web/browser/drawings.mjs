// Compares drawings of the gallery alone and in its pages, in light and dark themes:
// `node drawings.mjs FOLDER`, where FOLDER contains the pages and the SVG files. Each is displayed
// at its natural size, so that pixels correspond and must be equal. Prints a line per difference,
// and a summary.

import { readdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch, program } from './launch.mjs';

const folder = resolve(process.argv[2]);
if (!program) {
  console.log('skipped: no Chromium is installed');
  process.exit(0);
}
const address = file => pathToFileURL(join(folder, file)).href;
const files = readdirSync(folder);
const [pages, drawings] = ['.html', '.svg'].map(ending => files.filter(file => file.endsWith(ending)).sort());

/** Returns the maximum channel difference, and the fraction of differing pixels. */
const difference = (page, pictures) => page.evaluate(async pictures => {
  const [a, b] = await Promise.all(pictures.map(async picture => {
    const bitmap = await createImageBitmap(await (await fetch(`data:image/png;base64,${picture}`)).blob());
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    return context.getImageData(0, 0, bitmap.width, bitmap.height).data;
  }));
  if (a.length !== b.length) return [255, 1];
  let most = 0, differing = 0;
  for (let i = 0; i < a.length; i += 4) {
    const here = Math.max(...[0, 1, 2, 3].map(k => Math.abs(a[i + k] - b[i + k])));
    most = Math.max(most, here);
    differing += here > 0;
  }
  return [most, 4 * differing / a.length];
}, pictures.map(picture => picture.toString('base64')));

const browser = await launch('neither'), seen = {}, failures = [];
for (const colorScheme of ['light', 'dark']) {
  const context = await browser.newContext({ colorScheme, viewport: { width: 1280, height: 900 } });
  const [page, alone, judge] = await Promise.all([1, 2, 3].map(() => context.newPage()));
  for (const file of pages) {
    await page.goto(address(file));
    const shown = await page.$$eval('a[href$=".svg"] > svg', all => all.map(svg => ({
      name: svg.parentElement.getAttribute('href'), width: svg.width.baseVal.value, height: svg.height.baseVal.value,
    })));
    for (const { name, width, height } of shown) {
      const size = { width: Math.ceil(width), height: Math.ceil(height) };
      await Promise.all([page, alone].map(page => page.setViewportSize(size)));
      // At the window corner as when alone, above everything else, without the page's frame.
      const svg = await page.$(`a[href="${name}"] > svg`);
      await svg.evaluate((svg, { width, height }) => svg.setAttribute('style',
        `${svg.getAttribute('style')}; position: fixed; inset: 0 auto auto 0; z-index: 9; border: 0; border-radius: 0; width: ${width}px; height: ${height}px`),
      { width, height });
      const there = await page.screenshot();
      await svg.evaluate(svg => { svg.style.display = 'none'; });
      await alone.goto(address(name));
      const here = await alone.screenshot();
      const [most, share] = await difference(judge, [there, here]);
      if (most > 0) failures.push(`FAILED ${name}, ${colorScheme}: ${(100 * share).toFixed(2)} % of pixels differ, by up to ${most} of 255`);
      (seen[name] ??= []).push(here);
    }
  }
  await context.close();
}
const context = await browser.newContext(), judge = await context.newPage();
for (const name of drawings) {
  const shown = seen[name] ?? [];
  if (shown.length !== 2) failures.push(`FAILED ${name}: in no page, or in several`);
  else if ((await difference(judge, shown))[1] < 0.5) failures.push(`FAILED ${name}: as bright in the dark as in the light`);
}
await browser.close();
failures.forEach(line => console.log(line));
if (drawings.length === 0) failures.push('');
console.log(`${drawings.length} drawings of ${pages.length} pages alone and in the page, light and dark: ${failures.length ? 'some are not' : 'all are'} the same pixels`);
process.exit(failures.length ? 1 : 0);
