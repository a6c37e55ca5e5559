// Value noise through the 4^n lattice points around a point, `asperity_noise::ValueCatmullRom`.
// Values are in [-1, 1].
//
// Numbers are blended along all axes but the first, which gives four columns, one per lane. A cubic
// interpolates between them.

const VALUE_CATMULL_ROM_SCALE: vec2<f32> = vec2<f32>(0.6399987, 0.511999);
const VALUE_CATMULL_ROM_STEPS: vec4<i32> = vec4<i32>(-1, 0, 1, 2);

// The weights of the four points around t.
fn value_catmull_rom_weights(t: f32) -> vec4<f32> {
    return vec4<f32>(
        t * (t * (1.0 - 0.5 * t) - 0.5),
        1.0 + t * t * (1.5 * t - 2.5),
        t * (t * (2.0 - 1.5 * t) + 0.5),
        t * t * (0.5 * t - 0.5),
    );
}

fn value_catmull_rom_slopes(t: f32) -> vec4<f32> {
    return vec4<f32>(
        t * (2.0 - 1.5 * t) - 0.5,
        t * (4.5 * t - 5.0),
        t * (4.0 - 4.5 * t) + 0.5,
        t * (1.5 * t - 1.0),
    );
}

// The coefficients of the cubic through the inner two of four columns, the constant first.
fn value_catmull_rom_cubic(c: vec4<f32>) -> vec4<f32> {
    let outer = c.w - c.x;
    let inner = c.z - c.y;
    let slope = 0.5 * (c.z - c.x);
    let third = 0.5 * outer - 1.5 * inner;
    return vec4<f32>(c.y, slope, (inner - slope) - third, third);
}

fn value_catmull_rom_at(cubic: vec4<f32>, t: f32) -> f32 {
    return cubic.x + t * (cubic.y + t * (cubic.z + t * cubic.w));
}

fn value_catmull_rom_slope_at(cubic: vec4<f32>, t: f32) -> f32 {
    return cubic.y + t * (2.0 * cubic.z + t * (3.0 * cubic.w));
}

fn value_catmull_rom_numbers(terms: vec4<u32>, scale: f32, key: u32) -> vec4<f32> {
    return variates_uniform(integer_hash_words(terms, key)) * scale;
}

// The noise at a position in [0, 1]^2 of a cell.
fn value_catmull_rom_in_cell_2d(cell: vec2<i32>, t: vec2<f32>, key: u32) -> Sample2d {
    let xs = integer_hash_terms(0u, vec4<i32>(cell.x) + VALUE_CATMULL_ROM_STEPS);
    let ys = integer_hash_terms(1u, vec4<i32>(cell.y) + VALUE_CATMULL_ROM_STEPS);
    let w = value_catmull_rom_weights(t.y);
    let slope = value_catmull_rom_slopes(t.y);
    var value = vec4<f32>(0.0);
    var dy = vec4<f32>(0.0);
    for (var j = 0u; j < 4u; j++) {
        let numbers = value_catmull_rom_numbers(xs ^ vec4<u32>(ys[j]), VALUE_CATMULL_ROM_SCALE.x, key);
        value += numbers * w[j];
        dy += numbers * slope[j];
    }
    let cubic = value_catmull_rom_cubic(value);
    return Sample2d(
        value_catmull_rom_at(cubic, t.x),
        vec2<f32>(
            value_catmull_rom_slope_at(cubic, t.x),
            value_catmull_rom_at(value_catmull_rom_cubic(dy), t.x),
        ),
    );
}

// The noise at a position in [0, 1]^3 of a cell.
fn value_catmull_rom_in_cell_3d(cell: vec3<i32>, t: vec3<f32>, key: u32) -> Sample3d {
    let xs = integer_hash_terms(0u, vec4<i32>(cell.x) + VALUE_CATMULL_ROM_STEPS);
    let ys = integer_hash_terms(1u, vec4<i32>(cell.y) + VALUE_CATMULL_ROM_STEPS);
    let zs = integer_hash_terms(2u, vec4<i32>(cell.z) + VALUE_CATMULL_ROM_STEPS);
    let w_y = value_catmull_rom_weights(t.y);
    let slope_y = value_catmull_rom_slopes(t.y);
    let w_z = value_catmull_rom_weights(t.z);
    let slope_z = value_catmull_rom_slopes(t.z);
    var value = vec4<f32>(0.0);
    var dy = vec4<f32>(0.0);
    var dz = vec4<f32>(0.0);
    for (var k = 0u; k < 4u; k++) {
        var row = vec4<f32>(0.0);
        var row_dy = vec4<f32>(0.0);
        for (var j = 0u; j < 4u; j++) {
            let numbers = value_catmull_rom_numbers(xs ^ vec4<u32>(ys[j] ^ zs[k]), VALUE_CATMULL_ROM_SCALE.y, key);
            row += numbers * w_y[j];
            row_dy += numbers * slope_y[j];
        }
        value += row * w_z[k];
        dy += row_dy * w_z[k];
        dz += row * slope_z[k];
    }
    let cubic = value_catmull_rom_cubic(value);
    return Sample3d(
        value_catmull_rom_at(cubic, t.x),
        vec3<f32>(
            value_catmull_rom_slope_at(cubic, t.x),
            value_catmull_rom_at(value_catmull_rom_cubic(dy), t.x),
            value_catmull_rom_at(value_catmull_rom_cubic(dz), t.x),
        ),
    );
}

// The noise at any point; 0 if a coordinate is not finite.
fn value_catmull_rom_noise_2d(p: vec2<f32>, key: u32) -> Sample2d {
    let at = cell_place_2d(p);
    return sample_known_2d(value_catmull_rom_in_cell_2d(at.cell, at.place, key), at.known);
}

fn value_catmull_rom_noise_3d(p: vec3<f32>, key: u32) -> Sample3d {
    let at = cell_place_3d(p);
    return sample_known_3d(value_catmull_rom_in_cell_3d(at.cell, at.place, key), at.known);
}
