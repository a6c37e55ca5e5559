// A normal distribution from the array of `NdfMap::pack`: `asperity_ndf_sampling::PackedMapRef`.
//
// Words are read instead of floats. Integers are stored as the floats of their bits, which hardware
// may flush to zero.

fn packed_map_float(i: u32) -> f32 {
    return bitcast<f32>(packed_map_word(i));
}

fn packed_map_four(i: u32) -> vec4<f32> {
    return vec4<f32>(packed_map_float(i), packed_map_float(i + 1u), packed_map_float(i + 2u), packed_map_float(i + 3u));
}

// The last leaf whose key is at most the value, starting from the guide's entry; key 0 is the
// weight, 2 the place.
fn packed_map_leaf(entry_at: u32, key: u32, value: f32) -> u32 {
    var leaf = packed_map_word(entry_at);
    let keys = vec3<f32>(
        packed_map_float(entry_at + 1u),
        packed_map_float(entry_at + 2u),
        packed_map_float(entry_at + 3u),
    );
    if keys.x <= value {
        leaf += select(1u, 2u, keys.y <= value);
    }
    if keys.z <= value {
        // Rarely executed. It is not known whether the next leaves are passed, too.
        loop {
            if leaf + 1u >= packed_map_grid.leaves {
                break;
            }
            if packed_map_float(packed_map_grid.leaves_at + 16u * (leaf + 1u) + key) > value {
                break;
            }
            leaf += 1u;
        }
    }
    return leaf;
}

// The column or row of a position relative to the middle, and the position in it.
fn packed_map_cell(at: f32, origin: f32, last: f32) -> vec2<f32> {
    let cell = f32(u32(min(at + origin, last)));
    // A rounded sum may select the neighboring cell.
    return vec2<f32>(cell, clamp(at - (cell - origin), 0.0, 1.0));
}

// The marginal of a leaf and its part below the middle, at position s.
fn packed_map_marginals(marginal: vec4<f32>, below: vec4<f32>, s: f32) -> vec2<f32> {
    let o = 1.0 - s;
    let o_square = o * o;
    let s_square = s * s;
    let a = o_square * o;
    let b = o_square * s;
    let c = o * s_square;
    let d = s_square * s;
    return vec2<f32>(
        (marginal.x * a + marginal.y * b) + (marginal.z * c + marginal.w * d),
        (below.x * a + below.y * b) + (below.z * c + below.w * d),
    );
}

// Four times the integral of the marginal up to position s, and over the whole leaf.
fn packed_map_integrals(marginal: vec4<f32>, s: f32) -> vec2<f32> {
    let o = 1.0 - s;
    let o_square = o * o;
    let s_square = s * s;
    let both = marginal.x + marginal.y * 0.33333334;
    let three = both + marginal.z * 0.33333334;
    let sum = three + marginal.w;
    let first = o_square * (4.0 * marginal.x * o + 6.0 * both * s);
    return vec2<f32>(s * (first + s_square * (4.0 * three * o + sum * s)), sum);
}

// Integral and value on a line of a column of cells, at fraction t from its left to its right side.
fn packed_map_line(column: u32, t: f32, line: u32) -> vec2<f32> {
    let at = packed_map_grid.nodes_at + column * packed_map_grid.stride + packed_map_grid.sides * line;
    let left = packed_map_float(at);
    if packed_map_grid.sides == 1u {
        return vec2<f32>(left, 0.0);
    }
    let right_at = at + packed_map_grid.stride;
    let o = 1.0 - t;
    return vec2<f32>(
        o * left + t * packed_map_float(right_at),
        o * packed_map_float(at + 1u) + t * packed_map_float(right_at + 1u),
    );
}

// A coordinate of a normal from -1 to 1; 0 for NaN.
fn packed_map_coordinate(n: f32) -> f32 {
    return clamp(elementary_number(n), -1.0, 1.0);
}

// D(m) in 1/sr; 0 outside the disk, for m.z <= 0 and NaN.
fn packed_map_d(m: vec3<f32>) -> f32 {
    let inside = m.x * m.x + m.y * m.y < 1.000001 && m.z > 0.0;
    if !inside {
        return 0.0;
    }
    let place = vec2<f32>(m.x, m.y) * packed_map_grid.density + packed_map_grid.origin;
    let x = min(select(0.0, place.x, place.x > 0.0), packed_map_grid.last.x);
    let y = min(select(0.0, place.y, place.y > 0.0), packed_map_grid.last.y);
    let column = u32(x);
    let row = u32(y);
    let at = packed_map_grid.texels_at + column * packed_map_grid.texel_stride + row;
    let a = packed_map_float(at);
    if packed_map_grid.sides == 1u {
        return a;
    }
    let b = packed_map_float(at + 1u);
    let right_at = at + packed_map_grid.texel_stride;
    let t = x - f32(column);
    let begin = a + t * (packed_map_float(right_at) - a);
    let end = b + t * (packed_map_float(right_at + 1u) - b);
    return begin + (y - f32(row)) * (end - begin);
}

// (M, C): the uniform numbers of a normal from its first two coordinates, each in [0, 1]:
// `PackedMapRef::forward`.
fn packed_map_forward(n: vec2<f32>) -> vec2<f32> {
    let x = packed_map_coordinate(n.x);
    let y = packed_map_coordinate(n.y);
    let half_guide = 0.5 * packed_map_grid.guide;
    let part = u32(min(x * half_guide + half_guide, packed_map_grid.guide - 0.5));
    let at = x * packed_map_grid.density.x;
    let column = packed_map_cell(at, packed_map_grid.origin.x, packed_map_grid.last.x);
    let row = packed_map_cell(y * packed_map_grid.density.y, packed_map_grid.origin.y, packed_map_grid.last.y);
    let leaf = packed_map_leaf(packed_map_grid.by_place_at + 4u * part, 2u, at);
    // Weight, one over the sum of the coefficients times it, begin, one over the width.
    let head = packed_map_four(packed_map_grid.heads_at + 4u * leaf);
    let cubics_at = packed_map_grid.leaves_at + 16u * leaf + 8u;
    let marginal_cubic = packed_map_four(cubics_at);
    let s = clamp((at - head.z) * head.w, 0.0, 1.0);
    let weight = head.x + packed_map_integrals(marginal_cubic, s).x * head.y;
    let marginals = packed_map_marginals(marginal_cubic, packed_map_four(cubics_at + 4u), s);
    let low = packed_map_line(u32(column.x), column.y, u32(row.x));
    let high = packed_map_line(u32(column.x), column.y, u32(row.x) + 1u);
    let q = row.y;
    var sum = low.x + q * (high.x - low.x);
    if packed_map_grid.sides != 1u {
        sum = low.x + q * (low.y + 0.5 * q * (high.y - low.y));
    }
    if !(marginals.x > 0.0) {
        // The conditional of zero weight is uniform on the chord.
        let chord = sqrt(max(1.0 - x * x, ELEMENTARY_LEAST_NORMAL));
        return vec2<f32>(min(weight, 1.0), clamp(0.5 * (y / chord) + 0.5, 0.0, 1.0));
    }
    let share = clamp((sum + marginals.y) / max(marginals.x, ELEMENTARY_LEAST_NORMAL), 0.0, 1.0);
    return vec2<f32>(min(weight, 1.0), share);
}

// The position in a leaf at which the fraction r of its weight is reached, with as many steps as
// needed; the Rust crate uses 64 bits.
fn packed_map_many_steps(marginal: vec4<f32>, r: f32, least: f32) -> f32 {
    // Bernstein coefficients; their sums are the coefficients of four times the integral.
    let b = vec4<f32>(marginal.x, marginal.y * 0.33333334, marginal.z * 0.33333334, marginal.w);
    let sum = b.x + b.y + b.z + b.w;
    let faint = 2.5e-7 * sum;
    let away = min(least, 0.5);
    let share = min(max(r, select(0.0, away, b.x < faint)), select(1.0, 1.0 - away, b.w < faint));
    let wanted = share * sum;
    // In closed form for a linear polynomial, followed by bracketed Newton steps.
    let root = sqrt(max(b.x * b.x + share * (b.w * b.w - b.x * b.x), 0.0));
    var s = share;
    if b.x + root > 0.0 {
        let linear = share * (b.x + b.w) / (b.x + root);
        s = select(share, linear, linear > 0.0 && linear <= 1.0);
    }
    var low = 0.0;
    var high = 1.0;
    for (var k = 0; k < 32; k++) {
        let excess = packed_map_integrals(marginal, s).x - wanted;
        if excess > 0.0 {
            high = s;
        } else {
            low = s;
        }
        let slope = packed_map_marginals(marginal, marginal, s).x;
        var next = 0.5 * (low + high);
        if slope > 0.0 {
            let newton = s - 0.25 * excess / slope;
            next = select(next, newton, newton > low && newton < high);
        }
        let change = abs(next - s);
        s = next;
        if change <= 1.1920929e-7 * s {
            break;
        }
    }
    return s;
}

// Whether the integral up to a line exceeds the target, between the integrals of the bottom and of
// the top.
fn packed_map_reaches(sum: f32, wanted: f32, bottom: f32, top: f32) -> bool {
    if wanted >= top {
        return sum >= top;
    }
    return sum > max(wanted, bottom);
}

// The last row with weight that begins at or below the target.
fn packed_map_search(column: u32, t: f32, wanted: f32) -> u32 {
    let rows = packed_map_grid.last_row + 1u;
    let bottom = packed_map_line(column, t, 0u).x;
    let top = packed_map_line(column, t, rows).x;
    var low = 0u;
    var high = rows;
    loop {
        if high - low <= 1u {
            break;
        }
        let middle = (low + high) / 2u;
        if packed_map_reaches(packed_map_line(column, t, middle).x, wanted, bottom, top) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return low;
}

// The coordinate y, moved to the end of the chord if it is beyond it, or to the next weight inward.
fn packed_map_inside(column: u32, t: f32, x: f32, y: f32) -> f32 {
    if x * x + y * y <= 0.9999995 {
        return y;
    }
    let chord = sqrt(max(1.0 - x * x, 0.0)) * 0.9999995;
    let nearest = clamp(y, -chord, chord);
    let density = packed_map_grid.density.y;
    let origin = packed_map_grid.origin.y;
    let first = min(u32(max(-chord * density + origin, 0.0)), packed_map_grid.last_row);
    let last = min(u32(max(chord * density + origin, 0.0)), packed_map_grid.last_row);
    let here = min(u32(max(nearest * density + origin, 0.0)), packed_map_grid.last_row);
    // Inward from the end of the chord on that side.
    for (var k = 0u; k <= last - first; k++) {
        let row = select(last - k, first + k, y < 0.0);
        if packed_map_line(column, t, row).x < packed_map_line(column, t, row + 1u).x {
            if row == here {
                return nearest;
            }
            let margin = packed_map_grid.margin;
            let within = select(1.0 - margin, margin, y < 0.0);
            return clamp((f32(row) - origin + within) * packed_map_grid.size.y, -chord, chord);
        }
    }
    return nearest;
}

// The inverse of (M, C): the first two coordinates of the normal of uniform numbers:
// `PackedMapRef::inverse`.
fn packed_map_inverse(u: vec2<f32>) -> vec2<f32> {
    let v = elementary_probabilities(u);
    let leaf = packed_map_leaf(packed_map_grid.by_weight_at + 4u * u32(v.x * packed_map_grid.guide), 0u, v.x);
    let leaf_at = packed_map_grid.leaves_at + 16u * leaf;
    // Weight, one over the leaf's own, begin, width.
    let place = packed_map_four(leaf_at);
    let c = packed_map_four(leaf_at + 4u);
    let marginal_cubic = packed_map_four(leaf_at + 8u);
    let r = clamp((v.x - place.x) * place.y, 0.0, 1.0);
    let is_flagged = place.w < 0.0;
    let wide = abs(place.w);
    var s = 0.0;
    if is_flagged && c.x == ELEMENTARY_LARGEST {
        s = packed_map_many_steps(marginal_cubic, r, 1e-7 * place.y);
    } else {
        let bent = (c.x + r * c.y) + (r * r) * (c.z + r * c.w);
        s = clamp(r + r * (1.0 - r) * bent, 0.0, 1.0);
        if is_flagged {
            let integrals = packed_map_integrals(marginal_cubic, s);
            let marginal = packed_map_marginals(marginal_cubic, marginal_cubic, s).x;
            let slope = max(4.0 * marginal, ELEMENTARY_LEAST_NORMAL);
            s = clamp(s - (integrals.x - r * integrals.y) / slope, 0.0, 1.0);
        }
    }
    let x = clamp((place.z + wide * s) * packed_map_grid.size.x, -1.0, 1.0);
    // A piece is in one column.
    let origin = packed_map_grid.origin.x;
    let column = u32(min(place.z + 0.5 * wide + origin, packed_map_grid.last.x));
    // The conditional of the rounded position, which `packed_map_forward` also uses.
    let at = x * packed_map_grid.density.x;
    let t = clamp(at - (f32(column) - origin), 0.0, 1.0);
    if is_flagged {
        s = clamp((at - place.z) / max(wide, ELEMENTARY_LEAST_NORMAL), 0.0, 1.0);
    }
    let marginals = packed_map_marginals(marginal_cubic, packed_map_four(leaf_at + 12u), s);
    var wanted = v.y * marginals.x - marginals.y;

    // The line before the row given by the quantiles.
    let rank = v.y * packed_map_grid.quantiles;
    let rank_at = packed_map_grid.quantiles_at + column * packed_map_grid.ranks + u32(rank);
    let before = packed_map_float(rank_at);
    let after = packed_map_float(rank_at + 1u);
    let guess = before + (after - before) * (rank - f32(u32(rank))) - 1.0;
    var row = u32(min(max(guess, 0.0), f32(packed_map_grid.last_row)));
    var first = packed_map_line(column, t, row);
    var fourth = packed_map_line(column, t, row + 3u);
    if wanted < first.x || fourth.x <= wanted {
        row = packed_map_search(column, t, wanted);
        first = packed_map_line(column, t, row);
        // The float below the end, which is at least the beginning and not negative.
        let end = packed_map_line(column, t, row + 1u).x;
        let below_end = bitcast<f32>(bitcast<u32>(end) - select(0u, 1u, end > 0.0));
        wanted = max(min(wanted, below_end), first.x);
        fourth = packed_map_line(column, t, row + 3u);
    }
    let second = packed_map_line(column, t, row + 1u);
    let third = packed_map_line(column, t, row + 2u);
    var begin = first;
    var end = second;
    if third.x <= wanted {
        begin = third;
        end = fourth;
        row += 2u;
    } else if second.x <= wanted {
        begin = second;
        end = third;
        row += 1u;
    }
    let excess = max(wanted - begin.x, 0.0);
    var q = 0.0;
    if packed_map_grid.sides == 1u {
        q = excess / max(end.x - begin.x, ELEMENTARY_LEAST_NORMAL);
    } else {
        let twice = excess + excess;
        let root = sqrt(max(begin.y * begin.y + (end.y - begin.y) * twice, 0.0));
        q = twice / max(begin.y + root, ELEMENTARY_LEAST_NORMAL);
    }
    q = min(max(q, packed_map_grid.margin), 1.0 - packed_map_grid.margin);
    let y = ((f32(row) - packed_map_grid.origin.y) + q) * packed_map_grid.size.y;
    return vec2<f32>(x, packed_map_inside(column, t, x, y));
}

// A normal with the density D over the macro surface, from uniform u in the unit square:
// `PackedMapRef::sample`.
fn packed_map_sample(u: vec2<f32>) -> vec3<f32> {
    let n = packed_map_inverse(u);
    return vec3<f32>(n.x, n.y, sqrt(max(1.0 - n.x * n.x - n.y * n.y, 1e-15)));
}

// T(z): the normal of Gaussian coordinates, with the distribution function in 32 bits; the Rust
// crate uses 64.
fn packed_map_warp_gaussian(z: vec2<f32>) -> vec3<f32> {
    let x = gaussian_cdf(elementary_number(z.x));
    let y = gaussian_cdf(elementary_number(z.y));
    return packed_map_sample(vec2<f32>(x, y));
}

// The quantile of u from 2^-25 to 1 - 2^-25, by the smaller side.
fn packed_map_quantile(u: f32) -> f32 {
    let z = inverse_gaussian_cdf(max(min(u, 1.0 - u), 2.9802322e-8));
    return select(z, -z, u > 0.5);
}

// The inverse of T: the Gaussian coordinates of a normal.
fn packed_map_invert(m: vec3<f32>) -> vec2<f32> {
    let u = packed_map_forward(vec2<f32>(m.x, m.y));
    return vec2<f32>(packed_map_quantile(u.x), packed_map_quantile(u.y));
}

// p_s(h | z_b) in 1/sr, the density of the unresolved part.
fn packed_map_residual_ndf(h: vec3<f32>, split: GaussianSplit) -> f32 {
    let density = packed_map_d(h);
    if !(density > 0.0) {
        return 0.0;
    }
    return gaussian_split_weigh(split, density, packed_map_invert(h));
}
