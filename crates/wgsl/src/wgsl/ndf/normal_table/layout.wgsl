// Layouts of tables of normals: `Spacing` and `Chart` of `asperity_ndf_sampling::normal_table`.
// They also apply to tables in textures, where the texture coordinate is the place of each Gaussian
// coordinate and the texel is the point of a normal.

const NORMAL_TABLE_COORDINATES: u32 = 0u;
const NORMAL_TABLE_QUANTILES: u32 = 1u;
const NORMAL_TABLE_WARPED: u32 = 2u;

const NORMAL_TABLE_PROJECTED: u32 = 0u;
const NORMAL_TABLE_SLOPES: u32 = 1u;
const NORMAL_TABLE_STEREOGRAPHIC: u32 = 2u;

// The place from 0 to 1 of a Gaussian coordinate within 4.5 standard deviations, 0 for NaN:
// `Spacing::place`.
fn normal_table_place(spacing: u32, coordinate: f32) -> f32 {
    let z = elementary_bounded(coordinate, 4.5);
    if spacing == NORMAL_TABLE_QUANTILES {
        return gaussian_cdf(z);
    }
    if spacing == NORMAL_TABLE_WARPED {
        return clamp(0.6009252 * z / sqrt(z * z + 9.0) + 0.5, 0.0, 1.0);
    }
    return z * 0.11111111 + 0.5;
}

// The normal of a point of the chart; an invalid point is replaced by the nearest valid point:
// `Chart::to_normal`.
fn normal_table_normal(chart: u32, point: vec2<f32>) -> vec3<f32> {
    let x = elementary_bounded(point.x, 1e9);
    let y = elementary_bounded(point.y, 1e9);
    let square = x * x + y * y;
    if chart == NORMAL_TABLE_SLOPES {
        if point.x * point.x + point.y * point.y <= 1e18 {
            let up = 1.0 / sqrt(1.0 + square);
            return vec3<f32>(x * up, y * up, up);
        }
        let steep = sqrt(square + 1.0);
        return vec3<f32>(x / steep, y / steep, 1.0 / steep);
    }
    if square > 1.0 {
        let outside = sqrt(square);
        return vec3<f32>(x / outside, y / outside, 0.0);
    }
    if chart == NORMAL_TABLE_PROJECTED {
        return vec3<f32>(x, y, sqrt(1.0 - square));
    }
    let a = 1.0 / (1.0 + square);
    return vec3<f32>(2.0 * x * a, 2.0 * y * a, (1.0 - square) * a);
}
