// Dents, noise from whose lattice a share of all gradients is dropped: `asperity_shading::material::Dents`.

// One octave of simplex noise without the gradients whose other word is below `dropped`; the octave's key is its seed.
fn dents_octave(q: vec3<f32>, seed: u32, dropped: u32) -> Sample3d {
    if !simplex_is_within(vec4<f32>(q, 0.0)) {
        return Sample3d(0.0, vec3<f32>(0.0));
    }
    let first = floor(q + ((q.z + q.y) + q.x) * SIMPLEX_SKEW.y);
    let low = q - first;
    // Which axis the point is farther along.
    let xy = low.y < low.x;
    let xz = low.z < low.x;
    let yz = low.z < low.y;
    let ahead_x = vec4<bool>(false, xy && xz, xy || xz, true);
    let ahead_y = vec4<bool>(false, !xy && yz, !xy || yz, true);
    let ahead_z = vec4<bool>(false, !xz && !yz, !xz || !yz, true);

    let ends = integer_hash_ends_3d(vec3<i32>(first));
    let terms = simplex_terms(ends.low.x, ends.high.x, ahead_x)
        ^ simplex_terms(ends.low.y, ends.high.y, ahead_y)
        ^ simplex_terms(ends.low.z, ends.high.z, ahead_z);
    let g = edge_directions_3d(integer_hash_words(terms, lattice_key(seed)));
    let is_kept = integer_hash_words(terms, lattice_key(~seed)) >= vec4<u32>(dropped);
    let scale = select(vec4<f32>(0.0), vec4<f32>(SIMPLEX_SCALE.y), is_kept);
    let gx = g.x * scale;
    let gy = g.y * scale;
    let gz = g.z * scale;

    let back = (((first.x + first.y) + first.z) + vec4<f32>(0.0, 1.0, 2.0, 3.0)) * SIMPLEX_UNSKEW.y;
    let dx = q.x - (simplex_corners(first.x, ahead_x) - back);
    let dy = q.y - (simplex_corners(first.y, ahead_y) - back);
    let dz = q.z - (simplex_corners(first.z, ahead_z) - back);
    let t = simplex_beyond_gap(((0.5 - dy * dy) - dz * dz) - dx * dx);
    let s = (gy * dy + gz * dz) + gx * dx;
    let kernel = simplex_kernel(t);
    let pull = simplex_pull(t, s);
    return Sample3d(
        simplex_added(kernel * s),
        vec3<f32>(
            simplex_added(gx * kernel - dx * pull),
            simplex_added(gy * kernel - dy * pull),
            simplex_added(gz * kernel - dz * pull),
        ),
    );
}

// The value, and the gradient by cells of the first octave, with the octaves that the pixel cannot resolve faded to 0: `Dents::sample`.
fn dents_sample(fbm: Fbm, dropped: u32, position: vec3<f32>, footprint: f32) -> Sample3d {
    let p = position * fbm.frequency;
    var total = octaves_total_3d(fbm.octaves, fbm_footprint(fbm, footprint), fbm.sum);
    while octaves_goes_on(total.walk) {
        let layer = octaves_layer_3d(fbm.sum, total.walk.octave);
        let octave = dents_octave(octaves_point_3d(layer, p), bitcast<u32>(layer.cell_and_key.w), dropped);
        total = octaves_added_3d(total, layer, octave);
    }
    return octaves_divided_3d(total);
}
