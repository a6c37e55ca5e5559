// Shaders and the WebAssembly module: embedded in the single-file page, or next to it.

/** The builder's output: shader sources, the teapot, the WebAssembly module. */
export async function loadData() {
  const { asperityParts: parts } = globalThis;
  if (parts) return parts;
  const [data, wasm] = await Promise.all([fetch('data.json'), fetch('tables.wasm')]);
  return { ...await data.json(), wasm: new Uint8Array(await wasm.arrayBuffer()) };
}
