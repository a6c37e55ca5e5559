// Square tiles with a ridge along their edges: `asperity_shading::material::BeveledTiles`.

// Light from the facets of a ridge between two distances, which fall `away` from its edge.
fn beveled_tiles_ridge(
    surface: TexturedSlopes,
    facets: BevelFacets,
    share: f32,
    away: vec2<f32>,
    wo: vec3<f32>,
    wi: vec3<f32>,
) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    if facets.flank > 0.0 {
        sum += textured_slopes_light(surface, share * facets.flank, facets.slopes.x * away, wo, wi);
        sum += textured_slopes_light(surface, share * facets.flank, facets.slopes.y * away, wo, wi);
    }
    if facets.flat > 0.0 {
        sum += textured_slopes_light(surface, share * facets.flat, vec2<f32>(0.0), wo, wi);
    }
    return sum;
}

// Light of whole tiles, in rings around their middles.
fn beveled_tiles_far(bevel: Bevel, surface: TexturedSlopes, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    var flat = 0.0;
    for (var k = 0u; k < 16u; k++) {
        let near = f32(k) / 32.0;
        let beyond = f32(k + 1u) / 32.0;
        let ring = (1.0 - 2.0 * near) * (1.0 - 2.0 * near) - (1.0 - 2.0 * beyond) * (1.0 - 2.0 * beyond);
        var facets = bevel_facets(bevel, near, beyond);
        flat += ring * facets.flat;
        facets.flat = 0.0;
        for (var edge = 0u; edge < 4u && facets.flank > 0.0; edge++) {
            let side = select(1.0, -1.0, edge > 1u);
            let away = select(vec2<f32>(0.0, side), vec2<f32>(side, 0.0), (edge & 1u) == 0u);
            sum += beveled_tiles_ridge(surface, facets, 0.25 * ring, away, wo, wi);
        }
    }
    return sum + textured_slopes_light(surface, flat, vec2<f32>(0.0), wo, wi);
}

// Reflectance times cosine, `Bsdf::eval_cos` of a point; wo and wi are in its frame,
// `surface_point_frame`. All facets are lit, while the Rust crate merges facets beyond the 32nd.
fn beveled_tiles_eval_cos(tiles: BeveledTiles, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let surface = textured_slopes(point, tiles.color, tiles.roughness);
    let at = point.uv / tiles.side;
    let width = surface_point_uv_pixel(point).widths.x / tiles.side;
    let far = frequency_clamp_filtered_fraction(width, 1.0);
    var sum = vec3<f32>(0.0);
    if far < 1.0 && direction_is_finite(vec3<f32>(at, 0.0)) {
        let edge = bevel_tile_edge(at - floor(at));
        let low = edge.distance - 0.5 * width;
        let high = edge.distance + 0.5 * width;
        // Beyond the edge is the next tile's ridge.
        var beyond = 0.0;
        if width > 0.0 {
            beyond = max(-low / width, 0.0);
        }
        let facets = bevel_facets(tiles.bevel, max(low, 0.0), high);
        sum = beveled_tiles_ridge(surface, facets, (1.0 - far) * (1.0 - beyond), edge.away, wo, wi);
        if beyond > 0.0 {
            let next = bevel_facets(tiles.bevel, 0.0, -low);
            sum += beveled_tiles_ridge(surface, next, (1.0 - far) * beyond, -edge.away, wo, wi);
        }
    }
    if far > 0.0 {
        sum += beveled_tiles_far(tiles.bevel, surface, wo, wi) * far;
    }
    return brdf_finite_channels(sum);
}

// The material in the uniform.
fn beveled_tiles(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return beveled_tiles_eval_cos(beveled_tiles_uniform, point, wo, wi);
}
