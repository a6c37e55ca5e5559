// A smooth surface over a grid of unequal cells that is not a product of curves:
// `asperity_fif::Folded`.
//
//   f = H + s (H - G)(fold) + s^2 (H - G)(fold^2) + ...      fold: every cell onto the whole, rising and falling in turn
//
// The nodes of all surfaces are in `fif_nodes`, row by row along y, eight numbers each: position,
// height and slopes of H, then of H - G. Lengths are in units of the domain.

// A cell along an axis, and a position within it in units of the cell.
struct FoldedStrip {
    index: u32,
    width: f32,
    u: f32,
}

// A patch over a cell: the position along both axes, and heights and slopes at its corners, with
// slopes per width of the cell.
struct FoldedPatch {
    x: FoldedStrip,
    y: FoldedStrip,
    near_left: vec3<f32>,
    far_left: vec3<f32>,
    near_right: vec3<f32>,
    far_right: vec3<f32>,
}

// Index in `fif_nodes` of the first word of a node.
fn folded_node(surface: FoldedSurface, i: u32, j: u32) -> u32 {
    return surface.first + 8u * (i * (surface.cells.y + 1u) + j);
}

// A knot of an axis, 0 for x and 1 for y.
fn folded_knot(surface: FoldedSurface, axis: u32, index: u32) -> f32 {
    let node = select(folded_node(surface, 0u, index), folded_node(surface, index, 0u), axis == 0u);
    return fif_nodes(node + axis);
}

// The cell of an axis that contains a position in [0, 1].
fn folded_strip(surface: FoldedSurface, axis: u32, place: f32) -> FoldedStrip {
    let count = select(surface.cells.y, surface.cells.x, axis == 0u);
    var index = min(u32(place * f32(count)), count - 1u);
    for (var k = 1u; k < count; k++) {
        if index > 0u && place < folded_knot(surface, axis, index) {
            index -= 1u;
        } else if index + 1u < count && place >= folded_knot(surface, axis, index + 1u) {
            index += 1u;
        } else {
            break;
        }
    }
    let begin = folded_knot(surface, axis, index);
    let width = folded_knot(surface, axis, index + 1u) - begin;
    return FoldedStrip(index, width, min((place - begin) / width, 1.0));
}

// Image of a position in a cell; every other cell falls.
fn folded_image(strip: FoldedStrip) -> f32 {
    return select(strip.u, 1.0 - strip.u, (strip.index & 1u) == 1u);
}

// Slope of that image.
fn folded_slope(strip: FoldedStrip) -> f32 {
    return select(1.0, -1.0, (strip.index & 1u) == 1u) / strip.width;
}

// Height and slopes at a node, from one of its words on, per width of a cell.
fn folded_corner(surface: FoldedSurface, i: u32, j: u32, word: u32, x: f32, y: f32) -> vec3<f32> {
    let at = folded_node(surface, i, j) + word;
    return vec3<f32>(fif_nodes(at), fif_nodes(at + 1u) * x, fif_nodes(at + 2u) * y);
}

// The patch at a point of the unit square, of H or H - G, selected by the word offset in nodes.
fn folded_patch(surface: FoldedSurface, at: vec2<f32>, word: u32) -> FoldedPatch {
    let x = folded_strip(surface, 0u, at.x);
    let y = folded_strip(surface, 1u, at.y);
    return FoldedPatch(
        x,
        y,
        folded_corner(surface, x.index, y.index, word, x.width, y.width),
        folded_corner(surface, x.index, y.index + 1u, word, x.width, y.width),
        folded_corner(surface, x.index + 1u, y.index, word, x.width, y.width),
        folded_corner(surface, x.index + 1u, y.index + 1u, word, x.width, y.width),
    );
}

// Cubic Hermite basis: heights at 0 and at 1, slopes there.
fn folded_basis(u: f32) -> vec4<f32> {
    let v = 1.0 - u;
    return vec4<f32>((1.0 + 2.0 * u) * v * v, (1.0 + 2.0 * v) * u * u, u * v * v, -(v * u * u));
}

// Slopes of the Hermite basis.
fn folded_basis_slopes(u: f32) -> vec4<f32> {
    let v = 1.0 - u;
    return vec4<f32>(-(6.0 * u * v), 6.0 * u * v, v * (1.0 - 3.0 * u), u * (3.0 * u - 2.0));
}

// A patch with Hermite cubics along both axes, without the mixed term of two slopes.
fn folded_sum(piece: FoldedPatch, x: vec4<f32>, y: vec4<f32>) -> f32 {
    let left = y.x * piece.near_left.x + y.y * piece.far_left.x + (y.z * piece.near_left.z + y.w * piece.far_left.z);
    let right = y.x * piece.near_right.x + y.y * piece.far_right.x + (y.z * piece.near_right.z + y.w * piece.far_right.z);
    let rise_left = y.x * piece.near_left.y + y.y * piece.far_left.y;
    let rise_right = y.x * piece.near_right.y + y.y * piece.far_right.y;
    return x.x * left + x.z * rise_left + (x.y * right + x.w * rise_right);
}

// Height at a point clamped to the domain; a NaN coordinate is returned unchanged.
fn folded_surface_height(surface: FoldedSurface, p: vec2<f32>) -> f32 {
    if !fif_is_number(p.x) {
        return p.x;
    }
    if !fif_is_number(p.y) {
        return p.y;
    }
    var at = clamp((p - surface.origin) * surface.per_width, vec2<f32>(0.0), vec2<f32>(1.0));
    var sum = 0.0;
    var weight = 1.0;
    for (var k = 0u; k < surface.steps; k++) {
        let piece = folded_patch(surface, at, select(5u, 2u, k == 0u));
        sum += weight * folded_sum(piece, folded_basis(piece.x.u), folded_basis(piece.y.u));
        weight *= surface.factor;
        at = vec2<f32>(folded_image(piece.x), folded_image(piece.y));
    }
    return sum + weight * surface.middle;
}

// Height and gradient at the nearest point of the domain.
fn folded_surface_jet(surface: FoldedSurface, p: vec2<f32>) -> vec3<f32> {
    if !fif_is_number(p.x) {
        return vec3<f32>(p.x);
    }
    if !fif_is_number(p.y) {
        return vec3<f32>(p.y);
    }
    var at = clamp((p - surface.origin) * surface.per_width, vec2<f32>(0.0), vec2<f32>(1.0));
    var sum = vec3<f32>(0.0);
    var weight = vec3<f32>(1.0);
    for (var k = 0u; k < surface.steps; k++) {
        let piece = folded_patch(surface, at, select(5u, 2u, k == 0u));
        let x = folded_basis(piece.x.u);
        let y = folded_basis(piece.y.u);
        let slope_x = folded_sum(piece, folded_basis_slopes(piece.x.u), y) / piece.x.width;
        let slope_y = folded_sum(piece, x, folded_basis_slopes(piece.y.u)) / piece.y.width;
        sum += weight * vec3<f32>(folded_sum(piece, x, y), slope_x, slope_y);
        weight *= surface.factor * vec3<f32>(1.0, folded_slope(piece.x), folded_slope(piece.y));
        at = vec2<f32>(folded_image(piece.x), folded_image(piece.y));
    }
    sum += weight * vec3<f32>(surface.middle, surface.slope_x, surface.slope_y);
    return vec3<f32>(sum.x, sum.yz * surface.per_width);
}
