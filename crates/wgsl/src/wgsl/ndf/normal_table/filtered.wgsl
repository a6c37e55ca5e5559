// Table L as a texture with hardware filtering: the lookup by two numbers of Kautz, Heidrich,
// Seidel 2001, section 5.2.

// The normal whose point of the chart is interpolated between the entries around z. `form` is
// spacing and chart, with the numbers of `NormalTableUniform`. GPUs filter with 8 bits of the
// position between two entries.
fn normal_table_filtered(z: vec2<f32>, form: vec2<u32>) -> vec3<f32> {
    let place = vec2<f32>(normal_table_place(form.x, z.x), normal_table_place(form.x, z.y));
    return normal_table_normal(form.y, textureSampleLevel(normal_table_texture, normal_table_sampler, place, 0.0).xy);
}
