// Tests the live page in Firefox and WebKit, if installed: `node others.mjs FOLDER SCREENS`.
// Compares their images with Chromium's images that `check.mjs` left in SCREENS, and writes
// Firefox's images there for comparison with the crates. Uses WebGL 2 with a software driver on an
// Xvfb screen.

import { spawn } from 'node:child_process';
import { copyFileSync, existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { setTimeout as sleep } from 'node:timers/promises';
import { pathToFileURL } from 'node:url';

const [folder, screens] = process.argv.slice(2).map(path => resolve(path));
const file = pathToFileURL(join(folder, 'index.html')).href;
const found = paths => paths.find(existsSync);
const firefox = found(['/usr/bin/firefox', '/usr/bin/firefox-esr']);
const webkit = found(['/usr/bin/WebKitWebDriver']);
const miniBrowser = found(['4.1', '4.0', '6.0'].map(version => `/usr/lib/x86_64-linux-gnu/webkit2gtk-${version}/MiniBrowser`));

/** Returns the page's state and pixels as text, which any protocol supports. */
const ASKED = `
  const done = arguments[arguments.length - 1];
  const wait = () => {
    const page = globalThis.asperity, state = document.getElementById('state').textContent;
    if (!page && !state.includes('could not start')) return setTimeout(wait, 50);
    if (!page?.gpu) return done(JSON.stringify({ name: 'nothing: ' + state }));
    page.pixels().then(({ data }) => {
      let text = '';
      for (let i = 0; i < data.length; i += 8192) text += String.fromCharCode(...data.subarray(i, i + 8192));
      done(JSON.stringify({ name: page.gpu.name, data: btoa(text) }));
    }, error => done(JSON.stringify({ name: 'error: ' + error.message })));
  };
  wait();`;

/** Runs Firefox with WebDriver BiDi. */
async function inFirefox(links) {
  const { default: puppeteer } = await import('puppeteer-core');
  const extraPrefsFirefox = { 'webgl.force-enabled': true, 'security.sandbox.content.level': 0 };
  const browser = await puppeteer.launch({ browser: 'firefox', executablePath: firefox, headless: false, extraPrefsFirefox });
  const answers = [];
  for (const link of links) {
    const page = await browser.newPage();
    await page.goto(link);
    answers.push(JSON.parse(await page.evaluate(asked => new Promise(done => new Function(asked)(done)), ASKED)));
    await page.close();
  }
  await browser.close();
  return answers;
}

/** Runs WebKit with WebDriver. */
async function inWebKit(links) {
  const port = 4455, driver = spawn(webkit, [`--port=${port}`], { stdio: 'ignore' });
  const send = async (method, path, body) => {
    const answer = await fetch(`http://127.0.0.1:${port}${path}`, { method, body: body && JSON.stringify(body) });
    const { value } = await answer.json();
    if (value?.error) throw new Error(value.message || value.error);
    return value;
  };
  try {
    await sleep(500);
    const options = { binary: miniBrowser, args: ['--automation'] };
    const { sessionId } = await send('POST', '/session', { capabilities: { alwaysMatch: { 'webkitgtk:browserOptions': options } } });
    await send('POST', `/session/${sessionId}/timeouts`, { script: 120000 });
    const answers = [];
    for (const link of links) {
      await send('POST', `/session/${sessionId}/url`, { url: 'about:blank' });
      await send('POST', `/session/${sessionId}/url`, { url: link });
      answers.push(JSON.parse(await send('POST', `/session/${sessionId}/execute/async`, { script: ASKED, args: [] })));
    }
    await send('DELETE', `/session/${sessionId}`);
    return answers;
  } finally {
    driver.kill();
  }
}

process.env.LIBGL_ALWAYS_SOFTWARE = '1';
process.env.WEBKIT_DISABLE_SANDBOX_THIS_IS_DANGEROUS = '1';
let screen = null;
if (!process.env.DISPLAY) {
  if (!existsSync('/usr/bin/Xvfb')) {
    console.log('skipped: Firefox and WebKit draw on a screen, and there is neither one nor Xvfb (Debian’s xvfb)');
    process.exit(0);
  }
  process.env.DISPLAY = ':97';
  screen = spawn('/usr/bin/Xvfb', [':97', '-screen', '0', '1400x1000x24'], { stdio: 'ignore' });
  await sleep(1000);
}
const zooms = [0, 2, 4], links = zooms.map(zoom => `${file}?api=webgl2&size=256#bumps?zoom=${zoom}`);
let failed = false;
for (const [name, is, answer, packages] of [
  ['Firefox', firefox, inFirefox, 'firefox-esr'],
  ['WebKit', webkit && miniBrowser, inWebKit, 'webkit2gtk-driver'],
]) {
  if (!is) {
    console.log(`skipped: ${name} is not installed (Debian’s ${packages})`);
    continue;
  }
  try {
    const answers = await answer(links);
    answers.forEach(({ name: drawn, data }, k) => {
      if (!data) throw new Error(drawn);
      const picture = join(screens, `teapot-${10 ** zooms[k]}-`), theirs = Buffer.from(data, 'base64'), ours = readFileSync(`${picture}webgl2.rgba`);
      // WebKitGTK 2.50 sometimes loses a band of an image under load. This is reported, but is not
      // a failure.
      writeFileSync(`${picture}${name.toLowerCase()}.${name === 'WebKit' ? 'bin' : 'rgba'}`, theirs);
      if (name !== 'WebKit') copyFileSync(`${picture}webgl2.json`, `${picture}${name.toLowerCase()}.json`);
      let off = 0;
      for (let i = 0; i < ours.length; i += 4) off += [0, 1, 2].some(c => Math.abs(ours[i + c] - theirs[i + c]) > 2);
      const share = off / (ours.length / 4);
      failed ||= name !== 'WebKit' && theirs.length !== ours.length;
      console.log(`${name}, ${drawn}, × ${10 ** zooms[k]}: ${(100 * share).toFixed(3)} % of pixels differ from Chromium’s by more than 2 of 255`);
    });
  } catch (error) {
    failed ||= name !== 'WebKit';
    console.log(`${name}: ${String(error.message ?? error).split('\n')[0]}`);
  }
}
screen?.kill();
process.exit(failed ? 1 : 0);
