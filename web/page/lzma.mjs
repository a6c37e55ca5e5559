// Unpacks LZMA with a header that contains the length: Pavlov, LZMA specification, 2015.

/** Unpacks bytes. */
export function unpacked(from) {
  const header = new DataView(from.buffer, from.byteOffset), properties = from[0];
  const lc = properties % 9, literalMask = (1 << Math.floor(properties / 9) % 5) - 1, positionMask = (1 << Math.floor(properties / 45)) - 1;
  const to = new Uint8Array(header.getUint32(5, true)), probabilities = size => new Uint16Array(size).fill(1024);
  let at = 18, range = 2 ** 32 - 1, code = header.getUint32(14);

  const shift = () => {
    if (range < 2 ** 24) {
      range *= 256;
      code = code * 256 + from[at++];
    }
  };
  const bit = (model, k) => {
    const p = model[k], bound = (range >>> 11) * p, one = code >= bound;
    if (one) {
      range -= bound;
      code -= bound;
      model[k] = p - (p >> 5);
    } else {
      range = bound;
      model[k] = p + (2048 - p >> 5);
    }
    shift();
    return +one;
  };
  const even = count => {
    let value = 0;
    while (count--) {
      range = range >>> 1;
      const one = code >= range;
      if (one) code -= range;
      shift();
      value = 2 * value + one;
    }
    return value;
  };
  const tree = (model, start, bits) => {
    let m = 1;
    for (let k = 0; k < bits; k++) m = m << 1 | bit(model, start + m);
    return m - (1 << bits);
  };
  const reversed = (model, start, bits) => {
    let [m, value] = [1, 0];
    for (let k = 0; k < bits; k++) {
      const b = bit(model, start + m);
      m = m << 1 | b;
      value |= b << k;
    }
    return value;
  };
  const lengths = () => {
    const choice = probabilities(2), near = probabilities(128), middle = probabilities(128), far = probabilities(256);
    return place => !bit(choice, 0) ? tree(near, 8 * place, 3) : !bit(choice, 1) ? 8 + tree(middle, 8 * place, 3) : 16 + tree(far, 0, 8);
  };

  const literals = probabilities(0x300 * (literalMask + 1 << lc)), isMatch = probabilities(192), isRepeated = probabilities(12);
  const repeats = [0, 1, 2].map(() => probabilities(12)), isLong = probabilities(192), slots = probabilities(256), distances = probabilities(128), aligned = probabilities(16);
  const matched = lengths(), again = lengths(), last = [0, 0, 0, 0];
  let [state, done] = [0, 0];
  while (done < to.length) {
    const place = done & positionMask;
    if (!bit(isMatch, state << 4 | place)) {
      const start = 0x300 * (((done & literalMask) << lc) + ((done ? to[done - 1] : 0) >> 8 - lc));
      let symbol = 1;
      for (let other = state > 6 ? to[done - last[0] - 1] | 0x100 : 0; symbol < 0x100;) {
        const expected = other ? other >> 7 & 1 : 0, b = bit(literals, start + (other ? 1 + expected << 8 : 0) + symbol);
        symbol = symbol << 1 | b;
        other = other && expected === b ? (other << 1 & 0xff | 0x100) : 0;
      }
      to[done++] = symbol;
      state = state < 4 ? 0 : state < 10 ? state - 3 : state - 6;
      continue;
    }
    let length;
    if (!bit(isRepeated, state)) {
      length = matched(place);
      const slot = tree(slots, Math.min(length, 3) << 6, 6), bits = (slot >> 1) - 1;
      let distance = slot;
      if (slot > 3) {
        distance = (2 | slot & 1) * 2 ** bits;
        distance += slot < 14 ? reversed(distances, distance - slot, bits) : 16 * even(bits - 4) + reversed(aligned, 0, 4);
      }
      last.unshift(distance);
      last.pop();
      state = state < 7 ? 7 : 10;
    } else {
      let which = 0;
      if (!bit(repeats[0], state)) {
        if (!bit(isLong, state << 4 | place)) {
          to[done] = to[done - last[0] - 1];
          done++;
          state = state < 7 ? 9 : 11;
          continue;
        }
      } else which = !bit(repeats[1], state) ? 1 : 2 + bit(repeats[2], state);
      last.unshift(...last.splice(which, 1));
      length = again(place);
      state = state < 7 ? 8 : 11;
    }
    for (const end = Math.min(done + length + 2, to.length); done < end; done++) to[done] = to[done - last[0] - 1];
  }
  return to;
}

// The single-file page: unpacks its parts, and starts its scripts.
const inside = id => unpacked(Uint8Array.from(atob(document.getElementById(id).textContent), c => c.charCodeAt(0)));
const [scripts, described, glsl, sources] = new TextDecoder().decode(inside('asperity-texts')).split('\x01');
const data = JSON.parse(described), parts = sources.split('\x02');
data.glsl = glsl.split('\x02');
data.parts = Object.fromEntries(data.parts.map((name, k) => [name, parts[k]]));
const tables = inside('asperity-tables'), words = new DataView(tables.buffer, data.levels ?? 0);
// Levels are packed as second differences, without the negative half.
for (let k = 0, level = 0, slope = 0; data.levels && k < 2048; k++) {
  slope = slope + words.getInt32(8192 + 4 * k, true) | 0;
  level = level + slope | 0;
  words.setInt32(8192 + 4 * k, level, true);
  words.setInt32(8188 - 4 * k, level ^ 1 << 31, true);
}
globalThis.asperityParts = { ...data, wasm: tables };
document.body.append(Object.assign(document.createElement('script'), { type: 'module', textContent: scripts }));
