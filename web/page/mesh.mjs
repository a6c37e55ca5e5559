// Triangles: the teapot, a sphere, planes, user files. Positions are in 64 bits until they are
// relative to a focus.

import { add, cross, direction, dot, length, scale, subtract } from './vector.mjs';

/** A mesh of positions, normals, tangents and texture coordinates, three vertices per triangle. */
export class Mesh {
  constructor(corners, name) {
    this.corners = corners;
    this.name = name;
  }

  get triangles() { return this.corners.length / 3; }

  /**
   * Returns vertex data for a shader, relative to the focus: position, plane, normal, tangent,
   * texture coordinates.
   */
  from(focus) {
    const data = new Float32Array(15 * this.corners.length);
    for (let i = 0; i < this.corners.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map(k => subtract(this.corners[i + k].p, focus));
      const n = direction(cross(subtract(b, a), subtract(c, a)));
      const plane = [...n, dot(n, a)];
      [a, b, c].forEach((p, k) => {
        const { n, t, uv } = this.corners[i + k];
        data.set([...p, ...plane, ...n, ...t, ...uv], 15 * (i + k));
      });
    }
    return data;
  }

  /** Returns the nearest hit of a ray, or nothing. */
  hit(eye, along) {
    let [nearest, found] = [Infinity, null];
    for (let i = 0; i < this.corners.length; i += 3) {
      const [a, b, c] = [this.corners[i].p, this.corners[i + 1].p, this.corners[i + 2].p];
      const [ab, ac] = [subtract(b, a), subtract(c, a)];
      const across = cross(along, ac), size = dot(ab, across);
      if (size === 0 || (this.oneSided && size < 0)) continue;
      const from = subtract(eye, a), u = dot(from, across) / size;
      if (!(u >= 0 && u <= 1)) continue;
      const other = cross(from, ab), v = dot(along, other) / size;
      if (!(v >= 0 && u + v <= 1)) continue;
      const t = dot(ac, other) / size;
      if (t > 0 && t < nearest) {
        nearest = t;
        found = i;
      }
    }
    return found === null ? null : { p: add(eye, scale(along, nearest)), distance: nearest, triangle: found / 3 };
  }
}

const bernstein = t => [(1 - t) * (1 - t) * (1 - t), 3 * (1 - t) * (1 - t) * t, 3 * (1 - t) * t * t, t * t * t];
const bernsteinSlope = t => {
  const s = 1 - t;
  return [-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t];
};
const rounded = v => v.map(Math.fround);

/**
 * Returns triangles of a grid of vertices, `columns` by `rows` cells, without degenerate triangles.
 */
export function grid(columns, rows, corner) {
  const all = [];
  for (let j = 0; j <= rows; j++) for (let i = 0; i <= columns; i++) all.push(corner(i / columns, j / rows));
  const corners = [];
  const triangle = (...of) => {
    const [a, b, c] = of.map(k => all[k]);
    if (length(cross(subtract(b.p, a.p), subtract(c.p, a.p))) > 0) corners.push(a, b, c);
  };
  for (let j = 0; j < rows; j++) {
    for (let i = 0; i < columns; i++) {
      const k = j * (columns + 1) + i, above = k + columns + 1;
      triangle(k, k + 1, above + 1);
      triangle(k, above + 1, above);
    }
  }
  return corners;
}

/** The Utah teapot from its patches, in the renderer's coordinates: z up, bottom at 0. */
export function teapot({ patches, vertices }) {
  const corners = patches.flatMap((patch, index) => {
    const widen = index >= 20 && index < 28 ? 14 / 13 : 1, tube = index >= 12 && index < 20;
    const control = patch.map(i => [vertices[i][0] * widen, vertices[i][1] * widen, vertices[i][2]]);
    const tensor = (u, v) => control.reduce((sum, c, k) => add(sum, scale(c, u[k % 4] * v[k >> 2])), [0, 0, 0]);
    const middle = bernstein(0.5), slope = bernsteinSlope(0.5), [wide, high] = [length(tensor(slope, middle)), length(tensor(middle, slope))];
    return grid(16, 17, (u, v) => {
      const [bu, bv, du, dv] = [bernstein(u), bernstein(v), bernsteinSlope(u), bernsteinSlope(v)];
      const p = tensor(bu, bv), across = tensor(bu, dv);
      let along = tensor(du, bv);
      if (length(along) < 1e-9) along = tensor(du, dv);
      const sense = Math.sign(dot([-p[1] - across[1], p[0] + across[0], 0], along)) || 1;
      const [t, uv] = tube ? [across, [v, u]] : [scale(along, sense), [u * sense, v]];
      // In units of length, with the second axis to the left of the first.
      const metric = tube ? [v * high, -u * wide] : [u * sense * wide, v * sense * high];
      return { p: rounded(p), n: rounded(direction(cross(along, across))), t: rounded(direction(t)), uv, metric };
    });
  });
  return new Mesh(corners, 'teapot');
}

/** A sphere of radius 1 about (0, 0, 1). */
export function sphere() {
  const corners = grid(96, 48, (u, v) => {
    const [a, b] = [2 * Math.PI * u, Math.PI * (v - 0.5)];
    const n = [Math.cos(a) * Math.cos(b), Math.sin(a) * Math.cos(b), Math.sin(b)];
    return { p: add(n, [0, 0, 1]), n, t: [-Math.sin(a), Math.cos(a), 0], uv: [6 * u, 3 * v] };
  });
  return new Mesh(corners, 'sphere');
}

/** A plane up to the horizon about a point, with lines at distances that double from `least`. */
export function plane([x, y], least) {
  const half = [];
  for (let d = least; d < 1e4; d *= 2) half.push(d);
  const lines = [...half.map(d => -d).reverse(), 0, ...half], last = lines.length - 1;
  const at = s => lines[Math.round(s * last)];
  const corners = grid(last, last, (u, v) => {
    const p = [x + at(u), y + at(v), 0];
    return { p, n: [0, 0, 1], t: [1, 0, 0], uv: [p[0] / 4, p[1] / 4] };
  });
  return new Mesh(corners, 'plane');
}

/**
 * Triangles of positions and vertex indices: area-weighted normals if missing, tangents around z,
 * scaled to 3 units.
 */
function fromTriangles(positions, indices, normals, uvs, name) {
  if (!indices.length) throw new Error(`${name} has no triangles.`);
  if (indices.length > 3e6) throw new Error(`${name} has ${indices.length / 3} triangles (at most 1,000,000).`);
  const bad = indices.find(i => !(i >= 0 && i < positions.length) || !positions[i].every(Number.isFinite));
  if (bad !== undefined) throw new Error(`${name} refers to a missing or invalid vertex.`);
  const low = [0, 1, 2].map(k => indices.reduce((m, i) => Math.min(m, positions[i][k]), Infinity));
  const high = [0, 1, 2].map(k => indices.reduce((m, i) => Math.max(m, positions[i][k]), -Infinity));
  const size = Math.max(...subtract(high, low));
  if (!(size > 0)) throw new Error(`${name} has zero size.`);
  const middle = scale(add(low, high), 0.5), place = p => add(scale(subtract(p, middle), 4 / size), [0, 0, 1.3]);
  const placed = positions.map(place);
  const n = normals ?? placed.map(() => [0, 0, 0]);
  if (!normals) {
    for (let i = 0; i < indices.length; i += 3) {
      const [a, b, c] = [0, 1, 2].map(k => indices[i + k]);
      const area = cross(subtract(placed[b], placed[a]), subtract(placed[c], placed[a]));
      for (const k of [a, b, c]) n[k] = add(n[k], area);
    }
  }
  const corners = indices.map(i => {
    const normal = direction(n[i]), around = cross([0, 0, 1], normal);
    const t = length(around) > 1e-4 ? direction(around) : [1, 0, 0];
    return { p: placed[i], n: normal, t, uv: uvs?.[i] ?? [placed[i][0] / 4, placed[i][1] / 4] };
  });
  return new Mesh(corners, name);
}

/** Reads a Wavefront OBJ file: polygons as fans, y up converted to z up. */
export function readObj(text, name) {
  const [positions, indices] = [[], []];
  for (const line of text.split(/\r?\n/)) {
    const [kind, ...words] = line.trim().split(/\s+/);
    if (kind === 'v') {
      const [x, y, z] = words.map(Number);
      positions.push([x, -z, y]);
    } else if (kind === 'f') {
      const of = words.map(word => parseInt(word, 10)).map(i => i < 0 ? positions.length + i : i - 1);
      for (let k = 2; k < of.length; k++) indices.push(of[0], of[k - 1], of[k]);
    }
  }
  if (!indices.length) throw new Error(`${name} is not an OBJ file with faces.`);
  return fromTriangles(positions, indices, null, null, name);
}

/** Reads a binary glTF file: the triangles of all its meshes, transformed by their nodes. */
export function readGlb(buffer, name) {
  const view = new DataView(buffer);
  if (view.byteLength < 20 || view.getUint32(0, true) !== 0x46546c67) throw new Error(`${name} is not a binary glTF file.`);
  const jsonLength = view.getUint32(12, true);
  if (20 + jsonLength > view.byteLength) throw new Error(`${name} is truncated.`);
  let gltf;
  try {
    gltf = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, jsonLength)));
  } catch {
    throw new Error(`${name} contains invalid JSON.`);
  }
  if (gltf.extensionsRequired?.length) throw new Error(`${name} requires unsupported extensions: ${gltf.extensionsRequired.join(', ')}.`);
  const binaryAt = 20 + jsonLength + 8;
  const sizes = { 5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4 }, widths = { SCALAR: 1, VEC2: 2, VEC3: 3 };
  const readers = { 5121: 'getUint8', 5123: 'getUint16', 5125: 'getUint32', 5126: 'getFloat32' };
  const accessor = index => {
    const a = gltf.accessors?.[index], b = gltf.bufferViews?.[a?.bufferView];
    if (!a || !b || b.buffer || !readers[a.componentType]) throw new Error(`${name} has an unsupported accessor.`);
    const width = widths[a.type], size = sizes[a.componentType], stride = b.byteStride ?? width * size;
    const start = binaryAt + (b.byteOffset ?? 0) + (a.byteOffset ?? 0);
    if (!(a.count >= 0) || start + stride * (a.count - 1) + width * size > view.byteLength) throw new Error(`${name} is truncated.`);
    return Array.from({ length: a.count }, (_, i) =>
      Array.from({ length: width }, (_, k) => view[readers[a.componentType]](start + i * stride + k * size, true)));
  };
  const [positions, indices] = [[], []];
  const matrixOf = node => {
    if (node.matrix) return node.matrix;
    const [x, y, z, w] = node.rotation ?? [0, 0, 0, 1], [sx, sy, sz] = node.scale ?? [1, 1, 1], [tx, ty, tz] = node.translation ?? [0, 0, 0];
    return [
      (1 - 2 * (y * y + z * z)) * sx, 2 * (x * y + z * w) * sx, 2 * (x * z - y * w) * sx, 0,
      2 * (x * y - z * w) * sy, (1 - 2 * (x * x + z * z)) * sy, 2 * (y * z + x * w) * sy, 0,
      2 * (x * z + y * w) * sz, 2 * (y * z - x * w) * sz, (1 - 2 * (x * x + y * y)) * sz, 0, tx, ty, tz, 1];
  };
  const times = (a, b) => Array.from({ length: 16 }, (_, i) => [0, 1, 2, 3].reduce((s, k) => s + a[k * 4 + i % 4] * b[(i >> 2) * 4 + k], 0));
  const visit = (index, parent, depth) => {
    const node = gltf.nodes?.[index];
    if (!node || depth > 64) throw new Error(`${name} has cyclic or missing nodes.`);
    const matrix = times(parent, matrixOf(node));
    for (const primitive of gltf.meshes?.[node.mesh]?.primitives ?? []) {
      if ((primitive.mode ?? 4) !== 4) continue;
      const first = positions.length;
      for (const [x, y, z] of accessor(primitive.attributes.POSITION)) {
        const p = [0, 1, 2].map(k => matrix[k] * x + matrix[4 + k] * y + matrix[8 + k] * z + matrix[12 + k]);
        positions.push([p[0], -p[2], p[1]]);
      }
      const own = primitive.indices === undefined ? Array.from({ length: positions.length - first }, (_, i) => [i]) : accessor(primitive.indices);
      for (const [i] of own) indices.push(first + i);
    }
    for (const child of node.children ?? []) visit(child, matrix, depth + 1);
  };
  const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  for (const node of gltf.scenes?.[gltf.scene ?? 0]?.nodes ?? []) visit(node, identity, 0);
  return fromTriangles(positions, indices.slice(0, indices.length - indices.length % 3), null, null, name);
}
