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

// A number in (0, 1).
fn glint_field_chance(word: u32) -> f32 {
    return (f32(word) + 0.5) / 4294967296.0;
}

// The number of flakes in a cell of a level.
fn glint_field_flakes(level: i32) -> f32 {
    let size = f32(1u << u32(level));
    return size * size;
}

// A binomial number of successes of n trials with probability q, from a uniform number in (0, 1):
// `binomial`.
fn glint_field_binomial(n: f32, q: f32, chance: f32) -> f32 {
    let mean = n * q;
    if mean > 16.0 {
        let deviation = sqrt(mean * (1.0 - q));
        let z = inverse_gaussian_cdf(clamp(chance, 2.3283064e-10, 0.99999994));
        let most = min(mean / deviation, 4.0);
        return mean + deviation * clamp(z, -most, most);
    }
    let log = elementary_ln_1p(-q);
    let t = -(n * log);
    // The probability of more than k, which preserves the digits of small probabilities.
    var above = t * elementary_one_minus_exp_ratio(t, elementary_exp(-0.5 * t));
    var exactly = mean * elementary_exp((n - 1.0) * log);
    var k = 0.0;
    while chance < above && k < 64.0 {
        k += 1.0;
        above -= exactly;
        exactly *= (n - k) / (k + 1.0) * q / (1.0 - q);
    }
    return k;
}

// The number of flakes in one of four quarters, given `count` of n in a bin: `quarter`.
fn glint_field_quarter(count: f32, n: f32, word: u32) -> f32 {
    let mean = 0.25 * count;
    if mean > 16.0 {
        let bytes = (word & 255u) + ((word >> 8u) & 255u) + ((word >> 16u) & 255u) + (word >> 24u);
        let deviation = sqrt(max(0.75 * mean * (1.0 - count / n), 0.0)) / 147.801;
        return mean + deviation * (f32(bytes) - 510.0);
    }
    // Twelve bits for rounding, twenty for the deviation.
    let whole = floor(count + (f32(word & 0xfffu) + 0.5) / 4096.0);
    if !(whole > 0.0) {
        return 0.0;
    }
    return glint_field_binomial(whole, 0.25, (f32(word >> 12u) + 0.5) / 1048576.0);
}

// The probability that a standard Gaussian number is between k and k + 1 widths: `mass`.
fn glint_field_mass(k: f32, width: f32) -> f32 {
    let middle = (k + 0.5) * width;
    if width * (abs(middle) + 2.0) <= 1.0 {
        let m = middle * middle;
        let w = width * width * 0.25;
        let fourth = (m - 6.0) * m + 3.0;
        let sixth = ((m - 15.0) * m + 45.0) * m - 15.0;
        let series = 1.0 + w * ((m - 1.0) / 6.0 + w * (fourth / 120.0 + w * (sixth / 5040.0)));
        return width * 0.3989423 * elementary_exp(-0.5 * m) * series;
    }
    let side = select(-1.0, 1.0, k < 0.0);
    return abs(gaussian_cdf(side * (k + 1.0) * width) - gaussian_cdf(side * k * width));
}

// The exponent of a number above 0.
fn glint_field_exponent(x: f32) -> i32 {
    return i32(bitcast<u32>(x) >> 23u) - 127;
}

// The count of a bin divided by its mean, in the cells of this level and of the next, around the
// cell of a single flake: `relative_counts`.
fn glint_field_counts(key: u32, base: vec3<i32>, bin: vec2<i32>, q: f32, level: i32) -> vec2<f32> {
    let seed = integer_hash_word(integer_hash_term(0u, bin.x) ^ integer_hash_term(1u, bin.y), key);
    // Starts at a level where the count is nearly certain.
    let start = clamp((glint_field_exponent(256.0 / q) >> 1u) + 1, level, 14);
    let first = glint_field_word(base >> vec3<u32>(u32(start)), lattice_key(seed + u32(start)));
    var count = glint_field_binomial(glint_field_flakes(start), q, glint_field_chance(first));
    var coarse = 0.0;
    if start == level {
        let next = glint_field_word(base >> vec3<u32>(u32(level + 1)), lattice_key(seed + u32(level + 1)));
        let flakes = glint_field_flakes(level + 1);
        coarse = glint_field_binomial(flakes, q, glint_field_chance(next)) / (flakes * q);
    }
    for (var finer = start - 1; finer >= level; finer--) {
        let flakes = glint_field_flakes(finer + 1);
        coarse = count / (flakes * q);
        if count <= 0.0 {
            break;
        }
        let word = glint_field_word(base >> vec3<u32>(u32(finer)), lattice_key(seed + u32(finer)));
        count = glint_field_quarter(count, flakes, word);
    }
    return vec2<f32>(count / (glint_field_flakes(level) * q), coarse);
}

// Flakes around the Gaussian coordinates of a half vector: `Bins`.
struct GlintFieldBins {
    z: vec2<f32>,
    width: f32,
    // The key of their counts.
    key: u32,
}

// Bins that are 2^level times as wide as those of point lights.
fn glint_field_bins(field: GlintField, z: vec2<f32>, level: u32) -> GlintFieldBins {
    if level == 0u {
        return GlintFieldBins(z, field.bin, field.key);
    }
    let bounded = min(level, 16u);
    let seed = integer_hash_word(integer_hash_term(0u, i32(bounded)), field.key);
    return GlintFieldBins(z, field.bin * f32(1u << bounded), lattice_key(seed));
}

// The number of flakes within a round pixel in these bins, divided by its mean.
fn glint_field_relative_at(field: GlintField, bins: GlintFieldBins, position: vec3<f32>, footprint: f32) -> f32 {
    let place = position / field.spacing;
    let ratio = max(footprint / field.spacing, 1.0);
    if !(ratio < 16384.0 && glint_field_is_near(place)) {
        return 1.0;
    }
    // Level and weight of the next level, from the logarithm of the width.
    let level = glint_field_exponent(ratio);
    let mantissa = bitcast<f32>((bitcast<u32>(ratio) & 0x7fffffu) | 0x3f800000u);
    let upper_share = elementary_ln(mantissa) * 1.442695;
    let base = vec3<i32>(floor(place));
    var own = vec2<i32>(0);
    if level == 0 {
        let tilt = glint_field_tilt(field, glint_field_nearest(field, place).cell);
        own = vec2<i32>(floor(tilt / bins.width));
    }
    let at = bins.z / bins.width - 0.5;
    let low = floor(at);
    let upper = at - low;
    var sum = 0.0;
    for (var k = 0u; k < 4u; k++) {
        let by = vec2<f32>(f32(k >> 1u), f32(k & 1u));
        let q = glint_field_mass(low.x + by.x, bins.width) * glint_field_mass(low.y + by.y, bins.width);
        let weight = select(1.0 - upper.x, upper.x, k > 1u) * select(1.0 - upper.y, upper.y, (k & 1u) == 1u);
        let bin = vec2<i32>(low) + vec2<i32>(by);
        // A bin that never contains a flake is replaced by its mean.
        var relative = 1.0;
        if q > 1e-25 {
            var counts = vec2<f32>(0.0);
            if level > 0 || upper_share > 0.0 {
                counts = glint_field_counts(bins.key, base, bin, q, level);
            }
            if level == 0 {
                counts.x = select(0.0, 1.0 / q, own.x == bin.x && own.y == bin.y);
            }
            relative = counts.x + upper_share * (counts.y - counts.x);
        }
        sum += weight * relative;
    }
    return sum;
}

// The number of flakes within a pixel with these Gaussian coordinates, divided by its mean. Times
// the density of the half vector it is `GlintField::density`, for the coordinates `invert` of
// the half vector. It is 1 where single cells cannot be resolved, and in the far field.
fn glint_field_relative(field: GlintField, z: vec2<f32>, position: vec3<f32>, footprint: f32) -> f32 {
    return glint_field_relative_at(field, glint_field_bins(field, z, 0u), position, footprint);
}

// The mean over round pixels along the long axis of a pixel.
fn glint_field_relative_along(
    field: GlintField,
    bins: GlintFieldBins,
    position: vec3<f32>,
    pixel: PixelEllipse,
) -> f32 {
    let long = pixel.widths.x;
    let width = max(pixel.widths.y, long / 16.0);
    let ratio = long / width;
    let round = pixel.major.x == 0.0 && pixel.major.y == 0.0 && pixel.major.z == 0.0;
    if round || !(ratio > 1.0) || !direction_is_finite(pixel.major) {
        return glint_field_relative_at(field, bins, position, long);
    }
    let step = pixel.major / ratio;
    var sum = 0.0;
    var total = 0.0;
    for (var k = -8; k <= 8; k++) {
        let weight = min(0.5 * (ratio + 1.0) - f32(abs(k)), 1.0);
        if weight > 0.0 {
            sum += weight * glint_field_relative_at(field, bins, position + f32(k) * step, width);
            total += weight;
        }
    }
    return sum / total;
}

// The number of flakes within an elongated pixel that mirror a light of this width in Gaussian
// coordinates, 0 for a point, divided by its mean: `GlintField::density_over` without the density.
fn glint_field_relative_over(
    field: GlintField,
    z: vec2<f32>,
    light: f32,
    position: vec3<f32>,
    pixel: PixelEllipse,
) -> f32 {
    let ratio = clamp(light / field.bin, 1.0, 2.0 / field.bin);
    let level = glint_field_exponent(ratio);
    let mantissa = bitcast<f32>((bitcast<u32>(ratio) & 0x7fffffu) | 0x3f800000u);
    let upper_share = elementary_ln(mantissa) * 1.442695;
    let fine = glint_field_relative_along(field, glint_field_bins(field, z, u32(level)), position, pixel);
    if upper_share <= 0.0 {
        return fine;
    }
    let wide = glint_field_relative_along(field, glint_field_bins(field, z, u32(level + 1)), position, pixel);
    return fine + upper_share * (wide - fine);
}
