// Headless Chromium with WebGPU and WebGL 2 in software, and the output of pages.

import { existsSync } from 'node:fs';
import { chromium } from 'playwright-core';

/**
 * Software drivers. For a WebGPU canvas all of Chromium must render with Vulkan, where WebGL finds
 * no driver.
 */
const SOFTWARE = {
  webgpu: [
    '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader', '--use-vulkan=swiftshader', '--enable-features=Vulkan',
    '--use-angle=vulkan', '--enable-unsafe-swiftshader', '--disable-gpu-watchdog', '--disable-gpu-process-crash-limit',
  ],
  webgl2: ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-watchdog', '--disable-gpu-process-crash-limit'],
  neither: ['--disable-gpu', '--disable-3d-apis'],
};
const QUIET = ['--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync', '--disable-quic'];

/** The browser's executable: the variable CHROMIUM, or Debian's path. */
export const program = [process.env.CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']
  .find(path => path && existsSync(path));

/** Launches a browser with one of the two interfaces, or with neither. */
export async function launch(api) {
  return chromium.launch({ executablePath: program, args: ['--no-sandbox', ...QUIET, ...SOFTWARE[api]] });
}

/**
 * Opens a page and waits for its first image; `said` collects console messages, errors and
 * requests.
 */
export async function open(browser, url, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage();
  const said = [];
  page.on('console', message => said.push(`console ${message.type()}: ${message.text()}`));
  page.on('pageerror', error => said.push(`error: ${error.message}`));
  page.on('request', request => { if (!request.url().startsWith('data:') && !request.url().startsWith('blob:')) said.requests.push(request.url()); });
  said.requests = [];
  await page.goto(url, { timeout: 120000 });
  await page.waitForFunction(() => globalThis.asperity || document.getElementById('state').textContent.includes('could not start'), null, { timeout: 120000 });
  await page.evaluate(() => globalThis.asperity?.rest());
  return { page, said };
}
