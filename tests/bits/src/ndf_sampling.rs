//! Densities, maps and tables: the functions of `asperity-ndf-sampling` at many points.

use alloc::{format, vec::Vec};

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, Blend, BlinnPhong, ClosedForm, ConditionalNdf, ConditionalTable, Frame,
    GaussianSplit, Ggx, Isotropic, KurtoticDistribution, Measure, Microfacet, Mixture, Ndf, NdfMap,
    NoiseCdfRef, NoiseDistribution, NormalLut, OffsetBeckmann, Reconstruction, Rotated, StudentT, Ward,
    estimate_ndf, gaussian_cdf, inverse_gaussian_cdf,
};
use asperity_shading::glam::{Vec2, Vec3};

use crate::digest::{Digest, Report, direction, plane, square, unit};

const POINTS: u32 = 200;

fn maps(bits: &mut Digest, ndf: &dyn Ndf) {
    for i in 0..POINTS {
        let m = direction(i);
        bits.push([ndf.d(m), ndf.slope_density(0.3 * plane(i)), ndf.pdf(m)]);
        bits.push([ndf.warp_gaussian(plane(i)), ndf.sample(square(i))]);
        bits.push(ndf.invert(m));
    }
}

fn masking(bits: &mut Digest, ndf: &dyn Microfacet) {
    maps(bits, &ndf);
    for i in 0..POINTS {
        let (v, w, u) = (direction(i), direction(i + POINTS), square(i));
        bits.push([ndf.lambda(v), ndf.projected_area(v), ndf.g1(v), ndf.g2(v, w), ndf.g2_separable(v, w)]);
        bits.push(ndf.sample_visible(v, u));
        bits.push(ndf.visible_pdf(v, w));
    }
}

/// Returns coordinates of points, axis by axis.
fn lists<const N: usize>(of: impl Fn(u32) -> [f32; N]) -> [Vec<f32>; N] {
    core::array::from_fn(|axis| (0..POINTS).map(|i| of(i)[axis]).collect())
}

fn closed_form(bits: &mut Digest, ndf: &impl ClosedForm) {
    let (z, u) = (lists(|i| plane(i).to_array()), lists(|i| square(i).to_array()));
    let (m, v) = (lists(|i| direction(i).to_array()), lists(|i| direction(i + POINTS).to_array()));
    let ([z, u], [m, v]) =
        ([&z, &u].map(|l| [&l[0][..], &l[1]]), [&m, &v].map(|l| [&l[0][..], &l[1], &l[2]]));
    let mut out = [const { [0.0; POINTS as usize] }; 3];
    let [x, y, h] = &mut out;
    let mut done = [ndf.warp_gaussian_batch(z, [x, y, h]).is_ok(), false, false, false];
    bits.push(out);
    let [x, y, h] = &mut out;
    done[1] = ndf.invert_batch(m, [x, y]).is_ok() && ndf.d_batch(m, h).is_ok();
    bits.push(out);
    let [x, y, h] = &mut out;
    done[2] = ndf.sample_batch(u, [x, y, h]).is_ok();
    bits.push(out);
    let [x, y, h] = &mut out;
    done[3] = ndf.sample_visible_batch(v, u, [x, y, h]).is_ok();
    bits.push(out);
    bits.push(done.map(|done| if done { 1.0_f32 } else { 0.0 }));
}

fn painted(m: Vec3) -> f32 {
    0.7 + m.x * m.x + 0.5 * m.y
}

fn tables(report: &mut Report) -> Option<()> {
    report.group("ndf: tables and maps");
    let ggx = Ggx::new(0.2, 0.4).ok()?;
    for kind in [Reconstruction::Constant, Reconstruction::Bilinear] {
        let map = NdfMap::from_fn(24, 16, Measure::SolidAngle, kind, painted).ok()?;
        report.row(&format!("NdfMap, {kind:?}"), |bits| maps(bits, &map));
        let packed = map.view();
        let (u, n) = (lists(|i| square(i).to_array()), lists(|i| direction(i).truncate().to_array()));
        let mut out = [[0.0; POINTS as usize]; 3];
        report.row(&format!("PackedMapRef, {kind:?}"), |bits| {
            bits.push(map.array());
            let [x, y, density] = &mut out;
            let done = packed.d_batch([&n[0], &n[1]], density).is_ok();
            bits.push(if done && packed.inverse_batch([&u[0], &u[1]], [x, y]).is_ok() {
                1.0_f32
            } else {
                0.0
            });
            bits.push(out);
        });
    }
    let table = NormalLut::new(&ggx, 16).ok()?;
    report.row("NormalTable", |bits| {
        for i in 0..POINTS {
            let Frame { tangent, bitangent, normal } = table.bilinear(plane(i));
            bits.push([tangent, bitangent, normal, table.nearest(plane(i)).normal]);
        }
    });
    let conditional = ConditionalTable::new(&ggx, 32).ok()?;
    report.row("ConditionalTable", |bits| {
        for i in 0..POINTS {
            let split = GaussianSplit::new(plane(i), 0.98 * unit(i, 5));
            bits.push(conditional.view().residual_ndf(direction(i), split));
        }
    });
    let normals: Vec<Vec3> = (0..POINTS).map(direction).collect();
    let estimate = estimate_ndf(&normals).ok()?;
    report.row("estimate_ndf", |bits| maps(bits, &estimate));
    Some(())
}

fn densities(report: &mut Report) -> Option<()> {
    report.group("ndf: densities, samples, masking");
    let (ggx, beckmann) = (Ggx::new(0.2, 0.4).ok()?, Beckmann::new(0.5, 0.1).ok()?);
    let student_t = StudentT::new(0.2, 0.4, 3.0).ok()?;
    let blend = Blend::new(ggx, beckmann, 0.3).ok()?;
    let microfacets: [(&str, &dyn Microfacet); 9] = [
        ("Ggx", &ggx),
        ("Beckmann", &beckmann),
        ("StudentT", &student_t),
        ("Ward", &Ward::new(0.2, 0.4).ok()?),
        ("BlinnPhong", &BlinnPhong::new(20.0).ok()?),
        ("AshikhminShirley", &AshikhminShirley::new(50.0, 10.0).ok()?),
        ("Rotated", &Rotated::new(ggx, 0.7).ok()?),
        ("Mixture", &Mixture::new(Ggx::isotropic(0.3).ok()?, BlinnPhong::new(0.0).ok()?, 0.7).ok()?),
        ("Rotated Student", &Rotated::new(student_t, 2.0).ok()?),
    ];
    for (name, ndf) in microfacets {
        report.row(name, |bits| masking(bits, ndf));
    }
    report.row("Blend", |bits| {
        for i in 0..POINTS {
            bits.push([blend.d(direction(i)), blend.lambda(direction(i))]);
            bits.push([blend.sample(square(i)), blend.sample_visible(direction(i), square(i))]);
        }
    });
    let others: [(&str, &dyn Ndf); 3] = [
        ("Isotropic", &Isotropic::new(&[0.1, 0.5, 0.4, 2.0, 9.0]).ok()?),
        ("ConditionalNdf", &ConditionalNdf::new(ggx, Vec2::new(0.7, -1.2), 0.75)),
        ("OffsetBeckmann", &OffsetBeckmann::new(Vec2::new(0.3, -0.2), [0.04, -0.01, 0.09]).ok()?),
    ];
    for (name, ndf) in others {
        report.row(name, |bits| maps(bits, ndf));
    }
    report.group("ndf: arrays in lanes");
    report.row("Ggx in lanes", |bits| closed_form(bits, &ggx));
    report.row("Beckmann in lanes", |bits| closed_form(bits, &beckmann));
    Some(())
}

fn distributions(report: &mut Report) -> Option<()> {
    report.group("ndf: distributions of noise");
    report.row("phi", |bits| {
        for i in 0..POINTS {
            bits.push([
                gaussian_cdf(f64::from(unit(i, 0)) * 12.0 - 6.0),
                inverse_gaussian_cdf(f64::from(unit(i, 1))),
            ]);
        }
    });
    let cdf = NoiseCdfRef::new(1.5, &[0.0, 0.1, 0.6, 1.0]).ok()?;
    let kurtotic = KurtoticDistribution::new(0.7, -0.5).ok()?;
    let noises: [(&str, &dyn NoiseDistribution); 2] = [("NoiseCdfRef", &cdf), ("KurtoticNoise", &kurtotic)];
    for (name, noise) in noises {
        report.row(name, |bits| {
            for i in 0..POINTS {
                let (x, u) = (unit(i, 0) * 4.0 - 2.0, unit(i, 1));
                bits.push([noise.invert(x), noise.cdf(x), noise.warp_gaussian(x), noise.quantile(u)]);
            }
        });
    }
    Some(())
}

pub(crate) fn tell(report: &mut Report) {
    for part in [densities, tables, distributions] {
        if part(report).is_none() {
            report.row("invalid density", |_| ());
        }
    }
}
