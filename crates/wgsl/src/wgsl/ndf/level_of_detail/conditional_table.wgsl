// Exact level of detail of any distribution by one lookup:
// `asperity_ndf_sampling::ConditionalTable`.

// A texture coordinate from a stretched coordinate of a half vector and its length plus height; 0
// for NaN.
fn conditional_table_coordinate(c: f32, sum: f32) -> f32 {
    if !(sum > 0.0 && abs(c) <= ELEMENTARY_LARGEST) {
        return 0.0;
    }
    if !(sum <= ELEMENTARY_LARGEST) {
        return 0.5;
    }
    return 0.5 * (c / sum) + 0.5;
}

// The texture coordinates from 0 to 1 of a half vector, for textures with hardware interpolation.
fn conditional_table_coordinates(stretch: vec2<f32>, h: vec3<f32>) -> vec2<f32> {
    let x = h.x / stretch.x;
    let y = h.y / stretch.y;
    let sum = sqrt(x * x + y * y + h.z * h.z) + select(0.0, h.z, h.z > 0.0);
    return vec2<f32>(conditional_table_coordinate(x, sum), conditional_table_coordinate(y, sum));
}

// p_s(h | z_b) in 1/sr from the entry of a half vector, its coordinates and the fourth root of its
// density.
fn conditional_table_weigh(entry: vec3<f32>, h: vec3<f32>, split: GaussianSplit) -> f32 {
    let density = (entry.z * entry.z) * (entry.z * entry.z);
    if !(h.z > 0.0 && density > 0.0) {
        return 0.0;
    }
    return gaussian_split_weigh(split, min(density, ELEMENTARY_LARGEST), entry.xy);
}

fn conditional_table_entry(entry: u32) -> vec3<f32> {
    let at = 3u * entry;
    return vec3<f32>(conditional_table_number(at), conditional_table_number(at + 1u), conditional_table_number(at + 2u));
}

// The entry interpolated between the four around a half vector: Gaussian coordinates and the fourth
// root of the density.
fn conditional_table_interpolated(h: vec3<f32>) -> vec3<f32> {
    let size = conditional_table_grid.size;
    if size < 2u {
        return conditional_table_entry(0u);
    }
    let last = f32(size) - 1.0;
    let coordinates = conditional_table_coordinates(conditional_table_grid.stretch, h);
    let x = min(max(coordinates.x * f32(size) - 0.5, 0.0), last);
    let y = min(max(coordinates.y * f32(size) - 0.5, 0.0), last);
    let column = min(u32(x), size - 2u);
    let row = min(u32(y), size - 2u);
    let right = x - f32(column);
    let up = y - f32(row);
    let below = row * size + column;
    let a = conditional_table_entry(below);
    let c = conditional_table_entry(below + size);
    let low = a + (conditional_table_entry(below + 1u) - a) * right;
    let high = c + (conditional_table_entry(below + size + 1u) - c) * right;
    return low + (high - low) * up;
}

// p_s(h | z_b) in 1/sr, the density of the unresolved part; 0 for h.z <= 0 and NaN.
fn conditional_table_residual_ndf(h: vec3<f32>, split: GaussianSplit) -> f32 {
    return conditional_table_weigh(conditional_table_interpolated(h), h, split);
}
