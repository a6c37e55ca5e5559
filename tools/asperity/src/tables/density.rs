//! The tables of a density: the map, its distribution functions, and the normal table L with
//! frames.

use asperity_ndf_sampling::glam::{Mat3, Vec2, Vec3};
use asperity_ndf_sampling::normal_table::{Chart, Deviation, Spacing, TableAccuracy, TableLayout};
use asperity_ndf_sampling::{ConditionalTable, Ndf, NormalLut};
use asperity_render::image::formats::{F32, F64, exr, npy};
use serde_json::{Value, json};

use super::made::Made;
use crate::{failure::Failure, input::density::Density};
use asperity_render::{image::Image, image::tone::ember, materials::SharedNdf};

/// Side of the table L.
const L_SIZE: usize = 256;

pub(super) fn tables(density: &Density) -> Result<Made, Failure> {
    let ndf = density.ndf.as_ref();
    let map = density.map()?;
    let view = map.view();
    let (width, height) = (view.width(), view.height());
    // Textures have their first row at the top, where n_y is near +1. Arrays follow the map, from
    // n_y = −1 up.
    let texture: Vec<f32> = (0..height)
        .rev()
        .flat_map(|j| (0..width).map(move |i| [i, j]))
        .map(|t| at_center(&map, t, [width, height]))
        .collect();
    let edges = |n: usize| (0..=n).map(move |i| i as f64 / n as f64);
    let forward =
        |[x, y]: [f64; 2]| view.forward(Vec2::new(2.0 * x as f32 - 1.0, 2.0 * y as f32 - 1.0)).as_dvec2();
    let marginal: Vec<f64> = edges(width).map(|x| forward([x, 0.5]).x).collect();
    let conditional: Vec<f64> = (0..width)
        .flat_map(|i| edges(height).map(move |y| [(i as f64 + 0.5) / width as f64, y]))
        .map(|at| forward(at).y)
        .collect();
    let table = NormalLut::new(ndf, L_SIZE)?;
    let accuracy = table.accuracy(ndf);
    let seen = ConditionalTable::new(ndf, L_SIZE)?;
    let loss = seen.accuracy(ndf);
    // Rows of both textures run from the bottom up, as in the tables: from z2 = −4.5, and from p_y
    // = −1.
    let frames = table.frames().map(|f| Mat3::from_cols(f.normal, f.tangent, f.bitangent).to_cols_array());
    let names = ["n.X", "n.Y", "n.Z", "t.X", "t.Y", "t.Z", "b.X", "b.Y", "b.Z"];
    let half_vectors =
        seen.view().entries().iter().map(|&[z1, z2, root]| [z1, z2, (root * root) * (root * root)]);
    let packed = map.array();
    let files = vec![
        ("density.exr".into(), exr(width, height, [("Y", texture.clone())])?),
        ("marginal_cdf.npy".into(), npy(F64, &[width + 1], &marginal)),
        ("conditional_cdf.npy".into(), npy(F64, &[width, height + 1], &conditional)),
        ("normal_table.exr".into(), channels(L_SIZE, names, frames)?),
        ("half_vectors.exr".into(), channels(L_SIZE, ["z1", "z2", "D"], half_vectors)?),
        ("packed_map.npy".into(), npy(F32, &[packed.len()], packed)),
    ];
    let peak = texture.iter().fold(0.0_f32, |peak, &d| peak.max(d));
    let picture = Image::from_fn(256, 256, |x, y| {
        let (i, j) = (x as usize * width / 256, y as usize * height / 256);
        let d = texture.get(j * width + i).copied().unwrap_or(0.0);
        // A logarithm over four decades also shows the tails.
        ember(1.0 + (d / peak).max(1e-9).log10() / 4.0)
    });
    Ok(Made {
        text: format!(
            "The density on the {width} × {height} hemispherical map (the image shows four decades, logarithmic), its marginal \
             CDF M at column edges, its conditional CDFs C at column centers, and L(z1, z2): {L_SIZE} × {L_SIZE} \
             tangent frames over ±{} standard deviations. The error of its normals is {:.4}° RMS and {:.2}° at \
             most with bilinear interpolation, and {:.2}° and {:.1}° with nearest lookup. Adjacent frames \
             differ by up to {:.1}°. parameters.json lists the errors of all other layouts. The texture of half vectors contains the part that a \
             pixel does not resolve, at every position and zoom, with a total variation error of {:.4}. packed_map.npy contains the map, \
             which `PackedMapRef` samples and inverts to 1e-6 from one array of 32-bit floats, in flash or in a GPU buffer.",
            Spacing::RANGE,
            accuracy.bilinear.rms.to_degrees(),
            accuracy.bilinear.largest.to_degrees(),
            accuracy.nearest.rms.to_degrees(),
            accuracy.nearest.largest.to_degrees(),
            accuracy.largest_step.to_degrees(),
            loss.variation,
        ),
        parameters: json!({
            "kind": "normal density function",
            "ndf": density.spec,
            "map": [width, height],
            "normal_table": {
                "size": L_SIZE,
                "range": Spacing::RANGE,
                "channels": "n.XYZ, t.XYZ, b.XYZ",
                "error_in_radians": errors(ndf)?,
            },
            "half_vectors": {
                "size": L_SIZE,
                "stretch": seen.view().stretch().to_array(),
                "channels": "z1 and z2: Gaussian coordinates of h, D: its density; bilinear between the fourth roots of D",
                "error": { "total_variation": loss.variation, "coordinates_rms": loss.coordinates },
            },
            "packed_map": {
                "channels": "32-bit floats, little-endian, as `PackedMapRef::new` reads them; integers by their bits",
                "error": { "uniform_numbers": 1e-6 },
            },
            "flat_normal_at": ndf.invert(Vec3::Z).to_array(),
        }),
        files,
        picture,
    })
}

/// Returns the lookup errors of every layout that the crate offers, at the size of the table.
fn errors(ndf: &SharedNdf) -> Result<Value, Failure> {
    let deviation = |d: Deviation| json!({ "rms": d.rms, "largest": d.largest });
    let mut rows = Vec::new();
    for (spacing, by) in [
        (Spacing::Coordinates, "coordinates"),
        (Spacing::Quantiles, "quantiles"),
        (Spacing::Warped, "warped coordinates"),
    ] {
        for chart in [Chart::Stereographic, Chart::Projected, Chart::Slopes] {
            let TableAccuracy { nearest, bilinear, bilinear_half, beyond, largest_step } =
                NormalLut::with_layout(ndf, L_SIZE, TableLayout { spacing, chart })?.accuracy(ndf);
            rows.push(json!({
                "spacing": by,
                "chart": format!("{chart:?}").to_lowercase(),
                "nearest": deviation(nearest),
                "bilinear": deviation(bilinear),
                "bilinear_half": deviation(bilinear_half),
                "beyond": beyond,
                "largest_step_of_frames": largest_step,
            }));
        }
    }
    Ok(Value::Array(rows))
}

fn at_center(map: &dyn Ndf, [i, j]: [usize; 2], [width, height]: [usize; 2]) -> f32 {
    let center = |i: usize, n: usize| 2.0 * (i as f64 + 0.5) / n as f64 - 1.0;
    let (x, y) = (center(i, width), center(j, height));
    let z2 = 1.0 - x * x - y * y;
    if z2 > 0.0 { map.d(Vec3::new(x as f32, y as f32, z2.sqrt() as f32)) } else { 0.0 }
}

/// Encodes a square texture with these channels.
fn channels<const N: usize>(
    size: usize,
    names: [&str; N],
    texels: impl Iterator<Item = [f32; N]>,
) -> Result<Vec<u8>, Failure> {
    let texels: Vec<[f32; N]> = texels.collect();
    let plane = |k: usize| texels.iter().map(|texel| texel[k]).collect();
    exr(size, size, std::array::from_fn::<_, N, _>(|k| (names[k], plane(k))))
}
