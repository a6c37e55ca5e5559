// Table L, normals by lookup of two Gaussian numbers: `asperity_ndf_sampling::NormalTableRef`.

// The entry's point of the chart.
fn normal_table_point(entry: u32) -> vec2<f32> {
    return vec2<f32>(normal_table_number(2u * entry), normal_table_number(2u * entry + 1u));
}

// The position among the entries, from 0 to size - 1, of a Gaussian coordinate.
fn normal_table_position(z: f32) -> f32 {
    let size = f32(normal_table_grid.size);
    return min(max(normal_table_place(normal_table_grid.spacing, z) * size - 0.5, 0.0), size - 1.0);
}

// The normal of the entry nearest to z.
fn normal_table_nearest(z: vec2<f32>) -> vec3<f32> {
    let column = u32(normal_table_position(z.x) + 0.5);
    let row = u32(normal_table_position(z.y) + 0.5);
    return normal_table_normal(normal_table_grid.chart, normal_table_point(row * normal_table_grid.size + column));
}

// The normal whose point of the chart is interpolated bilinearly between the four entries around z.
fn normal_table_bilinear(z: vec2<f32>) -> vec3<f32> {
    let size = normal_table_grid.size;
    if size < 2u {
        return normal_table_normal(normal_table_grid.chart, normal_table_point(0u));
    }
    let x = normal_table_position(z.x);
    let y = normal_table_position(z.y);
    let column = min(u32(x), size - 2u);
    let row = min(u32(y), size - 2u);
    let right = x - f32(column);
    let up = y - f32(row);
    let below = row * size + column;
    let a = normal_table_point(below);
    let b = normal_table_point(below + 1u);
    let left_point = a + (normal_table_point(below + size) - a) * up;
    let right_point = b + (normal_table_point(below + size + 1u) - b) * up;
    return normal_table_normal(normal_table_grid.chart, left_point + (right_point - left_point) * right);
}
