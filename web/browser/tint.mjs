// Tests whether Chromium's compiler accepts WGSL: `node tint.mjs FOLDER` compiles every .wgsl file
// below the folder, except Bevy's modules, whose import lines are not WGSL.

import { readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch } from './launch.mjs';

const folder = process.argv[2];
const files = readdirSync(folder, { recursive: true }).filter(name => name.endsWith('.wgsl') && !name.endsWith('bevy.wgsl')).sort();
const browser = await launch('webgpu');
const page = await (await browser.newContext()).newPage();
// WebGPU is only available for files and secure origins.
await page.goto(pathToFileURL(join(import.meta.dirname, '../page/index.html')).href, { waitUntil: 'commit' });
const refused = [];
for (const name of files) {
  const said = await page.evaluate(async code => {
    globalThis.device ??= await (await navigator.gpu.requestAdapter()).requestDevice();
    const { messages } = await globalThis.device.createShaderModule({ code }).getCompilationInfo();
    return messages.map(({ type, lineNum, message }) => `${type} in line ${lineNum}: ${message}`);
  }, readFileSync(join(folder, name), 'utf8'));
  said.forEach(line => refused.push(`${name}: ${line}`));
}
await browser.close();
refused.forEach(line => console.log(line));
console.log(`Chromium's compiler read ${files.length} files, ${refused.length} complaints`);
process.exit(files.length && !refused.length ? 0 : 1);
