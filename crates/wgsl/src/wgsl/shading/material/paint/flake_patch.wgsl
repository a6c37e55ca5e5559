// Patches of space, one per flake of `asperity_shading::MetallicPaint`.

struct FlakePatch {
    // Whether there is a flake at the point.
    there: bool,
    // A random number in [0, 1), the same at all points of the flake.
    value: f32,
    // Tilt, to be added to a unit normal: uniform in the unit ball.
    tilt: vec3<f32>,
}

// A number in [0, 1) from 24 bits of the hash of a cell.
fn flake_patch_random(terms: u32, key: u32) -> f32 {
    return f32(integer_hash_word(terms, key) >> 8u) / 16777216.0;
}

// The flake of the cell of a point, and the distance of the point from its center along each axis.
struct FlakePatchNearest {
    flake: FlakePatch,
    off: vec3<f32>,
}

// Keys are the keys of seed ^ k * 0x9e3779b9, for k = 0 to 3 and 4 to 6. There is no flake where
// cells cannot be resolved.
fn flake_patch_nearest(
    position: vec3<f32>,
    cell: f32,
    width: vec3<f32>,
    scatter: f32,
    keys: vec4<u32>,
    more_keys: vec4<u32>,
) -> FlakePatchNearest {
    let place = position / cell;
    if !direction_is_finite(place) || !(max(abs(place.x), max(abs(place.y), abs(place.z))) < 8388608.0) {
        return FlakePatchNearest(FlakePatch(false, 0.0, vec3<f32>(0.0)), vec3<f32>(0.0));
    }
    let corner = floor(place);
    let cells = vec3<i32>(corner);
    let terms = integer_hash_term(0u, cells.x) ^ integer_hash_term(1u, cells.y) ^ integer_hash_term(2u, cells.z);
    let room = clamp(vec3<f32>(1.0) - width / cell, vec3<f32>(0.0), vec3<f32>(1.0)) * math_clamped(scatter, 1.0);
    let random = vec3<f32>(
        flake_patch_random(terms, more_keys.x), flake_patch_random(terms, more_keys.y), flake_patch_random(terms, more_keys.z),
    );
    let middle = vec3<f32>(0.5) + (random - 0.5) * room;
    let off = abs((place - corner) - middle) * cell;
    let z = 1.0 - 2.0 * flake_patch_random(terms, keys.y);
    let across = sqrt(max(1.0 - z * z, 0.0));
    let turn = elementary_cos_sin_turns(flake_patch_random(terms, keys.z));
    let w = flake_patch_random(terms, keys.w);
    var radius = 0.0;
    if w > 0.0 {
        radius = elementary_exp(elementary_ln(w) * 0.33333334);
    }
    let tilt = vec3<f32>(across * turn.x, across * turn.y, z) * radius;
    return FlakePatchNearest(FlakePatch(true, flake_patch_random(terms, keys.x), tilt), off);
}

// The flake at a point.
fn flake_patch(
    position: vec3<f32>,
    cell: f32,
    width: vec3<f32>,
    scatter: f32,
    keys: vec4<u32>,
    more_keys: vec4<u32>,
) -> FlakePatch {
    let nearest = flake_patch_nearest(position, cell, width, scatter, keys, more_keys);
    if nearest.flake.there && all(nearest.off <= 0.5 * width) {
        return nearest.flake;
    }
    return FlakePatch(false, 0.0, vec3<f32>(0.0));
}

// The flake in the cell of a point, and the fraction of a pixel at the point that it covers.
struct FlakePatchCovered {
    flake: FlakePatch,
    cover: f32,
}

// The coverage along one axis, for a flake as wide as the cell where the edge is 0.
fn flake_patch_cover(width: f32, edge: f32, off: f32) -> f32 {
    if edge > 0.0 {
        return math_clamped((0.5 * width - off) / edge + 0.5, 1.0);
    }
    return select(0.0, 1.0, width > 0.0);
}

// Flakes are scattered over the cell. Their edges are as wide as the pixel, but at most as wide as
// the flake and the rest of the cell.
fn flake_patch_covered(
    position: vec3<f32>,
    cell: f32,
    width: vec3<f32>,
    edge: f32,
    keys: vec4<u32>,
    more_keys: vec4<u32>,
) -> FlakePatchCovered {
    let edges = max(min(min(width, vec3<f32>(cell) - width), vec3<f32>(edge)), vec3<f32>(0.0));
    let nearest = flake_patch_nearest(position, cell, width + edges, 1.0, keys, more_keys);
    let cover = flake_patch_cover(width.x, edges.x, nearest.off.x)
        * flake_patch_cover(width.y, edges.y, nearest.off.y)
        * flake_patch_cover(width.z, edges.z, nearest.off.z);
    return FlakePatchCovered(nearest.flake, cover);
}
