// A brick wall for a pixel.

struct MaterialSeen {
    surface: TexturedSlopes,
    // The sum and the weight of each pair of signs of a slope: a pixel in the far view has fifty
    // facets.
    facets: array<vec3<f32>, 9>,
    normal: vec3<f32>,
}

fn material_seen(point: SurfacePoint, frame: Frame, wo: vec3<f32>) -> MaterialSeen {
    let pixel = surface_point_uv_pixel(point);
    let color = brick_wall_color(brick_wall_uniform, point.uv, pixel);
    let surface = textured_slopes(point, color, brick_wall_uniform.roughness);
    let bricks = brick_facets(brick_wall_uniform.bricks, point.uv, pixel_ellipse_sides(pixel));
    var facets = array<vec3<f32>, 9>();
    var slope = vec2<f32>(0.0);
    for (var j = 0u; j < brick_facets_rows(bricks); j++) {
        let row = brick_facets_row(bricks, j);
        for (var k = 0u; k < brick_facets_columns(bricks, row); k++) {
            let facet = brick_facet(bricks, row, k);
            let steep = facet.share * brick_wall_uniform.depth * facet.slope;
            facets[u32(sign(steep.x) + 3.0 * sign(steep.y) + 4.5)] += vec3<f32>(steep, facet.share);
            slope += steep;
        }
    }
    let gradient = surface_gradient_finite(surface.gradient_u * slope.x + surface.gradient_v * slope.y);
    return MaterialSeen(surface, facets, frame_to_local(frame, surface_gradient_normal(point.normal, gradient)));
}

fn material_lamp(seen: MaterialSeen, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !(wi.z > 0.0) {
        return vec3<f32>(0.0);
    }
    var sum = vec3<f32>(0.0);
    for (var k = 0u; k < 9u; k++) {
        let facet = seen.facets[k];
        if facet.z > 0.0 {
            sum += textured_slopes_light(seen.surface, facet.z, facet.xy / facet.z, wo, wi);
        }
    }
    return brdf_finite_channels(sum);
}

fn material_ambience(seen: MaterialSeen, hit: MaterialsHit) -> vec3<f32> {
    return materials_ambient(hit, seen.normal, seen.surface.color, vec3<f32>(0.0), 1.0);
}
