// The height field f(x) g(y) of two smooth functions, and its gradient:
// `asperity_fif::HeightField`.

// Height and gradient.
struct HeightFieldJet {
    height: f32,
    gradient: vec2<f32>,
}

// f(x) g(y) at a point clamped to the domain; NaN for NaN.
fn height_field_height(field: HeightField, p: vec2<f32>) -> f32 {
    return fif_table_value(field.x, p.x) * fif_table_value(field.y, p.y);
}

// Height and gradient at the nearest point of the domain.
fn height_field_jet(field: HeightField, p: vec2<f32>) -> HeightFieldJet {
    let f = fif_table_jet(field.x, p.x);
    let g = fif_table_jet(field.y, p.y);
    return HeightFieldJet(f.x * g.x, vec2<f32>(f.y * g.x, f.x * g.y));
}
