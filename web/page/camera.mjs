// A camera that looks at a point of a surface, from the whole object to ten thousandfold zoom.
// Positions are relative to this point.

import { add, cross, direction, scale, towards } from './vector.mjs';
import { plane } from './mesh.mjs';

/** Formats a zoom. */
export const times = zoom => `× ${zoom < 10 ? zoom.toFixed(1) : Math.round(zoom).toLocaleString('en')}`;

/**
 * Base class of scenes that look at a surface. A subject has a field of view in radians, a camera
 * distance and a target. Its view direction determines the point at the center of the whole object.
 * `made` is its mesh; a plane up to the horizon has none.
 */
export class Looking {
  constructor(page, subjects, deepest) {
    Object.assign(this, { page, subjects, deepest, shapes: new Map(), kept: new Map() });
  }

  close() {
    for (const { gpu, mesh } of this.kept.values()) if (gpu === this.page.gpu) mesh.free();
  }

  subject(settings) { return this.subjects[settings.shape]; }

  shape(settings) {
    const known = this.shapes.get(settings.shape);
    if (known) return known;
    const { made, otherwise } = this.subject(settings);
    if (!made) return this.shape({ ...settings, shape: otherwise });
    this.shapes.set(settings.shape, made());
    return this.shapes.get(settings.shape);
  }

  /**
   * The camera's target: the position in the link, or the point at the center of the whole object.
   */
  focus(settings) {
    if (settings.at) return settings.at.split(',').map(Number);
    if (settings.shape === 'plane') return [0.3, 0.7, 0];
    const away = this.away(settings), { target } = this.subject(settings);
    const mesh = this.shape(settings), key = [away, target];
    if (this.middle?.mesh !== mesh || String(this.middle.key) !== String(key)) {
      const hit = mesh.hit(add(target, scale(away, 20)), scale(away, -1));
      this.middle = { mesh, key, p: hit?.p ?? target };
    }
    return this.middle.p;
  }

  /** The direction from the focus to the camera. */
  away({ turn, height, shape }) {
    return towards(turn, shape === 'plane' ? Math.max(height, 2) : height);
  }

  /** The camera in shader layout, relative to the focus. */
  camera(settings) {
    const zoom = 10 ** settings.zoom, forward = scale(this.away(settings), -1), { field, distance } = this.subject(settings);
    const half = Math.tan(field / 2), right = direction(cross(forward, [0, 0, 1]));
    return {
      zoom, forward, half, eye: scale(forward, -distance / zoom), right: scale(right, half), up: scale(cross(right, forward), half),
      near: 0.05 * distance / zoom, focus: this.focus(settings),
    };
  }

  /** A mesh on the GPU, relative to the focus; cached per role. */
  placed(role, shape, focus) {
    const { gpu } = this.page, key = String(focus), known = this.kept.get(role);
    if (known?.key === key && known.shape === shape && known.gpu === gpu) return known.mesh;
    if (known?.gpu === gpu) known.mesh.free();
    this.kept.set(role, { key, shape, gpu, mesh: gpu.mesh(shape.from(focus)) });
    return this.kept.get(role).mesh;
  }

  mesh(settings, camera) {
    let shape = null;
    if (settings.shape === 'plane') {
      const key = [camera.focus, camera.zoom].join();
      if (this.flat?.key !== key) this.flat = { key, shape: plane(camera.focus, 0.25 / camera.zoom) };
      ({ shape } = this.flat);
    } else shape = this.shape(settings);
    this.triangles = shape.triangles;
    return this.placed('subject', shape, camera.focus);
  }

  drag(dx, dy, moving, settings) {
    const camera = this.camera(settings);
    if (!moving) {
      const turn = settings.turn - 180 * dx, height = settings.height + 120 * dy;
      return { turn: turn - 360 * Math.round(turn / 360), height: Math.min(89, Math.max(-89, height)), at: this.named(camera.focus) };
    }
    return this.looking(add(camera.eye, add(scale(camera.right, -2 * dx), scale(camera.up, 2 * dy))), camera, settings);
  }

  /** The settings to look at the intersection of a ray from `eye` along the axis. */
  looking(eye, camera, settings, along = camera.forward) {
    const from = add(camera.focus, eye);
    if (settings.shape === 'plane') {
      const t = -from[2] / along[2];
      return t > 0 && t < 1e4 ? { at: this.named(add(from, scale(along, t))) } : {};
    }
    const hit = this.shape(settings).hit(from, along);
    return hit ? { at: this.named(hit.p) } : {};
  }

  named(p) { return p.map(x => +x.toPrecision(12)).join(','); }

  pick(x, y, settings) {
    const camera = this.camera(settings);
    const along = direction(add(camera.forward, add(scale(camera.right, x), scale(camera.up, y))));
    return this.looking(camera.eye, camera, settings, along);
  }

  nearer(factor, settings) {
    const zoom = Math.min(this.deepest, Math.max(0, settings.zoom + Math.log10(factor)));
    return { zoom, at: this.named(this.focus(settings)) };
  }
}
