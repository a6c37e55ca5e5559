// Objects for materials: a car, a room, a cup; lengths in meters, z up.

import { Mesh, grid } from './mesh.mjs';
import { add, cross, direction, dot, length, scale, subtract } from './vector.mjs';

const rise = (low, high, x) => {
  const t = Math.min(Math.max((x - low) / (high - low), 0), 1);
  return t * t * t * (t * (6 * t - 15) + 10);
};

const LENGTH = 2.15;
const BELT = 0.86;

/** Returns a point of the car's body, at positions along it and around it from 0 to 1. */
function body(along, around) {
  const x = LENGTH * Math.sin(Math.PI * (along - 0.5)), a = 2 * Math.PI * around, [sin, cos] = [Math.sin(a), Math.cos(a)];
  const closing = Math.max(1 - (Math.abs(x) / LENGTH) ** 6, 0) ** (1 / 4.4);
  const round = (s, power) => Math.sign(s) * Math.abs(s) ** power;
  const cabin = rise(1.15, 0.1, x) * rise(-2, -0.8, x);
  const upper = 0.72 + 0.15 * rise(2.3, 0.6, x) + 0.06 * rise(-0.9, -1.8, x) + 0.54 * cabin;
  const lower = 0.24 + 0.05 * rise(1.2, 2.1, x) + 0.07 * rise(-1.3, -2.1, x);
  const middle = 0.5 * (BELT - 0.3) + 0.26;
  const z = middle + closing * (sin >= 0 ? (upper - middle) * round(sin, 0.62) : (middle - lower) * round(sin, 0.42));
  const lean = 1 - 0.34 * rise(BELT - 0.14, 1.38, z) - 0.05 * rise(0.55, 0.2, z);
  const breadth = 0.84 - 0.09 * rise(0.8, 2.2, x) - 0.05 * rise(-0.9, -2.2, x);
  return [x, Math.sqrt(closing) * breadth * lean * round(cos, 0.5), z];
}

/**
 * The body of a car, front at +x; texture coordinates are meters along it and approximate meters
 * around it.
 */
export function carBody() {
  const step = 1.5e-3;
  return new Mesh(grid(180, 110, (along, around) => {
    const p = body(along, around);
    const forward = subtract(body(Math.min(along + step, 1), around), body(Math.max(along - step, 0), around));
    const upward = subtract(body(along, around + step), body(along, around - step));
    let n = direction(cross(upward, forward));
    if (!length(n)) n = [Math.sign(p[0]), 0, 0];
    const t = direction(forward);
    return { p, n, t: length(t) ? t : [0, 1, 0], uv: [p[0], 3.6 * around] };
  }), 'car');
}

/**
 * A surface of revolution about the z axis from radii and heights, outside to the right of the
 * profile.
 */
function turnedProfile(points, steps, place = p => p, palette = 0) {
  const corner = (u, v) => {
    const k = Math.min(Math.floor(u * (points.length - 1)), points.length - 2), part = u * (points.length - 1) - k;
    const [a, b] = [points[k], points[k + 1]], r = a[0] + (b[0] - a[0]) * part, z = a[1] + (b[1] - a[1]) * part, turn = -2 * Math.PI * v;
    const [cos, sin] = [Math.cos(turn), Math.sin(turn)], out = direction([b[1] - a[1], a[0] - b[0], 0]);
    return { p: place([r * cos, r * sin, z]), n: place([out[0] * cos, out[0] * sin, out[1]], true), t: place([-sin, cos, 0], true), uv: [palette, 0] };
  };
  return grid(points.length - 1, steps, corner);
}

/** The wheels of the car, in the palette's rubber and metal. */
export function wheels() {
  const corners = [];
  for (const [x, z] of [[-1.28, 0.325], [1.32, 0.325]]) {
    for (const side of [-1, 1]) {
      const place = ([a, b, c], turns) => add([a, side * c, b], turns ? [0, 0, 0] : [x, side * 0.66, z]);
      const tyre = [[0.21, -0.1], [0.3, -0.105], [0.325, -0.06], [0.325, 0.06], [0.3, 0.105], [0.21, 0.09]];
      const disc = [[0.215, 0.08], [0.19, 0.075], [0.15, 0.045], [0.08, 0.055], [0.03, 0.07], [0, 0.07]];
      corners.push(...turnedProfile(tyre, 48, place, 1), ...turnedProfile(disc, 48, place, 2));
    }
  }
  return new Mesh(corners, 'wheels');
}

/**
 * A flat piece from a corner and two sides, with texture coordinates in meters, or in a palette
 * color.
 */
function flat(from, along, up, palette) {
  const [w, h] = [length(along), length(up)], n = direction(cross(along, up)), t = direction(along);
  return grid(1, 1, (u, v) => ({
    p: add(from, add(scale(along, u), scale(up, v))), n, t, uv: palette === undefined ? [w * u, h * v] : [palette, 0],
  }));
}

/** Flat pieces whose texture coordinates are also relative to a focus. */
class Room extends Mesh {
  from(focus) {
    return new Mesh(this.corners.map(({ p, n, t, uv }) => {
      const way = subtract(focus, p);
      return { p, n, t, uv: [uv[0] + dot(way, t), uv[1] + dot(way, cross(n, t))] };
    }), 'room').from(focus);
  }
}

/**
 * A room of four by four meters: the floor and a block on it, and the walls; each of the material,
 * or painted.
 */
export function room(of) {
  const [floor, walls] = [of === 'walls' ? 4 : undefined, of === 'floor' ? 3 : undefined];
  const pieces = { floor: [], walls: [] };
  pieces.floor.push(...flat([-2, -2, 0], [4, 0, 0], [0, 4, 0], floor));
  const [a, b, h] = [[0.2, 0.4], [1.2, 1.4], 0.5], box = [[a[0], a[1]], [b[0], a[1]], [b[0], b[1]], [a[0], b[1]]];
  box.forEach((p, k) => {
    const q = box[(k + 1) % 4];
    pieces.floor.push(...flat([...p, 0], [q[0] - p[0], q[1] - p[1], 0], [0, 0, h], floor));
  });
  pieces.floor.push(...flat([a[0], a[1], h], [1, 0, 0], [0, 1, 0], floor));
  for (const [p, along] of [[[2, -2, 0], [0, 4, 0]], [[-2, 2, 0], [0, -4, 0]], [[2, 2, 0], [-4, 0, 0]], [[-2, -2, 0], [4, 0, 0]]]) {
    // Inward is to the left of the path around.
    const end = add(p, along);
    pieces.walls.push(...flat(end, scale(along, -1), [0, 0, 2.5], walls));
  }
  const own = [...(floor === undefined ? pieces.floor : []), ...(walls === undefined ? pieces.walls : [])];
  const other = [...(floor === undefined ? [] : pieces.floor), ...(walls === undefined ? [] : pieces.walls)];
  // Rays pass through walls from behind, like views.
  const all = Object.assign(new Mesh([...own, ...other], 'room'), { oneSided: true });
  return { own: new Room(own, 'room'), other: new Mesh(other, 'other'), all };
}

/** A cup on its saucer, in the palette's china, 9 cm high. */
export function cup() {
  const outside = [[0, 0.008], [0.026, 0.008], [0.028, 0.014], [0.036, 0.04], [0.041, 0.08], [0.043, 0.09], [0.041, 0.09], [0.038, 0.074]];
  const plate = [[0, 0.004], [0.035, 0.0], [0.075, 0.012], [0.078, 0.014], [0.074, 0.014], [0.035, 0.006], [0, 0.006]];
  const tea = [[0.0395, 0.074], [0, 0.074]];
  const handle = grid(24, 12, (u, v) => {
    const [a, b] = [(0.5 - u) * 3.6, 2 * Math.PI * v], n = [Math.cos(a) * Math.cos(b), Math.sin(b), Math.sin(a) * Math.cos(b)];
    return { p: add([0.046 + 0.022 * Math.cos(a), 0, 0.052 + 0.024 * Math.sin(a)], scale(n, 0.0042)), n, t: [Math.sin(a), 0, -Math.cos(a)], uv: [5, 0] };
  });
  return new Mesh([...handle, ...turnedProfile(outside, 64, undefined, 5), ...turnedProfile(plate, 64, undefined, 5), ...turnedProfile(tea, 64, undefined, 6)], 'cup');
}

/** A square of ground about the origin, at height 0. */
export function ground(half) {
  return new Mesh(flat([-half, -half, 0], [2 * half, 0, 0], [0, 2 * half, 0], 0), 'ground');
}

/** A box around everything, seen from inside, in the palette's sky. */
export function sky(half) {
  const corners = [];
  for (let axis = 0; axis < 3; axis++) {
    for (const side of [-1, 1]) {
      const unit = k => [0, 1, 2].map(i => i === (axis + k) % 3 ? 1 : 0), from = scale(add(scale(unit(0), side), scale(add(unit(1), unit(2)), -1)), half);
      corners.push(...flat(from, scale(unit(side > 0 ? 2 : 1), 2 * half), scale(unit(side > 0 ? 1 : 2), 2 * half), 7));
    }
  }
  return new Mesh(corners, 'sky');
}
