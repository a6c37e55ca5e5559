// One octave: the affine map into the cells of its lattice, and the key for its random words.
// asperity_noise::gpu::FbmLayer3d.

// M p + o: the octave's own coordinates of a point.
fn fbm_point_3d(layer: FbmLayer3d, p: vec3<f32>) -> vec3<f32> {
    return vec3<f32>(
        layer.row_x.x * p.x + layer.row_x.y * p.y + layer.row_x.z * p.z + layer.row_x.w,
        layer.row_y.x * p.x + layer.row_y.y * p.y + layer.row_y.z * p.z + layer.row_y.w,
        layer.row_z.x * p.x + layer.row_z.y * p.y + layer.row_z.z * p.z + layer.row_z.w,
    );
}

// M p + o in 2-D.
fn fbm_point_2d(layer: FbmLayer2d, p: vec2<f32>) -> vec2<f32> {
    return vec2<f32>(
        layer.rows.x * p.x + layer.rows.y * p.y + layer.offset.x,
        layer.rows.z * p.x + layer.rows.w * p.y + layer.offset.y,
    );
}

// M p + o in 4-D.
fn fbm_point_4d(layer: FbmLayer4d, p: vec4<f32>) -> vec4<f32> {
    let x = layer.row_x * p;
    let y = layer.row_y * p;
    let z = layer.row_z * p;
    let w = layer.row_w * p;
    return vec4<f32>(x.x, y.x, z.x, w.x) + vec4<f32>(x.y, y.y, z.y, w.y) + vec4<f32>(x.z, y.z, z.z, w.z)
        + vec4<f32>(x.w, y.w, z.w, w.w) + layer.offset;
}

// The transpose of M times g: rotates a gradient back to the coordinates of the sum.
fn fbm_pull_back_3d(layer: FbmLayer3d, g: vec3<f32>) -> vec3<f32> {
    return layer.row_x.xyz * g.x + layer.row_y.xyz * g.y + layer.row_z.xyz * g.z;
}

// The transpose of M times g in 2-D.
fn fbm_pull_back_2d(layer: FbmLayer2d, g: vec2<f32>) -> vec2<f32> {
    return layer.rows.xy * g.x + layer.rows.zw * g.y;
}

// The transpose of M times g in 4-D.
fn fbm_pull_back_4d(layer: FbmLayer4d, g: vec4<f32>) -> vec4<f32> {
    return layer.row_x * g.x + layer.row_y * g.y + layer.row_z * g.z + layer.row_w * g.w;
}
