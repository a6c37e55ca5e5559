// Perlin noise of 2002, `asperity_noise::Perlin`: gradients to edges, quintic weights. Values
// are in [-1, 1].

const PERLIN_SCALE: vec3<f32> = vec3<f32>(1.070048, 0.96491945, 0.6507936);

// The noise at a position in [0, 1]^2 of a cell.
fn perlin_in_cell_2d(cell: vec2<i32>, t: vec2<f32>, key: u32) -> Sample2d {
    let w = fade_quintic(vec4<f32>(t, 0.0, 0.0));
    let slope = fade_quintic_slope(vec4<f32>(t, 0.0, 0.0));
    let words = integer_hash_upper_words(integer_hash_keyed(integer_hash_ends_2d(cell), key));
    let g = edge_directions_2d(words, PERLIN_SCALE.x);
    return columns_blend(Columns(vec4<f32>(0.0), g.x, g.y), t, w.xy, slope.xy);
}

// Corners blended along the third axis. The components of a direction are signs or 0, so their
// products with offsets and weights are exact.
fn perlin_in_cell_3d(cell: vec3<i32>, t: vec3<f32>, key: u32) -> Sample3d {
    let ends = integer_hash_ends_3d(cell);
    let w = fade_quintic(vec4<f32>(t, 0.0));
    let slope = fade_quintic_slope(vec4<f32>(t, 0.0));
    let keyed = integer_hash_keyed(ends, key);
    let g = edge_directions_3d(integer_hash_upper_words(keyed ^ vec4<u32>(ends.low.z)));
    let h = edge_directions_3d(integer_hash_upper_words(keyed ^ vec4<u32>(ends.high.z)));
    let rest = t.z - 1.0;
    let low = PERLIN_SCALE.y * (1.0 - w.z);
    let high = PERLIN_SCALE.y * w.z;
    let d = PERLIN_SCALE.y * slope.z;
    let columns = Columns(g.z * (t.z * low) + h.z * (rest * high), g.x * low + h.x * high, g.y * low + h.y * high);
    let derivative = Columns(
        g.z * (low + t.z * -d) + h.z * (high + rest * d),
        g.x * -d + h.x * d,
        g.y * -d + h.y * d,
    );
    let plane = columns_blend(columns, t.xy, w.xy, slope.xy);
    return Sample3d(plane.value, vec3<f32>(plane.gradient, columns_value(derivative, t.xy, w.xy)));
}

// Sums over the corners of the ends of the third and the fourth axis, with their derivatives along
// both.
struct PerlinColumns4d {
    value: Columns,
    dz: Columns,
    dw: Columns,
}

// The sums with the corners of one end: directions g, offsets to them, and their weight with its
// derivatives.
fn perlin_joined_4d(
    sum: PerlinColumns4d,
    g: EdgeDirections4d,
    way: vec2<f32>,
    u: f32,
    du: vec2<f32>,
) -> PerlinColumns4d {
    return PerlinColumns4d(
        Columns((sum.value.value + g.z * (way.x * u)) + g.w * (way.y * u), sum.value.x + g.x * u, sum.value.y + g.y * u),
        Columns(
            (sum.dz.value + g.z * (u + way.x * du.x)) + g.w * (way.y * du.x),
            sum.dz.x + g.x * du.x,
            sum.dz.y + g.y * du.x,
        ),
        Columns(
            (sum.dw.value + g.z * (way.x * du.y)) + g.w * (u + way.y * du.y),
            sum.dw.x + g.x * du.y,
            sum.dw.y + g.y * du.y,
        ),
    );
}

// The noise at a position in [0, 1]^4 of a cell.
fn perlin_in_cell_4d(cell: vec4<i32>, t: vec4<f32>, key: u32) -> Sample4d {
    let ends = integer_hash_ends(cell);
    let w = fade_quintic(t);
    let slope = fade_quintic_slope(t);
    let keyed = integer_hash_keyed(ends, key);
    let none = Columns(vec4<f32>(0.0), vec4<f32>(0.0), vec4<f32>(0.0));
    let scale = PERLIN_SCALE.z;
    let low = 1.0 - w.zw;
    let rest = t.zw - 1.0;
    var g = edge_directions_4d(integer_hash_upper_words(keyed ^ vec4<u32>(ends.low.z ^ ends.low.w)));
    var u = scale * low.x;
    var du = scale * slope.z;
    var sum = perlin_joined_4d(
        PerlinColumns4d(none, none, none), g, t.zw, u * low.y, vec2<f32>(-du * low.y, u * -slope.w),
    );
    g = edge_directions_4d(integer_hash_upper_words(keyed ^ vec4<u32>(ends.high.z ^ ends.low.w)));
    u = scale * w.z;
    sum = perlin_joined_4d(
        sum, g, vec2<f32>(rest.x, t.w), u * low.y, vec2<f32>(du * low.y, u * -slope.w),
    );
    g = edge_directions_4d(integer_hash_upper_words(keyed ^ vec4<u32>(ends.low.z ^ ends.high.w)));
    u = scale * low.x;
    sum = perlin_joined_4d(sum, g, vec2<f32>(t.z, rest.y), u * w.w, vec2<f32>(-du * w.w, u * slope.w));
    g = edge_directions_4d(integer_hash_upper_words(keyed ^ vec4<u32>(ends.high.z ^ ends.high.w)));
    u = scale * w.z;
    sum = perlin_joined_4d(sum, g, rest, u * w.w, vec2<f32>(du * w.w, u * slope.w));
    let plane = columns_blend(sum.value, t.xy, w.xy, slope.xy);
    return Sample4d(
        plane.value,
        vec4<f32>(plane.gradient, columns_value(sum.dz, t.xy, w.xy), columns_value(sum.dw, t.xy, w.xy)),
    );
}

// The noise at any point; 0 if a coordinate is not finite.
fn perlin_noise_2d(p: vec2<f32>, key: u32) -> Sample2d {
    let at = cell_place_2d(p);
    return sample_known_2d(perlin_in_cell_2d(at.cell, at.place, key), at.known);
}

fn perlin_noise_3d(p: vec3<f32>, key: u32) -> Sample3d {
    let at = cell_place_3d(p);
    return sample_known_3d(perlin_in_cell_3d(at.cell, at.place, key), at.known);
}

fn perlin_noise_4d(p: vec4<f32>, key: u32) -> Sample4d {
    let at = cell_place_4d(p);
    return sample_known_4d(perlin_in_cell_4d(at.cell, at.place, key), at.known);
}
