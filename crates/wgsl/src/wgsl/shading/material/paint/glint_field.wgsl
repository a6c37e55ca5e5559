// Flakes counted by hashes, with a normal distribution as their mean:
// `asperity_shading::material::GlintField`.

// A flake: its cell, and its center in cells.
struct GlintFieldFlake {
    cell: vec3<i32>,
    center: vec3<f32>,
}

// The word of a cell of flakes.
fn glint_field_word(cell: vec3<i32>, key: u32) -> u32 {
    let terms = integer_hash_term(0u, cell.x) ^ integer_hash_term(1u, cell.y) ^ integer_hash_term(2u, cell.z);
    return integer_hash_word(terms, key);
}

// The jittered center of a cell, in cells.
fn glint_field_center(cell: vec3<i32>, key: u32) -> vec3<f32> {
    let word = glint_field_word(cell, key);
    let jitter = vec3<f32>(vec3<u32>(word & 1023u, (word >> 10u) & 1023u, (word >> 20u) & 1023u)) / 2048.0;
    return vec3<f32>(cell) + (jitter + 0.25);
}

// Selects one of three numbers.
fn glint_field_of(k: u32, first: f32, second: f32, third: f32) -> f32 {
    return select(select(third, second, k == 1u), first, k == 0u);
}

// Whether cells can be resolved at a position in cells.
fn glint_field_is_near(place: vec3<f32>) -> bool {
    return direction_is_finite(place) && max(abs(place.x), max(abs(place.y), abs(place.z))) < 8388608.0;
}

// The flake with the center nearest to a position in cells, where cells can be resolved.
fn glint_field_nearest(field: GlintField, place: vec3<f32>) -> GlintFieldFlake {
    let corner = floor(place);
    let base = vec3<i32>(corner);
    let own = place - glint_field_center(base, field.key);
    // No other center is nearer if all possible centers of its cell are farther than the center of
    // the point's own cell. Centers far from the origin are rounded.
    let bound = dot(own, own) * 1.0001;
    let slack = max(abs(place.x), max(abs(place.y), abs(place.z))) * 1.1920929e-7 + 1e-6;
    let within = place - corner;
    let below = max((within + 0.25) - slack, vec3<f32>(0.0));
    let here = max(max(0.25 - within, within - 0.75) - slack, vec3<f32>(0.0));
    let above = max((1.25 - within) - slack, vec3<f32>(0.0));
    var best = GlintFieldFlake(base, vec3<f32>(0.0));
    var least = MATH_LARGEST;
    for (var i = 0u; i < 27u; i++) {
        let x = glint_field_of(i % 3u, below.x, here.x, above.x);
        let y = glint_field_of((i / 3u) % 3u, below.y, here.y, above.y);
        let z = glint_field_of(i / 9u, below.z, here.z, above.z);
        if x * x + y * y + z * z <= bound {
            let cell = base + vec3<i32>(i32(i % 3u) - 1, i32((i / 3u) % 3u) - 1, i32(i / 9u) - 1);
            let center = glint_field_center(cell, field.key);
            let apart = place - center;
            let distance = dot(apart, apart);
            if distance < least {
                least = distance;
                best = GlintFieldFlake(cell, center);
            }
        }
    }
    return best;
}

// A Gaussian number of 32 bits, computed from the tail that contains the word.
fn glint_field_gaussian(word: u32) -> f32 {
    let is_high = word > 0x7fffffffu;
    let tail = (f32(select(word, ~word, is_high)) + 0.5) / 4294967296.0;
    let quantile = inverse_gaussian_cdf(max(tail, 2.3283064e-10));
    return select(quantile, -quantile, is_high);
}

// The Gaussian coordinates of the normal of a cell's flake; `warp_gaussian` of the distribution
// maps them to the normal.
fn glint_field_tilt(field: GlintField, cell: vec3<i32>) -> vec2<f32> {
    return vec2<f32>(
        glint_field_gaussian(glint_field_word(cell, field.tilt_keys.x)),
        glint_field_gaussian(glint_field_word(cell, field.tilt_keys.y)),
    );
}

// The number of whole halvings of a number above 0.
fn glint_field_exponent(x: f32) -> i32 {
    return i32(bitcast<u32>(x) >> 23u) - 127;
}

// The whole and the fractional part of the binary logarithm of a number of at least 1.
fn glint_field_logarithm(x: f32) -> vec2<f32> {
    let mantissa = bitcast<f32>((bitcast<u32>(x) & 0x7fffffu) | 0x3f800000u);
    return vec2<f32>(f32(glint_field_exponent(x)), elementary_ln(mantissa) * 1.442695);
}

// A binomial number of successes of n trials with probability p from a random word: `binomial`.
fn glint_field_binomial(n: f32, p: f32, word: u32) -> f32 {
    let mean = n * p;
    if mean > 8192.0 {
        return floor(mean + 0.5);
    }
    if mean > 16.0 {
        let bytes = (word & 255u) + ((word >> 8u) & 255u) + ((word >> 16u) & 255u) + (word >> 24u);
        return min(floor(mean + sqrt(mean * (1.0 - p)) / 147.801 * (f32(bytes) - 510.0) + 0.5), n);
    }
    let uniform_number = (f32(word) + 0.5) / 4294967296.0;
    if n <= 1.0 {
        return select(0.0, n, uniform_number < p);
    }
    let log = elementary_ln_1p(-p);
    let t = -(n * log);
    // The probability of more than k, which preserves the digits of small probabilities.
    var above = t * elementary_one_minus_exp_ratio(t, elementary_exp(-0.5 * t));
    var exactly = mean * elementary_exp((n - 1.0) * log);
    var k = 0.0;
    while uniform_number < above && k < n && k < 64.0 {
        k += 1.0;
        above -= exactly;
        exactly *= (n - k) / (k + 1.0) * p / (1.0 - p);
    }
    return k;
}

// Bins of one Gaussian coordinate, the leaves of a binary tree of intervals: `Axis`.
struct GlintFieldAxis {
    width: f32,
    splits: i32,
}

// Bins 2^joined times as wide as those of point lights.
fn glint_field_axis(bin: f32, joined: i32) -> GlintFieldAxis {
    var splits = 1;
    var end = bin;
    while end < 5.0 && splits < 14 {
        splits += 1;
        end *= 2.0;
    }
    let level = min(joined, splits);
    return GlintFieldAxis(bin * f32(1u << u32(level)), splits - level);
}

// The index of the highest bin; the lowest has −1 minus it.
fn glint_field_highest(axis: GlintFieldAxis) -> i32 {
    return (1i << u32(max(axis.splits, 1) - 1)) - 1;
}

// The bin of a coordinate.
fn glint_field_index(axis: GlintFieldAxis, z: f32) -> i32 {
    let highest = f32(glint_field_highest(axis));
    return i32(clamp(floor(z / axis.width), -1.0 - highest, highest));
}

// The sum of the series of `glint_field_interval`.
fn glint_field_series(middle: f32, width: f32) -> f32 {
    let m = middle * middle;
    let w = width * width * 0.25;
    let fourth = (m - 6.0) * m + 3.0;
    let sixth = ((m - 15.0) * m + 45.0) * m - 15.0;
    return 1.0 + w * ((m - 1.0) / 6.0 + w * (fourth / 120.0 + w * (sixth / 5040.0)));
}

// The probability of a standard Gaussian number in an interval on one side of 0: `interval`.
fn glint_field_interval(middle: f32, width: f32) -> f32 {
    if width * (abs(middle) + 2.0) <= 1.0 {
        return width * 0.3989423 * elementary_exp(-0.5 * middle * middle) * glint_field_series(middle, width);
    }
    let z = -abs(middle);
    return gaussian_cdf(z + 0.5 * width) - gaussian_cdf(z - 0.5 * width);
}

// The probability of a bin, by its distance from 0; the outermost has no end.
fn glint_field_mass(axis: GlintFieldAxis, index: i32) -> f32 {
    if axis.splits == 0 {
        return 1.0;
    }
    let from_zero = max(index, -1 - index);
    if from_zero >= glint_field_highest(axis) {
        return gaussian_cdf(-f32(from_zero) * axis.width);
    }
    return glint_field_interval((f32(from_zero) + 0.5) * axis.width, axis.width);
}

// The probability of the half of an interval that is farther from 0: `Axis::outer`.
fn glint_field_outer(axis: GlintFieldAxis, split: i32, index: i32) -> f32 {
    if split == 0 {
        return 0.5;
    }
    let half = u32(axis.splits - split - 1);
    let inner = 2 * max(index, -1 - index);
    let width = axis.width * f32(1u << half);
    let middle = (f32(inner) + 1.0) * width;
    let has_end = inner + 2 < (glint_field_highest(axis) + 1) >> half;
    if has_end && width * (middle + 2.5) <= 1.0 {
        let near = glint_field_series(middle - 0.5 * width, width);
        let far = glint_field_series(middle + 0.5 * width, width);
        return far / (far + near * elementary_exp(middle * width));
    }
    let near = gaussian_cdf(width - middle);
    let far = select(0.0, gaussian_cdf(-middle - width), has_end);
    return (gaussian_cdf(-middle) - far) / (near - far);
}

// Whether a bin is in the half farther from 0 after a number of splits.
fn glint_field_is_outer(axis: GlintFieldAxis, index: i32, split: i32) -> bool {
    let is_upper = split == 0 || ((index >> u32(axis.splits - split - 1)) & 1) != 0;
    return is_upper == (index >= 0);
}

// The two bins at a coordinate; `upper` is the weight of the second one: `Axis::bins`.
struct GlintFieldBins {
    index: vec2<i32>,
    mass: vec2<f32>,
    upper: f32,
}

fn glint_field_bins(axis: GlintFieldAxis, z: f32) -> GlintFieldBins {
    let own = glint_field_index(axis, z);
    let mass = glint_field_mass(axis, own);
    var bins = GlintFieldBins(vec2<i32>(own), vec2<f32>(mass), 0.0);
    let highest = glint_field_highest(axis);
    let low = f32(own) * axis.width;
    let below = own < -highest || (own < highest && z - low >= low + axis.width - z);
    let beside = select(own - 1, own + 1, below);
    if axis.splits == 0 || beside < -1 - highest || beside > highest || !(abs(z) < MATH_LARGEST) {
        return bins;
    }
    let border = select(low, low + axis.width, below);
    let other = glint_field_mass(axis, beside);
    let ramp = 0.25 * min(mass, other);
    let within = glint_field_interval(0.5 * (z + border), abs(z - border));
    if within < ramp {
        bins.index.y = beside;
        bins.mass.y = other;
        bins.upper = 0.5 - 0.5 * within / ramp;
    }
    return bins;
}

// The sum of four weights times the fractions of flakes in a bin. The flakes are `number` for each of
// four random words: `Flakes::fraction`.
fn glint_field_fraction(
    axis: GlintFieldAxis,
    weights: vec4<f32>,
    corners: vec4<u32>,
    number: f32,
    bin: vec2<i32>,
) -> f32 {
    var words = corners;
    var counts = vec4<f32>(number);
    for (var split = 0; split < axis.splits; split++) {
        for (var k = 0u; k < 2u; k++) {
            let index = select(bin.x, bin.y, k == 1u);
            let p = glint_field_outer(axis, split, index >> u32(axis.splits - split));
            let is_outer = glint_field_is_outer(axis, index, split);
            let outer = vec4<f32>(
                glint_field_binomial(counts.x, p, words.x),
                glint_field_binomial(counts.y, p, words.y),
                glint_field_binomial(counts.z, p, words.z),
                glint_field_binomial(counts.w, p, words.w),
            );
            counts = select(counts - outer, outer, is_outer);
            if counts.x + counts.y + counts.z + counts.w <= 0.0 {
                return 0.0;
            }
            words = integer_hash_further_words(words, select(1u, 2u, is_outer));
        }
    }
    return dot(weights, counts) / number;
}

// The corners of the tetrahedron of a lattice around a position in cells: `corners`.
struct GlintFieldCorners {
    weights: vec4<f32>,
    words: vec4<u32>,
}

fn glint_field_corners(field: GlintField, place: vec3<f32>, level: i32) -> GlintFieldCorners {
    let scaled = place / f32(1u << u32(level));
    let low = floor(scaled);
    let f = scaled - low;
    // The ranks of the axes, 0 for the largest fraction; earlier axes first.
    let rank = vec3<i32>(
        select(0, 1, f.y > f.x) + select(0, 1, f.z > f.x),
        select(0, 1, f.x >= f.y) + select(0, 1, f.z > f.y),
        select(0, 1, f.x >= f.z) + select(0, 1, f.y >= f.z),
    );
    let first = max(f.x, max(f.y, f.z));
    let third = min(f.x, min(f.y, f.z));
    let second = max(min(f.x, f.y), min(max(f.x, f.y), f.z));
    let base = vec3<i32>(low);
    let shift = vec3<u32>(u32(level));
    let one = vec3<i32>(1);
    return GlintFieldCorners(
        vec4<f32>(1.0 - first, first - second, second - third, third),
        vec4<u32>(
            glint_field_word(base << shift, field.key),
            glint_field_word((base + vec3<i32>(rank < vec3<i32>(1))) << shift, field.key),
            glint_field_word((base + vec3<i32>(rank < vec3<i32>(2))) << shift, field.key),
            glint_field_word((base + one) << shift, field.key),
        ),
    );
}

// The level of the lattice that a round pixel sees, and the weight of the next.
fn glint_field_level(field: GlintField, width: f32) -> vec2<f32> {
    return glint_field_logarithm(max(0.6324555 * width / field.spacing, 1.0));
}

// The fraction of the flakes of a round pixel in a bin of this mass. The flake at the center of the
// pixel has this `tilt`.
fn glint_field_fraction_at(
    field: GlintField,
    axis: GlintFieldAxis,
    place: vec3<f32>,
    level: vec2<f32>,
    tilt: vec2<f32>,
    bin: vec2<i32>,
    mass: f32,
) -> f32 {
    var sum = 0.0;
    for (var k = 0; k < 2; k++) {
        let share = select(1.0 - level.y, level.y, k == 1);
        let at = i32(level.x) + k;
        if share > 0.0 && at == 0 {
            let same = glint_field_index(axis, tilt.x) == bin.x && glint_field_index(axis, tilt.y) == bin.y;
            sum += select(0.0, share, same);
        }
        if share > 0.0 && at >= 14 {
            sum += share * mass;
        }
        if share > 0.0 && at > 0 && at < 14 {
            let corners = glint_field_corners(field, place, at);
            let size = f32(1u << u32(at));
            sum += share * glint_field_fraction(axis, corners.weights, corners.words, size * size, bin);
        }
    }
    return sum;
}

// The round pixels along the long axis of a pixel: the step between them and their width, and the
// ratio of the axes.
struct GlintFieldTaps {
    step: vec3<f32>,
    width: f32,
    ratio: f32,
}

fn glint_field_taps(pixel: PixelEllipse) -> GlintFieldTaps {
    let long = pixel.widths.x;
    let width = max(pixel.widths.y, long / 16.0);
    let ratio = long / width;
    let round = pixel.major.x == 0.0 && pixel.major.y == 0.0 && pixel.major.z == 0.0;
    if round || !(ratio > 1.0) || !direction_is_finite(pixel.major) {
        return GlintFieldTaps(vec3<f32>(0.0), long, 1.0);
    }
    return GlintFieldTaps(pixel.major / ratio, width, ratio);
}

// The weight of the k-th of these, of which that in the middle is 0.
fn glint_field_tap_weight(taps: GlintFieldTaps, k: i32) -> f32 {
    return clamp(0.5 * (taps.ratio + 1.0) - f32(abs(k)), 0.0, 1.0);
}

// The number of flakes within a pixel with these Gaussian coordinates, divided by its mean.
fn glint_field_relative_in(
    field: GlintField,
    axis: GlintFieldAxis,
    z: vec2<f32>,
    position: vec3<f32>,
    pixel: PixelEllipse,
) -> f32 {
    if axis.splits == 0 {
        return 1.0;
    }
    let x = glint_field_bins(axis, z.x);
    let y = glint_field_bins(axis, z.y);
    let taps = glint_field_taps(pixel);
    let level = glint_field_level(field, taps.width);
    var sum = 0.0;
    var total = 0.0;
    for (var k = -8; k <= 8; k++) {
        let tap = glint_field_tap_weight(taps, k);
        total += tap;
        let place = (position + f32(k) * taps.step) / field.spacing;
        if tap > 0.0 && !(level.x < 14.0 && glint_field_is_near(place)) {
            sum += tap;
            continue;
        }
        var tilt = vec2<f32>(0.0);
        if tap > 0.0 && level.x == 0.0 {
            tilt = glint_field_tilt(field, glint_field_nearest(field, place).cell);
        }
        for (var corner = 0u; corner < 4u; corner++) {
            let right = (corner & 1u) == 1u;
            let upper = corner > 1u;
            let weight = tap * select(1.0 - x.upper, x.upper, right) * select(1.0 - y.upper, y.upper, upper);
            if weight > 0.0 {
                let bin = vec2<i32>(select(x.index.x, x.index.y, right), select(y.index.x, y.index.y, upper));
                let mass = select(x.mass.x, x.mass.y, right) * select(y.mass.x, y.mass.y, upper);
                let share = glint_field_fraction_at(field, axis, place, level, tilt, bin, mass);
                sum += weight * share / max(mass, 1.1754944e-38);
            }
        }
    }
    return sum / total;
}

// The number of flakes within an elongated pixel that mirror a light of this width in Gaussian
// coordinates, divided by its mean: `GlintField::density_over` without the density. The width is
// `GlintField::light_width`, 0 for a point.
fn glint_field_relative_over(
    field: GlintField,
    z: vec2<f32>,
    light: f32,
    position: vec3<f32>,
    pixel: PixelEllipse,
) -> f32 {
    let joined = glint_field_logarithm(max(light / field.bin, 1.0));
    let fine = glint_field_axis(field.bin, i32(joined.x));
    let relative = glint_field_relative_in(field, fine, z, position, pixel);
    if joined.y <= 0.0 || fine.splits == 0 {
        return relative;
    }
    let coarse = glint_field_axis(field.bin, i32(joined.x) + 1);
    let wide = glint_field_relative_in(field, coarse, z, position, pixel);
    return relative + joined.y * (wide - relative);
}

// The same for a round pixel and a point light. Times the density of the half vector it is
// `GlintField::density`, for the coordinates `invert` of the half vector. It is 1 where single cells
// cannot be resolved, and in the far field.
fn glint_field_relative(field: GlintField, z: vec2<f32>, position: vec3<f32>, footprint: f32) -> f32 {
    let round = PixelEllipse(vec3<f32>(0.0), vec3<f32>(0.0), vec2<f32>(footprint));
    return glint_field_relative_over(field, z, 0.0, position, round);
}

// A coordinate of a bin, distributed by its weight: `Axis::sample`.
fn glint_field_sample_bin(axis: GlintFieldAxis, index: i32, u: f32) -> f32 {
    let highest = glint_field_highest(axis);
    let own = glint_field_mass(axis, index);
    var before = 0.0;
    if index > -1 - highest {
        before = 0.25 * min(own, glint_field_mass(axis, index - 1));
    }
    var after = 0.0;
    if index < highest {
        after = 0.25 * min(own, glint_field_mass(axis, index + 1));
    }
    var along = u * own;
    if along < before {
        along = before * (2.0 * sqrt(along / before) - 1.0);
    } else if own - along < after {
        along = own - after * (2.0 * sqrt((own - along) / after) - 1.0);
    }
    // From the nearer tail, whose digits are not lost.
    let from_zero = max(index, -1 - index);
    let beyond = select(0.0, gaussian_cdf(-f32(from_zero + 1) * axis.width), from_zero < highest);
    let tail = beyond + select(own - along, along, index < 0);
    let z = inverse_gaussian_cdf(clamp(tail, 1e-20, 0.99999994));
    return select(-z, z, index < 0);
}

// The Gaussian coordinates of a normal of the flakes within a pixel, from two uniform numbers in
// [0, 1): `GlintField::sample`. Their probability density is that of two Gaussian numbers times
// `glint_field_relative_over` for a point light.
fn glint_field_sample(field: GlintField, u: vec2<f32>, position: vec3<f32>, pixel: PixelEllipse) -> vec2<f32> {
    let taps = glint_field_taps(pixel);
    var total = 0.0;
    for (var k = -8; k <= 8; k++) {
        total += glint_field_tap_weight(taps, k);
    }
    let level = glint_field_level(field, taps.width);
    let axis = glint_field_axis(field.bin, 0);
    // The part in which the first number falls: a round pixel, a level, a corner.
    var left = u.x;
    var rest = 0.0;
    var word = 0u;
    var number = 0.0;
    var tilt = vec2<f32>(0.0);
    var is_smooth = true;
    for (var k = -8; k <= 8; k++) {
        let tap = glint_field_tap_weight(taps, k) / total;
        let place = (position + f32(k) * taps.step) / field.spacing;
        let is_counted = level.x < 14.0 && glint_field_is_near(place);
        if tap > 0.0 && !is_counted {
            if left >= 0.0 {
                is_smooth = true;
                rest = left / tap;
            }
            left -= tap;
        }
        for (var step = 0; step < 2 && tap > 0.0 && is_counted; step++) {
            let share = tap * select(1.0 - level.y, level.y, step == 1);
            let at = i32(level.x) + step;
            if share > 0.0 && at == 0 {
                if left >= 0.0 {
                    is_smooth = false;
                    number = 0.0;
                    tilt = glint_field_tilt(field, glint_field_nearest(field, place).cell);
                    rest = left / share;
                }
                left -= share;
            }
            if share > 0.0 && at >= 14 {
                if left >= 0.0 {
                    is_smooth = true;
                    rest = left / share;
                }
                left -= share;
            }
            if share > 0.0 && at > 0 && at < 14 {
                let corners = glint_field_corners(field, place, at);
                let size = f32(1u << u32(at));
                for (var corner = 0u; corner < 4u; corner++) {
                    let weight = share * glint_field_component(corners.weights, corner);
                    if left >= 0.0 && weight > 0.0 {
                        is_smooth = false;
                        number = size * size;
                        word = select(
                            select(corners.words.x, corners.words.y, corner == 1u),
                            select(corners.words.z, corners.words.w, corner == 3u),
                            corner > 1u,
                        );
                        rest = left / weight;
                    }
                    left -= weight;
                }
            }
        }
    }
    var v = vec2<f32>(clamp(rest, 0.0, 0.99999994), clamp(u.y, 0.0, 0.99999994));
    if is_smooth {
        return vec2<f32>(
            inverse_gaussian_cdf(max(v.x, 1e-8)),
            inverse_gaussian_cdf(max(v.y, 1e-8)),
        );
    }
    var bin = vec2<i32>(glint_field_index(axis, tilt.x), glint_field_index(axis, tilt.y));
    if number > 0.0 {
        bin = vec2<i32>(0);
        for (var split = 0; split < axis.splits; split++) {
            for (var k = 0u; k < 2u; k++) {
                let index = select(bin.x, bin.y, k == 1u);
                let outer = glint_field_binomial(number, glint_field_outer(axis, split, index), word);
                let share = outer / number;
                let at = select(v.x, v.y, k == 1u);
                let is_outer = at < share;
                let again = clamp(select((at - share) / (1.0 - share), at / share, is_outer), 0.0, 0.99999994);
                number = select(number - outer, outer, is_outer);
                word = integer_hash_further(word, select(1u, 2u, is_outer));
                var child = 2 * index + select(0, 1, is_outer == (index >= 0));
                if split == 0 {
                    child = select(-1, 0, is_outer);
                }
                bin = select(vec2<i32>(child, bin.y), vec2<i32>(bin.x, child), k == 1u);
                v = select(vec2<f32>(again, v.y), vec2<f32>(v.x, again), k == 1u);
            }
        }
    }
    return vec2<f32>(glint_field_sample_bin(axis, bin.x, v.x), glint_field_sample_bin(axis, bin.y, v.y));
}

// A component of four numbers.
fn glint_field_component(numbers: vec4<f32>, k: u32) -> f32 {
    return select(
        select(numbers.x, numbers.y, k == 1u), select(numbers.z, numbers.w, k == 3u), k > 1u,
    );
}
