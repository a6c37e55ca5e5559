// Shaders and the module: handed over by the page itself where it is one file, or beside it.

/** What the builder wrote: sources of shaders, the teapot, the module of tables. */
export async function loadData() {
  const { asperityParts: parts } = globalThis;
  if (parts) return parts;
  const [data, wasm] = await Promise.all([fetch('data.json'), fetch('tables.wasm')]);
  return { ...await data.json(), wasm: new Uint8Array(await wasm.arrayBuffer()) };
}
