// Files dropped on the page: supported files, and errors for others.

import { open } from './launch.mjs';

/**
 * Drops a file on the page: text, Base64 bytes, or an image computed by a function given as text.
 */
const dropped = async ({ name, type = '', text, base64, painted, size }) => {
  let data = text ?? (base64 && Uint8Array.from(atob(base64), c => c.charCodeAt(0)));
  if (painted) {
    const canvas = new OffscreenCanvas(32, 32), context = canvas.getContext('2d'), image = context.createImageData(32, 32), colour = new Function('x', 'y', `return ${painted}`);
    for (let k = 0; k < 1024; k++) image.data.set([...colour(k % 32 / 31, Math.floor(k / 32) / 31), 255], 4 * k);
    context.putImageData(image, 0, 0);
    data = await canvas.convertToBlob();
  }
  const file = new File([data], name, { type }), transfer = new DataTransfer();
  if (size) Object.defineProperty(File.prototype, 'size', { value: size, configurable: true });
  transfer.items.add(file);
  document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
  await new Promise(resolve => setTimeout(resolve, 400));
  await globalThis.asperity.rest();
  return { state: document.getElementById('state').textContent, settings: { ...globalThis.asperity.settings } };
};

const OBJ = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n';

/** A tetrahedron as binary glTF. */
function glb() {
  const binary = Buffer.alloc(60);
  [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1].forEach((x, k) => binary.writeFloatLE(x, 4 * k));
  [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3].forEach((k, at) => binary.writeUInt8(k, 48 + at));
  const described = JSON.stringify({
    asset: { version: '2.0' }, scenes: [{ nodes: [0] }], nodes: [{ mesh: 0, scale: [1, 2, 1] }], meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 4, type: 'VEC3' }, { bufferView: 1, componentType: 5121, count: 12, type: 'SCALAR' }],
    bufferViews: [{ buffer: 0, byteOffset: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 12 }], buffers: [{ byteLength: 60 }],
  });
  const json = Buffer.from(described.padEnd(Math.ceil(described.length / 4) * 4)), words = (...all) => Buffer.from(Uint32Array.from(all).buffer);
  return Buffer.concat([words(0x46546c67, 2, 28 + json.length + 60, json.length, 0x4e4f534a), json, words(60, 0x004e4942), binary]).toString('base64');
}

/** Meshes, images and other files, dropped on each scene. */
export async function drops(browser, api, address, tell) {
  const on = async (scene, cases) => {
    const { page, said } = await open(browser, address(api, 64, `#${scene}`));
    const begun = await page.evaluate(() => ({ ...globalThis.asperity.settings }));
    for (const [name, file, passes] of cases) {
      const told = await page.evaluate(dropped, file);
      tell(`${api}: ${name} dropped on ${scene}`, passes(told, begun) && told.state.split('\n').length === 1, told.state);
    }
    tell(`${api}: what is dropped on ${scene} says nothing on the console`, said.length === 0, said.join(' | '));
    await page.context().close();
  };
  const drawn = ({ state, settings }) => settings.shape === 'own' && /4 triangles/.test(state);
  const painted = ({ settings }, begun) => settings.density === 'painted' && settings.painting !== begun.painting;
  await on('bumps', [
    ['an OBJ', { name: 'a.obj', text: OBJ }, drawn],
    ['a GLB', { name: 'a.glb', base64: glb() }, drawn],
    ['a GLB cut off', { name: 'b.glb', base64: glb().slice(0, 400) }, ({ state }) => /b\.glb (is truncated|is not|contains|has )/.test(state)],
    ['a text', { name: 'a.txt', text: 'Hello' }, ({ state }) => /is not an OBJ, GLB or image file/.test(state)],
    ['a picture', { name: 'a.png', type: 'image/png', painted: '[200 * x, 200 * x, 200 * x]' }, painted],
    ['a normal map', { name: 'n.png', type: 'image/png', painted: '[128 + 60 * Math.sin(20 * x), 128 + 30 * Math.cos(20 * y), 250]' }, painted],
    ['a mesh of 300 MB', { name: 'c.obj', text: OBJ, size: 3e8 }, ({ state }) => /c\.obj has 300 MB \(at most 200\)/.test(state)],
  ]);
  await on('materials', [
    ['a picture of light', { name: 'light.png', type: 'image/png', painted: '[255 * y, 40, 255 * x]' }, ({ state, settings }) => settings.light === 'own' && !/no image yet/.test(state)],
    ['a text', { name: 'a.hdr', text: 'Hello' }, ({ state }) => /is not a Radiance image/.test(state)],
  ]);
  for (const scene of ['noise', 'fractals']) await on(scene, [['a text', { name: 'a.txt', text: 'Hello' }, ({ state }) => /a\.txt: this scene does not accept files/.test(state)]]);
}
