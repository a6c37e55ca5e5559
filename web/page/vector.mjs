// Vectors of three numbers, in 64 bits.

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = a => Math.hypot(a[0], a[1], a[2]);

/** Normalizes a vector; zero if it has no direction. */
export function direction(a) {
  const l = length(a);
  return l > 0 && l < Infinity ? scale(a, 1 / l) : [0, 0, 0];
}

/** Returns the direction of an azimuth from +x and an elevation, in degrees. */
export function towards(azimuth, height) {
  const [a, h] = [azimuth * Math.PI / 180, height * Math.PI / 180];
  return [Math.cos(a) * Math.cos(h), Math.sin(a) * Math.cos(h), Math.sin(h)];
}
