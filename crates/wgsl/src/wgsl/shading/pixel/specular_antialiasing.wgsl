// Specular anti-aliasing, roughness for the normals that a pixel averages:
// `asperity_shading::pixel::SpecularAntialiasing`.

// The variance of the Gaussian pixel filter in square pixels, 1/(2 pi), and the maximum of the
// added alpha squared.
const SPECULAR_ANTIALIASING_VARIANCE: f32 = 0.15915494;
const SPECULAR_ANTIALIASING_MAX_ALPHA_SQUARED: f32 = 0.18;

// The covariance (xx, xy, yy) of the slopes that the pixel averages, from the change of the shading
// normal per pixel in its tangent frame: `dpdx` and `dpdy`.
fn specular_antialiasing_slope_covariance(dx: vec2<f32>, dy: vec2<f32>) -> vec3<f32> {
    let most = 0.5 * SPECULAR_ANTIALIASING_MAX_ALPHA_SQUARED;
    let sum = vec3<f32>(dx.x * dx.x + dy.x * dy.x, dx.x * dx.y + dy.x * dy.y, dx.y * dx.y + dy.y * dy.y);
    let c = SPECULAR_ANTIALIASING_VARIANCE * sum;
    let larger = 0.5 * (c.x + c.z + sqrt((c.x - c.z) * (c.x - c.z) + 4.0 * c.y * c.y));
    if larger <= most {
        return c;
    }
    if larger < MATH_LARGEST && math_is_finite(larger) {
        return c * (most / larger);
    }
    return vec3<f32>(most, 0.0, most);
}

// The widened roughness of isotropic facets.
fn specular_antialiasing_roughness(alpha: f32, dx: vec2<f32>, dy: vec2<f32>) -> f32 {
    let turned = SPECULAR_ANTIALIASING_VARIANCE * (dot(dx, dx) + dot(dy, dy));
    // NaN counts as the maximum.
    let added = select(
        SPECULAR_ANTIALIASING_MAX_ALPHA_SQUARED,
        min(turned, SPECULAR_ANTIALIASING_MAX_ALPHA_SQUARED),
        math_is_finite(turned),
    );
    let a = math_clamped(alpha, 1.0);
    return select(a, min(sqrt(a * a + added), 1.0), added > 0.0);
}
