// Numbers and directions from the bits of words: `asperity_noise::PerlinClassic::gradient`.

// A number uniform in (-1, 1), a multiple of 2^-23 plus half a step.
fn variate_uniform(word: u32) -> f32 {
    return f32(word >> 8u) * 1.1920929e-7 + -0.99999994;
}

fn variates_uniform(words: vec4<u32>) -> vec4<f32> {
    return vec4<f32>(words >> vec4<u32>(8u)) * 1.1920929e-7 + -0.99999994;
}

struct VariateDirections2d {
    x: vec4<f32>,
    y: vec4<f32>,
}

struct VariateDirections3d {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
}

// Cosine and sine of a quarter turn selected by the upper two bits, plus `x` quarter turns in
// [-1/2, 1/2].
fn variate_turns(words: vec4<u32>, x: vec4<f32>) -> VariateDirections2d {
    let y = x * x;
    let sine = x * (1.5707964 + y * (-0.64596294 + y * (0.0796759 + y * -0.00459229)));
    let cosine = 1.0 + y * (-1.233697 + y * (0.25359864 + y * -0.02040835));
    let even = (words & vec4<u32>(0x40000000u)) == vec4<u32>(0u);
    let top = vec4<u32>(0x80000000u);
    let a = bitcast<vec4<u32>>(select(sine, cosine, even)) ^ ((words ^ (words << vec4<u32>(1u))) & top);
    let b = bitcast<vec4<u32>>(select(cosine, sine, even)) ^ (words & top);
    return VariateDirections2d(bitcast<vec4<f32>>(a), bitcast<vec4<f32>>(b));
}

// Directions of a length, uniform on the circle.
fn variate_directions_2d(words: vec4<u32>, length: f32) -> VariateDirections2d {
    let fractions = (words >> vec4<u32>(6u)) & vec4<u32>(0xffffffu);
    let turns = variate_turns(words, vec4<f32>(fractions) * 5.9604645e-8 + -0.49999997);
    return VariateDirections2d(turns.x * length, turns.y * length);
}

// Directions of a length, uniform on the sphere.
fn variate_directions_3d(words: vec4<u32>, length: f32) -> VariateDirections3d {
    let u = vec4<f32>(words & vec4<u32>(0xffffu));
    let z = 0.99998474 - u * 3.0517578e-5;
    let r = length * sqrt(1.0 - z * z);
    let fractions = (words >> vec4<u32>(16u)) & vec4<u32>(0x3fffu);
    let turns = variate_turns(words, vec4<f32>(fractions) * 6.1035156e-5 + -0.49996948);
    return VariateDirections3d(turns.x * r, turns.y * r, z * length);
}
