// The point of a surface that a material is evaluated at: `asperity_shading::SurfacePoint`.

struct SurfacePoint {
    // In model space, where noises are sampled.
    position: vec3<f32>,
    // The unit normal without bumps.
    normal: vec3<f32>,
    // Texture coordinates, with the derivatives of the position in them.
    uv: vec2<f32>,
    tangent_u: vec3<f32>,
    tangent_v: vec3<f32>,
    // The pixel on the surface.
    pixel: PixelEllipse,
}

// The frame of the directions of materials: z along the normal, x along the projected derivative by
// u.
fn surface_point_frame(point: SurfacePoint) -> Frame {
    return frame_from_normal_tangent(point.normal, point.tangent_u);
}

// The surface gradients of u and of v; zero if the tangents are parallel.
fn surface_point_gradient_u(point: SurfacePoint) -> vec3<f32> {
    return surface_gradient(point.normal, point.tangent_u, point.tangent_v, vec2<f32>(1.0, 0.0));
}

fn surface_point_gradient_v(point: SurfacePoint) -> vec3<f32> {
    return surface_gradient(point.normal, point.tangent_u, point.tangent_v, vec2<f32>(0.0, 1.0));
}

// The surface gradient of a function with this slope in texture coordinates; zero if it is not
// finite.
fn surface_point_gradient(point: SurfacePoint, slope: vec2<f32>) -> vec3<f32> {
    let gradient = surface_point_gradient_u(point) * slope.x + surface_point_gradient_v(point) * slope.y;
    return surface_gradient_finite(gradient);
}

// A slope in texture coordinates as a slope on the surface, independent of the texture's scale.
fn surface_point_slope(point: SurfacePoint, slope: vec2<f32>) -> vec3<f32> {
    return direction_unit_or_zero(surface_point_gradient(point, slope)) * sqrt(dot(slope, slope));
}

// The pixel in texture coordinates, as a box along their axes.
fn surface_point_uv_pixel(point: SurfacePoint) -> PixelEllipse {
    let u = pixel_ellipse_change(point.pixel, surface_point_gradient_u(point));
    let v = pixel_ellipse_change(point.pixel, surface_point_gradient_v(point));
    return pixel_ellipse_aligned(vec2<f32>(u, v));
}
