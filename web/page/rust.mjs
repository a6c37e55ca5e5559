// The crates as a module: queries of numbers and words, answered in words.

/**
 * The module's queries as functions: `rust.painted_map(numbers, words)` returns a Uint32Array, or
 * throws the crate's error.
 */
export async function loadRust(bytes) {
  const { instance: { exports } } = await WebAssembly.instantiate(bytes, {});
  const sentence = () =>
    new TextDecoder().decode(new Uint8Array(exports.memory.buffer, exports.sentence(), exports.sentence_length()));
  const ask = (number, numbers, words) => {
    const at = exports.numbers(numbers.length);
    new Float64Array(exports.memory.buffer, at, numbers.length).set(numbers);
    const bulkAt = exports.bulk(words.length);
    new Uint32Array(exports.memory.buffer, bulkAt, words.length).set(bits(words));
    if (exports.ask(number)) throw new Error(sentence());
    return new Uint32Array(exports.memory.buffer, exports.answer(), exports.answer_length()).slice();
  };
  const rust = { bytes: () => exports.memory.buffer.byteLength };
  for (let number = 0; exports.question(number); number++) {
    rust[sentence()] = (numbers = [], words = []) => ask(number, numbers, words);
  }
  return rust;
}

/** Returns the bits of 32-bit floats as integers. */
export function bits(array) {
  return array instanceof Float32Array ? new Uint32Array(array.buffer, array.byteOffset, array.length) : array;
}

/** Returns words as 32-bit floats. */
export function floats(words) {
  return new Float32Array(words.buffer, words.byteOffset, words.length);
}
