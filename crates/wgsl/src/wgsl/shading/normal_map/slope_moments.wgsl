// Mean and covariance of slopes within a pixel: `asperity_shading::normal_map::SlopeMoments`.

struct SlopeMoments {
    mean: vec2<f32>,
    // xx, xy, yy.
    covariance: vec3<f32>,
}

// The mixture with another part of this weight.
fn slope_moments_joined(moments: SlopeMoments, other: SlopeMoments, share: f32) -> SlopeMoments {
    let apart = other.mean - moments.mean;
    let outer = vec3<f32>(apart.x * apart.x, apart.x * apart.y, apart.y * apart.y);
    let rest = 1.0 - share;
    return SlopeMoments(
        moments.mean + share * apart,
        rest * moments.covariance + share * (other.covariance + rest * outer),
    );
}

// The unit normal of the mean slope, whose square is finite.
fn slope_moments_normal(moments: SlopeMoments) -> vec3<f32> {
    let normal = vec3<f32>(moments.mean, 1.0);
    let square = dot(normal, normal);
    return select(vec3<f32>(0.0, 0.0, 1.0), normal / sqrt(square), math_is_finite(square));
}

// Approximately the mean of the unit normals of these slopes, for diffuse reflection. Its length is
// at most 1.
fn slope_moments_mean_normal(moments: SlopeMoments) -> vec3<f32> {
    let normal = vec3<f32>(moments.mean, 1.0);
    let square = dot(normal, normal) + math_clamped(moments.covariance.x + moments.covariance.z, MATH_LARGEST);
    return select(vec3<f32>(0.0, 0.0, 1.0), normal / sqrt(square), math_is_finite(square));
}

// Facets of the map with finer Beckmann bumps of roughness alpha, of which the pixel resolves the
// split: `SlopeMoments::detailed`.
fn slope_moments_detailed(moments: SlopeMoments, alpha: vec2<f32>, split: GaussianSplit) -> OffsetBeckmann {
    let seen = offset_beckmann_conditional(alpha, split);
    let fine = offset_beckmann_covariance(seen);
    let covariance = vec3<f32>(moments.covariance.x + fine.x, moments.covariance.y, moments.covariance.z + fine.z);
    return offset_beckmann_of(moments.mean + seen.mean, covariance, seen);
}
