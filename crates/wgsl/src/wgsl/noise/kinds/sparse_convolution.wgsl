// Sparse convolution noise, `asperity_noise::SparseConvolution`: impulses of random weight at random places,
// one to four per cell, convolved with (1 - r^2)^3. Mean 0 and variance 1 at every point.

// By the number of impulses.
const SPARSE_AMPLITUDE_2D: vec4<f32> = vec4<f32>(2.5854415, 1.8281832, 1.4927053, 1.2927208);
const SPARSE_AMPLITUDE_3D: vec4<f32> = vec4<f32>(3.2406268, 2.291469, 1.8709767, 1.6203134);

// Places in a cell from the halves of a word.
fn sparse_convolution_places(word: u32) -> vec2<f32> {
    return (vec2<f32>(f32(word >> 16u), f32(word & 0xffffu)) + 0.5) * 1.5258789e-5;
}

// The noise at a position in [0, 1]^2 of a cell.
fn sparse_convolution_in_cell_2d(cell: vec2<i32>, t: vec2<f32>, impulses: u32, key: u32) -> Sample2d {
    let count = clamp(impulses, 1u, 4u);
    let amplitude = SPARSE_AMPLITUDE_2D[count - 1u];
    let xs = integer_hash_terms(0u, vec4<i32>(cell.x) + vec4<i32>(-1, 0, 1, 2));
    let ys = integer_hash_terms(1u, vec4<i32>(cell.y) + vec4<i32>(-1, 0, 1, 2));
    var value = 0.0;
    var gradient = vec2<f32>(0.0);
    for (var i = 0u; i < 9u; i++) {
        let offset = vec2<f32>(f32(i / 3u), f32(i % 3u)) - 1.0;
        var word = integer_hash_word(xs[i / 3u] ^ ys[i % 3u], key);
        for (var k = 0u; k < count; k++) {
            let d = t - (offset + sparse_convolution_places(word));
            let reach = 1.0 - (d.y * d.y + d.x * d.x);
            if reach > 0.0 {
                let weight = variate_uniform(integer_hash_further(word, 1u)) * amplitude;
                let pull = weight * (reach * reach);
                value += pull * reach;
                gradient += (-6.0 * pull) * d;
            }
            word = integer_hash_further(word, 3u);
        }
    }
    return Sample2d(value, gradient);
}

// The noise at a position in [0, 1]^3 of a cell.
fn sparse_convolution_in_cell_3d(cell: vec3<i32>, t: vec3<f32>, impulses: u32, key: u32) -> Sample3d {
    let count = clamp(impulses, 1u, 4u);
    let amplitude = SPARSE_AMPLITUDE_3D[count - 1u];
    let xs = integer_hash_terms(0u, vec4<i32>(cell.x) + vec4<i32>(-1, 0, 1, 2));
    let ys = integer_hash_terms(1u, vec4<i32>(cell.y) + vec4<i32>(-1, 0, 1, 2));
    let zs = integer_hash_terms(2u, vec4<i32>(cell.z) + vec4<i32>(-1, 0, 1, 2));
    var value = 0.0;
    var gradient = vec3<f32>(0.0);
    for (var i = 0u; i < 27u; i++) {
        let step = vec3<u32>(i / 9u, i % 3u, (i / 3u) % 3u);
        let offset = vec3<f32>(step) - 1.0;
        var word = integer_hash_word(xs[step.x] ^ ys[step.y] ^ zs[step.z], key);
        for (var k = 0u; k < count; k++) {
            let second = integer_hash_further(word, 1u);
            let d = t - (offset + vec3<f32>(sparse_convolution_places(word), sparse_convolution_places(second).x));
            let reach = 1.0 - ((d.y * d.y + d.z * d.z) + d.x * d.x);
            if reach > 0.0 {
                let weight = variate_uniform(integer_hash_further(word, 2u)) * amplitude;
                let pull = weight * (reach * reach);
                value += pull * reach;
                gradient += (-6.0 * pull) * d;
            }
            word = integer_hash_further(word, 3u);
        }
    }
    return Sample3d(value, gradient);
}

// The noise at any point, with 1 to 4 impulses per cell; 0 if a coordinate is not finite.
fn sparse_convolution_noise_2d(p: vec2<f32>, impulses: u32, key: u32) -> Sample2d {
    let at = cell_place_2d(p);
    return sample_known_2d(sparse_convolution_in_cell_2d(at.cell, at.place, impulses, key), at.known);
}

fn sparse_convolution_noise_3d(p: vec3<f32>, impulses: u32, key: u32) -> Sample3d {
    let at = cell_place_3d(p);
    return sample_known_3d(sparse_convolution_in_cell_3d(at.cell, at.place, impulses, key), at.known);
}
