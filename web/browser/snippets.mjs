// Collects the Rust code of the page, for every scene with many settings, as modules of one
// program: `node snippets.mjs FOLDER FILE`, where FOLDER contains the page's index.html. The
// program runs all of them and lists failures.

import { writeFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch, open, program } from './launch.mjs';

const [folder, file] = process.argv.slice(2);
if (!program) {
  console.log('skipped: no Chromium is installed');
  process.exit(0);
}

/**
 * Returns the code of the current scene: for all pairs of choices, and for ranges at their ends
 * with each choice.
 */
async function snippets() {
  const page = globalThis.asperity, { scene } = page, texts = new Map();
  const give = (values, name = JSON.stringify(values)) => {
    const text = page.instance.rustCode({ ...page.settings, ...values });
    if (!texts.has(text)) texts.set(text, name);
  };
  const values = ({ kind, options, value }) => kind === 'choice' ? options.map(([option]) => option).filter(Boolean) : kind === 'check' ? [!value] : [];
  const chosen = scene.controls.filter(control => control.name).map(control =>
    values(control).map(value => ({ [control.name]: value, ...control.also?.(value) })));
  const ends = end => Object.fromEntries(scene.controls.filter(({ kind }) => kind === 'range').map(control => [control.name, control[end]]));
  give({});
  for (const [k, some] of chosen.entries()) {
    for (const one of some) {
      for (const other of [{}, ends('min'), ends('max'), ...chosen.slice(0, k).flat()]) give({ ...other, ...one });
    }
  }
  for (const { value } of document.querySelectorAll('#fractals-start option')) {
    const start = document.getElementById('fractals-start');
    start.value = value;
    start.dispatchEvent(new Event('change'));
    await page.rest();
    give({}, value);
  }
  return [...texts];
}

const browser = await launch('webgl2'), modules = [], calls = [], counts = [];
for (const scene of ['bumps', 'noise', 'fractals', 'materials']) {
  const { page } = await open(browser, `${pathToFileURL(resolve(folder, 'index.html')).href}?api=webgl2&size=64&strip=64#${scene}`);
  const texts = await page.evaluate(snippets);
  for (const [k, [text, settings]] of texts.entries()) {
    const name = `${scene}_${k}`;
    modules.push(`mod ${name} {\n${text}\n    pub fn run() -> Result<(), Box<dyn std::error::Error>> {\n        main()\n    }\n}\n`);
    calls.push(`    (${JSON.stringify(`${scene} ${settings}`)}, ${name}::run),\n`);
  }
  counts.push(`${texts.length} of ${scene}`);
  await page.context().close();
}
await browser.close();
const snippet = 'fn() -> Result<(), Box<dyn std::error::Error>>';
writeFileSync(file, `${modules.join('')}\nconst SNIPPETS: &[(&str, ${snippet})] = &[\n${calls.join('')}];\n`);
console.log(`programs that the page gives: ${counts.join(', ')}`);
process.exit(0);
