// Value and gradient of a noise.

struct Sample2d {
    value: f32,
    gradient: vec2<f32>,
}

struct Sample3d {
    value: f32,
    gradient: vec3<f32>,
}

struct Sample4d {
    value: f32,
    gradient: vec4<f32>,
}

// The sample if it is known, otherwise 0.
fn sample_known_2d(sample: Sample2d, known: bool) -> Sample2d {
    if known {
        return sample;
    }
    return Sample2d(0.0, vec2<f32>(0.0));
}

fn sample_known_3d(sample: Sample3d, known: bool) -> Sample3d {
    if known {
        return sample;
    }
    return Sample3d(0.0, vec3<f32>(0.0));
}

fn sample_known_4d(sample: Sample4d, known: bool) -> Sample4d {
    if known {
        return sample;
    }
    return Sample4d(0.0, vec4<f32>(0.0));
}
