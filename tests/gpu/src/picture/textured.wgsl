// Bumps from a mip-mapped texture, and facets from a table: Kautz, Heidrich, Seidel 2001, section
// 5.2.
fn surface_bumps(p: vec3<f32>, uv: vec2<f32>, frame: Frame, octaves: f32) -> vec3<f32> {
    let seen = mip_mapped_fbm(uv, octaves, 0u);
    return vec3<f32>(seen.value, seen.resolved_variance);
}

// The facet of two Gaussian numbers, from a table in the default layout: uniform in the
// coordinates, stereographic.
fn surface_facet(z: vec2<f32>) -> vec3<f32> {
    return normal_table_filtered(z, vec2<u32>(0u, 2u));
}
