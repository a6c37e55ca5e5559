// The blend of values and gradients at the corners of a cell, used by all noises on cells.
//
// Columns are the corners at the ends of the first two axes, blended along all other axes: low and
// low, high and low, low and high, high and high. Each is value + x (p.x - c.x) + y (p.y - c.y).

struct Columns {
    value: vec4<f32>,
    x: vec4<f32>,
    y: vec4<f32>,
}

// Both ends of the second axis, blended along the first: value + y (p.y - c.y).
fn columns_edges(values: vec2<f32>, slopes: vec2<f32>, t: f32) -> vec2<f32> {
    return values + vec2<f32>(t, t - 1.0) * slopes;
}

// The blend of columns at position t with weights w along the first two axes.
fn columns_value(columns: Columns, t: vec2<f32>, w: vec2<f32>) -> f32 {
    let low = columns.value.xz + columns.x.xz * t.x;
    let high = columns.value.yw + columns.x.yw * (t.x - 1.0);
    let slopes = columns.y.xz + w.x * (columns.y.yw - columns.y.xz);
    let edges = columns_edges(low + w.x * (high - low), slopes, t.y);
    return edges.x + w.y * (edges.y - edges.x);
}

// The same, and its gradient along these axes.
fn columns_blend(columns: Columns, t: vec2<f32>, w: vec2<f32>, slope: vec2<f32>) -> Sample2d {
    let low = columns.value.xz + columns.x.xz * t.x;
    let high = columns.value.yw + columns.x.yw * (t.x - 1.0);
    let rise = high - low;
    let bend = columns.y.yw - columns.y.xz;
    let slopes = columns.y.xz + w.x * bend;
    let edges = columns_edges(low + w.x * rise, slopes, t.y);
    let along = (columns.x.xz + w.x * (columns.x.yw - columns.x.xz)) + slope.x * rise;
    let across = columns_edges(along, slope.x * bend, t.y);
    return Sample2d(
        edges.x + w.y * (edges.y - edges.x),
        vec2<f32>(
            across.x + w.y * (across.y - across.x),
            (slopes.x + w.y * (slopes.y - slopes.x)) + slope.y * (edges.y - edges.x),
        ),
    );
}
