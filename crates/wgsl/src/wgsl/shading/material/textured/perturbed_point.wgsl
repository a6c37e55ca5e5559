// A surface point with displaced texture coordinates, for materials of
// `asperity_shading::material::Perturbed`.

// The point with texture coordinates displaced by noise, and a pixel as wide as the unresolved
// displacement.
fn perturbed_point(texture: PerturbedTexture, point: SurfacePoint) -> SurfacePoint {
    let width = point.pixel.widths.x;
    let there = perturbed_look_up(texture, point.position, point.uv, width);
    var moved = point;
    moved.uv = there.uv;
    if there.spread.x != 0.0 || there.spread.y != 0.0 {
        let u = point.tangent_u;
        let v = point.tangent_v;
        let spread = there.spread * vec2<f32>(sqrt(dot(u, u)), sqrt(dot(v, v)));
        let sides = sqrt(vec2<f32>(width * width) + 12.0 * spread * spread);
        moved.pixel = pixel_ellipse_from_derivatives(
            direction_unit_or_zero(u) * sides.x, direction_unit_or_zero(v) * sides.y,
        );
    }
    return moved;
}
