// Dents, noise with a fraction of the gradients of its lattice dropped:
// `asperity_shading::material::Dents`.

// One octave of simplex noise without the gradients whose second word is below `dropped`. The
// octave's key is its seed.
fn dents_octave(q: vec3<f32>, seed: u32, dropped: u32) -> Sample3d {
    if !simplex_is_within(vec4<f32>(q, 0.0)) {
        return Sample3d(0.0, vec3<f32>(0.0));
    }
    let at = simplex_corners_3d(vec3<i32>(0), q);
    let terms = at.x_terms ^ at.terms;
    let g = edge_directions_3d(integer_hash_words(terms, lattice_key(seed)));
    let is_kept = integer_hash_words(terms, lattice_key(~seed)) >= vec4<u32>(dropped);
    return simplex_corner_sum_3d(at, g, select(vec4<f32>(0.0), vec4<f32>(SIMPLEX_SCALE.y), is_kept), 0.5);
}

// The value, and the gradient in cells of the first octave, with unresolved octaves faded to 0:
// `Dents::sample`.
fn dents_sample(fbm: SizedFbm, dropped: u32, position: vec3<f32>, footprint: f32) -> Sample3d {
    let p = position * fbm.frequency;
    var total = fbm_total_3d(fbm.octaves, sized_fbm_footprint(fbm, footprint), fbm.sum);
    while fbm_goes_on(total.walk) {
        let layer = fbm_layer_3d(fbm.sum, total.walk.octave);
        let octave = dents_octave(fbm_point_3d(layer, p), bitcast<u32>(layer.cell_and_key.w), dropped);
        total = fbm_added_3d(total, layer, octave);
    }
    return fbm_divided_3d(total);
}
