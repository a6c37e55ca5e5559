// Gas as a density in 3-D, shaped into steam: `asperity_shading::texture::Gas`, `Steam`.

// The density of a turbulence.
fn gas_of(gas: Gas, turbulence: f32) -> f32 {
    var t = math_clamped(turbulence, 1.0);
    if gas.has_veins != 0u {
        t = 0.5 + 0.5 * elementary_cos_sin_turns(0.5 * t).y;
    }
    let base = gas.max_density * t;
    let square = base * base;
    var power = 0.0;
    if gas.exponent == 2.0 {
        power = square;
    } else if gas.exponent == 3.0 {
        power = square * base;
    } else if gas.exponent == 4.0 {
        power = square * square;
    } else if gas.exponent == 8.0 {
        power = (square * square) * (square * square);
    } else if base > 0.0 {
        power = elementary_exp(gas.exponent * elementary_ln(base));
    }
    return min(power, MATH_LARGEST);
}

// The variance of the turbulence that a footprint removes.
fn gas_removed(gas: Gas, footprint: f32) -> f32 {
    let spectrum = fbm_spectrum_3d(gas.sum);
    var removed = 0.0;
    var total = 0.0;
    var amplitude = 1.0;
    var frequency = 1.0;
    for (var i = 0u; i < 16u; i++) {
        let weight = min(min(gas.octaves, spectrum.max_octaves) - f32(i), 1.0);
        if !(weight > 0.0) {
            break;
        }
        let kept = footprint_kept(footprint, frequency);
        let weighted = weight * amplitude;
        removed += weighted * weighted * (1.0 - kept * kept);
        total += weighted;
        amplitude *= spectrum.gain;
        frequency *= spectrum.lacunarity;
    }
    if !(total > 0.0) {
        return 0.0;
    }
    return removed * gas.variance / (total * total);
}

// The density at a point, filtered over a pixel of this width; unfiltered for a width of 0.
// `Gas::clamped_density`.
fn gas_density(gas: Gas, p: vec3<f32>, footprint: f32) -> f32 {
    let mean = perlin_fbm_3d(p, gas.octaves, footprint, gas.sum).value;
    let apart = sqrt(3.0 * gas_removed(gas, footprint));
    if !(apart > 0.0) {
        return gas_of(gas, mean);
    }
    let sides = gas_of(gas, max(mean - apart, 0.0)) + gas_of(gas, mean + apart);
    return 0.6666667 * gas_of(gas, mean) + sides / 6.0;
}

// The fraction of the density in a column of steam at a point: 1 above the middle of its ground,
// thinner upward and to the side.
fn gas_steam_share(center: vec3<f32>, radius: f32, height: f32, p: vec3<f32>) -> f32 {
    let from_center = p - center;
    let d = sqrt(from_center.x * from_center.x + from_center.y * from_center.y) / radius;
    let z = from_center.z / height;
    if !(d < 1.0 && z >= 0.0 && z <= 1.0) {
        return 0.0;
    }
    return (1.0 - d * d * (3.0 - 2.0 * d)) * (1.0 - z);
}
