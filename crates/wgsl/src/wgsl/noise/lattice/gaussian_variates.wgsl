// Gaussian variates of lattice points, `asperity_noise::GaussianNoise::variates`, four points at
// once.
//
// The table `gaussian_level` has 4096 levels, the last level again, and the lines of the tails, two
// numbers each.

const GAUSSIAN_TAIL: u32 = 0x00400000u;
const GAUSSIAN_LINES: u32 = 4097u;

fn gaussian_level_at(words: vec4<u32>, shift: u32) -> vec4<f32> {
    let i = (words >> vec4<u32>(shift)) & vec4<u32>(0xfffu);
    return vec4<f32>(gaussian_level(i.x), gaussian_level(i.y), gaussian_level(i.z), gaussian_level(i.w));
}

// Values N(0, 1) that use all bits of the words.
//
// Chords connect levels. Where a word is near 0 modulo 2^32 the value is on a line, one for every
// 32nd of a power of two.
fn gaussian_quantiles(words: vec4<u32>) -> vec4<f32> {
    let is_tail = (words + vec4<u32>(GAUSSIAN_TAIL)) < vec4<u32>(2u * GAUSSIAN_TAIL);
    let x = vec4<f32>(bitcast<vec4<i32>>((words + vec4<u32>(0x80000u)) | vec4<u32>(1u)));
    let bits = bitcast<vec4<u32>>(x) & vec4<u32>(0x7fffffffu);
    let line = GAUSSIAN_LINES + 2u * ((bits >> vec4<u32>(18u)) - vec4<u32>(4064u));
    let slice = words >> vec4<u32>(20u);
    // One by one, as GLSL ES 3.00 cannot select integer vectors.
    let i = vec4<u32>(
        select(slice.x, line.x, is_tail.x),
        select(slice.y, line.y, is_tail.y),
        select(slice.z, line.z, is_tail.z),
        select(slice.w, line.w, is_tail.w),
    );
    let j = i + vec4<u32>(1u);
    let a = vec4<f32>(gaussian_level(i.x), gaussian_level(i.y), gaussian_level(i.z), gaussian_level(i.w));
    let b = vec4<f32>(gaussian_level(j.x), gaussian_level(j.y), gaussian_level(j.z), gaussian_level(j.w));
    let chord = a + (b - a) * (vec4<f32>(words & vec4<u32>(0xfffffu)) * 9.536743e-7);
    let tail = a + b * bitcast<vec4<f32>>((bits & vec4<u32>(0x7fffffu)) | vec4<u32>(0x3f800000u));
    return select(chord, select(-tail, tail, x < vec4<f32>(0.0)), is_tail);
}

// Values and twice the gradients of the first channel.
fn gaussian_first_corners_2d(words: vec4<u32>) -> Columns {
    let word = integer_hash_multiplied(words, 0x846ca68bu);
    return Columns(gaussian_quantiles(words), gaussian_twice(word, 20u), gaussian_twice(word, 4u));
}

fn gaussian_first_corners_3d(words: vec4<u32>) -> Corners3d {
    let plane = gaussian_first_corners_2d(words);
    let z = gaussian_twice(integer_hash_multiplied(words, 0x9e3779b1u), 20u);
    return Corners3d(plane.value, plane.x, plane.y, z);
}

// Values and twice the gradients of the second channel.
fn gaussian_second_corners_2d(words: vec4<u32>) -> Columns {
    let word = integer_hash_multiplied(words, 0x2c1b3c6du);
    let values = gaussian_quantiles(integer_hash_multiplied(words, 0xc2b2ae3du));
    return Columns(values, gaussian_twice(word, 20u), gaussian_twice(word, 4u));
}

fn gaussian_second_corners_3d(words: vec4<u32>) -> Corners3d {
    let plane = gaussian_second_corners_2d(words);
    let z = gaussian_twice(integer_hash_multiplied(words, 0x297a2d39u), 20u);
    return Corners3d(plane.value, plane.x, plane.y, z);
}

fn gaussian_twice(words: vec4<u32>, shift: u32) -> vec4<f32> {
    let levels = gaussian_level_at(words, shift);
    return levels + levels;
}
