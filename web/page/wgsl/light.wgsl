// Environment light: a map of 256 by 128 texels for reflections, sixteen lamps for bright areas,
// harmonics for the rest.

struct LightLamp {
    direction: vec3<f32>,
    padding: f32,
    // On a surface perpendicular to the light.
    irradiance: vec3<f32>,
    more: f32,
}

struct Light {
    // Radiance of everything except the lamps, in spherical harmonics of the first three bands.
    harmonics: array<vec4<f32>, 9>,
    lamps: array<LightLamp, 16>,
}

// A texel: nine bits per color over one exponent.
fn light_texel(x: i32, y: i32) -> vec3<f32> {
    let word = light_word(u32(y * 256 + (x & 255)));
    let color = vec3<f32>(vec3<u32>(word & 511u, (word >> 9u) & 511u, (word >> 18u) & 511u));
    return color * exp2(f32(word >> 27u) - 24.0);
}

// Radiance from a direction, z up.
fn light_seen(direction: vec3<f32>) -> vec3<f32> {
    let sine = clamp(direction.z, -1.0, 1.0);
    var turn = 0.0;
    if abs(direction.x) + abs(direction.y) > 1e-6 {
        turn = atan2(direction.y, direction.x) * 0.15915494;
    }
    let at = vec2<f32>(turn * 256.0, acos(sine) * 0.31830987 * 128.0) - 0.5;
    let corner = floor(at);
    let part = at - corner;
    let x = i32(corner.x);
    let low = clamp(i32(corner.y), 0, 127);
    let high = min(low + 1, 127);
    let above = mix(light_texel(x, low), light_texel(x + 1, low), part.x);
    return mix(above, mix(light_texel(x, high), light_texel(x + 1, high), part.x), part.y);
}

// The mean radiance about a direction. `bands` are the factors of the three bands, (1, 2/3, 1/4)
// for a diffuse surface.
fn light_mean(n: vec3<f32>, bands: vec3<f32>) -> vec3<f32> {
    let first = light.harmonics[1].xyz * n.y + light.harmonics[2].xyz * n.z + light.harmonics[3].xyz * n.x;
    let second = light.harmonics[4].xyz * (1.0925484 * n.x * n.y)
        + light.harmonics[5].xyz * (1.0925484 * n.y * n.z)
        + light.harmonics[6].xyz * (0.31539157 * (3.0 * n.z * n.z - 1.0))
        + light.harmonics[7].xyz * (1.0925484 * n.x * n.z)
        + light.harmonics[8].xyz * (0.54627422 * (n.x * n.x - n.y * n.y));
    let sum = light.harmonics[0].xyz * (0.2820948 * bands.x) + first * (0.4886025 * bands.y) + second * bands.z;
    return max(sum, vec3<f32>(0.0));
}

// The mean radiance over a lobe of Beckmann's alpha about the mirror direction.
fn light_glossy(direction: vec3<f32>, alpha: f32) -> vec3<f32> {
    let spread = alpha * alpha;
    return light_mean(direction, vec3<f32>(1.0, exp(-spread), exp(-3.0 * spread)));
}

fn light_diffuse(normal: vec3<f32>) -> vec3<f32> {
    return light_mean(normal, vec3<f32>(1.0, 0.6666667, 0.25));
}
