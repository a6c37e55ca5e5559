// A wall of bricks with recessed mortar: `asperity_shading::material::BrickWall`.

// The mean color of a pixel with these sides in texture coordinates.
fn brick_wall_color(wall: BrickWall, uv: vec2<f32>, pixel: PixelEllipse) -> vec3<f32> {
    let share = brick_filtered(wall.bricks, uv, pixel_ellipse_sides(pixel)).brick;
    let cell = brick_sample(wall.bricks, uv).cell;
    let word = integer_hash_word(integer_hash_term(0u, cell.x) ^ integer_hash_term(1u, cell.y), wall.key);
    let own = f32(word) / 4294967296.0 - 0.5;
    let told_apart = footprint_kept(pixel.widths.x, 1.0 / max(wall.bricks.cell.x, wall.bricks.cell.y));
    let clay = wall.clay * (1.0 + 2.0 * wall.variation * own * told_apart);
    return wall.mortar * (1.0 - share) + clay * share;
}

// Reflectance times cosine, `Bsdf::eval_cos` of a point; wo and wi are in its frame,
// `surface_point_frame`. All facets are lit, while the Rust crate merges facets beyond the 32nd.
fn brick_wall_eval_cos(wall: BrickWall, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let pixel = surface_point_uv_pixel(point);
    let surface = textured_slopes(point, brick_wall_color(wall, point.uv, pixel), wall.roughness);
    let facets = brick_facets(wall.bricks, point.uv, pixel_ellipse_sides(pixel));
    var sum = vec3<f32>(0.0);
    for (var j = 0u; j < brick_facets_rows(facets); j++) {
        let row = brick_facets_row(facets, j);
        for (var k = 0u; k < brick_facets_columns(facets, row); k++) {
            let facet = brick_facet(facets, row, k);
            if facet.share > 0.0 {
                sum += textured_slopes_light(surface, facet.share, wall.depth * facet.slope, wo, wi);
            }
        }
    }
    return brdf_finite_channels(sum);
}

// The material in the uniform.
fn brick_wall(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return brick_wall_eval_cos(brick_wall_uniform, point, wo, wi);
}
