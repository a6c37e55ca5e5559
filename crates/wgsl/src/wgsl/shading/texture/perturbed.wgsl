// Texture coordinates displaced by noise: `asperity_shading::texture::PerturbedTexture`.

// The texture coordinates of a pixel of this width, and the blur by the unresolved displacement.
struct PerturbedLookUp {
    uv: vec2<f32>,
    spread: vec2<f32>,
}

// The coordinates at a point: `PerturbedTexture::coordinates`.
fn perturbed_coordinates(texture: PerturbedTexture, p: vec3<f32>, uv: vec2<f32>) -> vec2<f32> {
    let q = p * texture.scale;
    let first = perlin_noise_3d(q, texture.keys.x).value;
    let second = perlin_noise_3d(q + vec3<f32>(1.5, 6.7, 3.4), texture.keys.y).value;
    return uv + texture.strength * vec2<f32>(first, second);
}

// The texture coordinates as resolved by a pixel: `PerturbedTexture::filtered`.
fn perturbed_look_up(texture: PerturbedTexture, p: vec3<f32>, uv: vec2<f32>, footprint: f32) -> PerturbedLookUp {
    let kept = footprint_kept(footprint, texture.scale);
    if kept >= 1.0 {
        return PerturbedLookUp(perturbed_coordinates(texture, p, uv), vec2<f32>(0.0));
    }
    var moved = uv;
    if kept > 0.0 {
        moved = uv + kept * (perturbed_coordinates(texture, p, uv) - uv);
    }
    let deviation = texture.deviation * sqrt(1.0 - kept * kept);
    return PerturbedLookUp(moved, abs(texture.strength) * deviation);
}
