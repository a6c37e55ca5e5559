// Values of a fractal interpolation function on equally spaced knots from its table:
// `asperity_fif::Table32::value`.
//
//   f(t) = start + rise t + sum of W_k P_e(u) + W_K middle      e, u: digits of t and what is left of it
//
// The rows of all functions are in `fif_rows`, four numbers each: a, and the powers of P in units
// of 2^-24.

// A row: a, c_0, c_1, c_2.
fn fif_table_row(table: FifTable, digit: u32) -> vec4<f32> {
    let i = table.first + 4u * digit;
    return vec4<f32>(fif_rows(i), fif_rows(i + 1u), fif_rows(i + 2u), fif_rows(i + 3u));
}

// The first 64 fractional bits of t in (0, 1), the upper word first.
fn fif_table_fraction(t: f32) -> vec2<u32> {
    let bits = bitcast<u32>(t);
    let mantissa = (bits << 8u) | 0x80000000u;
    let shift = 126u - (bits >> 23u);
    if shift == 0u {
        return vec2<u32>(mantissa, 0u);
    }
    if shift < 32u {
        return vec2<u32>(mantissa >> shift, mantissa << (32u - shift));
    }
    return vec2<u32>(0u, select(0u, mantissa >> (shift & 31u), shift < 64u));
}

// A word times a radix below 2^16: the upper word, then the lower word.
fn fif_table_product(word: u32, radix: u32) -> vec2<u32> {
    let low = (word & 0xffffu) * radix;
    let high = (word >> 16u) * radix;
    let sum = low + (high << 16u);
    return vec2<u32>((high >> 16u) + select(0u, 1u, sum < low), sum);
}

// The next digit of a fraction, then the remainder.
fn fif_table_digit(rest: vec2<u32>, radix: u32) -> vec3<u32> {
    let upper = fif_table_product(rest.x, radix);
    let lower = fif_table_product(rest.y, radix);
    let sum = upper.y + lower.x;
    return vec3<u32>(upper.x + select(0u, 1u, sum < lower.x), sum, lower.y);
}

// f(x), with the bits of `asperity_fif::Table32::value`. Points outside the domain are clamped to
// it, and NaN is returned unchanged. Closer to the left end than 2^-40 of the domain, 64 bits do
// not hold every bit of a position. The value is then the value at a position within 2^-64.
fn fif_table_value(table: FifTable, x: f32) -> f32 {
    if !fif_is_number(x) {
        return x;
    }
    let t = (x - table.origin) * table.per_width;
    if !(t > 0.0) {
        return table.start;
    }
    if !(t < 1.0) {
        return table.last;
    }
    var rest = fif_table_fraction(t);
    var sum = table.start + table.rise * t;
    var weight = 1.0;
    for (var k = 0u; k < table.steps; k++) {
        let next = fif_table_digit(rest, table.radix);
        rest = next.yz;
        let row = fif_table_row(table, next.x);
        // 24 bits, which are exact as a float.
        let s = f32(rest.x >> 8u);
        sum += weight * ((row.w * s + row.z) * s + row.y);
        if (rest.x | rest.y) == 0u {
            // The remaining terms are 0.
            return sum;
        }
        weight *= row.x;
    }
    return sum + weight * table.middle;
}
