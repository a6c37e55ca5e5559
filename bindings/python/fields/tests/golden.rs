//! Golden values of the crates, which the tests of the Python package compare with its results.
//!
//! A line is an expression of Python and the bits of its numbers. The values here come from the types
//! of the crates, not from the types that are chosen at run time.

#![expect(clippy::unwrap_used, reason = "all parameters are valid")]

use std::fmt::Write as _;
use std::path::Path;

use asperity_fif::{Fif, HeightField, Intersect, Ray, fit, glam::DVec3};
use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, GaussianSplit, Ggx, Measure, Microfacet, Ndf, NdfMap,
    Reconstruction, StudentT, Ward, estimate_ndf,
};
use asperity_noise::glam::{Vec2, Vec3, Vec4};
use asperity_noise::ops::{Add, Clamp, Frequency, Multiply, Power, ScaleBias, Unit};
use asperity_noise::{
    Cellular, CellularOutput, Fbm, FbmSpectrum, Field, GaussianNoise, HasHessian, Metric, Normalization,
    Perlin, PerlinClassic, Point, Ridged, RidgedMultifractal, Rotation, Simplex, SparseConvolution,
    Turbulence, ValueCatmullRom, ValueGradient, ValueNoise, Warp, WhiteNoise,
};
use asperity_shading::reflectance::{CharlieSheen, EnergyCompensated, RoughDielectric};
use asperity_shading::{
    Brdf, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Lambert, OpenPbr, OpenPbrParameters,
    StandardMaterial, StandardMaterialParameters,
};

/// Point i: multiples of 1/16, a far point, and a point that is not finite.
fn point<V: Point>(i: usize) -> V {
    V::from_axes(|axis| match i {
        10 => 123_456.5 + axis as f32,
        11 => f32::NAN,
        _ => ((i * 37 + axis * 101) % 257) as f32 / 16.0 - 8.0,
    })
}

const POINTS: usize = 12;

/// Unit vectors.
const DIRECTIONS: [[f32; 3]; 6] = [
    [0.0, 0.0, 1.0],
    [0.6, 0.0, 0.8],
    [-0.48, 0.64, 0.6],
    [0.36, 0.48, 0.8],
    [0.28, -0.96, 0.0],
    [0.0, 0.6, -0.8],
];

/// Pairs of numbers in [0, 1).
const PAIRS: [[f32; 2]; 6] =
    [[0.5, 0.5], [0.125, 0.875], [0.0, 0.25], [0.75, 0.0625], [0.9375, 0.3125], [0.4375, 0.6875]];

struct Lines(String);

impl Lines {
    fn singles(&mut self, expression: &str, numbers: impl IntoIterator<Item = f32>) {
        let bits: Vec<String> = numbers.into_iter().map(|x| format!("{:08x}", x.to_bits())).collect();
        let _ = writeln!(self.0, "{expression}\t{}", bits.join(" "));
    }

    fn doubles(&mut self, expression: &str, numbers: impl IntoIterator<Item = f64>) {
        let bits: Vec<String> = numbers.into_iter().map(|x| format!("{:016x}", x.to_bits())).collect();
        let _ = writeln!(self.0, "{expression}\t{}", bits.join(" "));
    }

    /// Values and gradients of a field.
    fn field<V: Point>(&mut self, expression: &str, field: &dyn Field<V>) {
        let n = V::default().coordinates().as_ref().len();
        let samples: Vec<_> = (0..POINTS).map(|i| field.sample(point::<V>(i))).collect();
        self.singles(&format!("({expression})(P{n})"), samples.iter().map(|sample| sample.value));
        let gradients = samples.iter().flat_map(|s| s.gradient.coordinates().as_ref().to_vec());
        self.singles(&format!("({expression})(P{n}, with_gradient=True).gradient"), gradients);
    }

    /// A kind in every dimension.
    fn kind<K: Field<f32> + Field<Vec2> + Field<Vec3> + Field<Vec4>>(&mut self, expression: &str, kind: &K) {
        self.field::<f32>(expression, kind);
        self.field::<Vec2>(expression, kind);
        self.field::<Vec3>(expression, kind);
        self.field::<Vec4>(expression, kind);
    }
}

fn kinds(lines: &mut Lines) {
    lines.kind("White(3)", &WhiteNoise::new(3));
    lines.kind("Value(3)", &ValueNoise::new(3));
    lines.kind("ValueCatmullRom(3)", &ValueCatmullRom::new(3));
    lines.kind("PerlinClassic(3)", &PerlinClassic::new(3));
    lines.kind("Perlin(3)", &Perlin::new(3));
    lines.kind("ValueGradient(3, weight=0.25)", &ValueGradient::new(3).with_weight(0.25).unwrap());
    lines.kind("Simplex(3)", &Simplex::new(3));
    lines.kind("Simplex(3, classic_radius=True)", &Simplex::new(3).with_classic_radius());
    lines.kind("SparseConvolution(3, impulses=2)", &SparseConvolution::new(3).with_impulses(2).unwrap());
    lines.kind("Gaussian(3)", &GaussianNoise::new(3));
    let cellular = Cellular::new(3);
    lines.kind("Cellular(3)", &cellular);
    lines.kind("Cellular(3, output='f2')", &cellular.with_output(CellularOutput::F2));
    let manhattan = cellular.with_output(CellularOutput::F2MinusF1).with_metric(Metric::Manhattan);
    lines.kind("Cellular(3, output='f2_minus_f1', metric='manhattan')", &manhattan);
    let cells = cellular.with_output(CellularOutput::Cell).with_metric(Metric::Chebyshev);
    let cells = cells.with_jitter(0.5).unwrap();
    lines.kind("Cellular(3, output='cell', metric='chebyshev', jitter=0.5)", &cells);
}

fn sums(lines: &mut Lines) {
    let spectrum = FbmSpectrum::default();
    lines.field::<Vec2>("Fbm(Perlin(5))", &Fbm::new(Perlin::new(5), spectrum));
    lines.field::<Vec3>(
        "Fbm(Simplex(5), octaves=3.5)",
        &Fbm::new(Simplex::new(5), spectrum).with_octaves(3.5),
    );
    lines
        .field::<Vec4>("Fbm(Value(5), octaves=3)", &Fbm::new(ValueNoise::new(5), spectrum).with_octaves(3.0));
    let aligned = Fbm::new(Perlin::new(5), FbmSpectrum::new(2.0, 0.6, 12).unwrap());
    let aligned = aligned.with_normalization(Normalization::UnitRange).with_rotation(Rotation::Aligned);
    lines.field::<Vec2>(
        "Fbm(Perlin(5), lacunarity=2, gain=0.6, max_octaves=12, normalization='unit_range', rotation='aligned')",
        &aligned,
    );
    let shaped = Fbm::<_, Vec3>::new(Perlin::new(5), spectrum).with_octaves(4.0);
    lines.field("Fbm(Perlin(5), octaves=4, shape='turbulence')", &shaped.with_shape(Turbulence));
    let band_limited = shaped.with_shape(Ridged).band_limited(0.1);
    lines.field("Fbm(Perlin(5), octaves=4, shape='ridged', footprint=0.1)", &band_limited);
    let ridged = RidgedMultifractal::<_, Vec2>::new(Perlin::new(5), spectrum, 1.5).unwrap();
    lines.field("RidgedMultifractal(Perlin(5), feedback=1.5, octaves=5)", &ridged.with_octaves(5.0));
    lines.field::<Vec2>("Perlin(5, period=8)", &Perlin::new(5).tiled([8, 8]).unwrap());
    lines.field::<Vec3>("Simplex(5, period=(3, 6, 9))", &Simplex::new(5).tiled([3, 6, 9]).unwrap());
    let tile = Fbm::<_, Vec2>::new(Perlin::new(5), FbmSpectrum::CLOUD).tiled([8, 5]).unwrap();
    lines.field("Fbm(Perlin(5), period=(8, 5))", &tile);
    let far = Fbm::<_, Vec3>::new(Simplex::new(5), spectrum).anchored([1e9, -2e9, 3.25]);
    lines.field("Fbm(Simplex(5), anchor=(1e9, -2e9, 3.25))", &far);
    let far = Fbm::<_, Vec2>::single(Perlin::new(5)).anchored([1e9, 1e9]);
    lines.field("Perlin(5, anchor=1e9)", &far);
}

fn transforms(lines: &mut Lines) {
    let (a, b) = (Perlin::new(1), Simplex::new(2));
    lines.field::<Vec2>("Perlin(1) + 0.5 * Simplex(2)", &Add(a, ScaleBias(b, 0.5, 0.0)));
    lines.field::<Vec3>("Perlin(1) * Simplex(2) - 1", &ScaleBias(Multiply(a, b), 1.0, -1.0));
    lines.field::<Vec2>("-Perlin(1).clamp(-0.1, 0.2)", &ScaleBias(Clamp(a, -0.1, 0.2), -1.0, 0.0));
    lines.field::<Vec2>("Perlin(1).unit() ** 3", &Power(Unit(a), 3));
    lines.field::<Vec3>("Perlin(1, frequency=2.5)", &Frequency(a, 2.5));
    let warp = Warp::new(a, [b, Simplex::new(7)], 0.3).unwrap();
    lines.field::<Vec2>("Perlin(1).warp([Simplex(2), Simplex(7)], 0.3)", &warp);
    let jets: Vec<_> = (0..POINTS).map(|i| Perlin::new(1).sample_with_hessian(point::<Vec2>(i))).collect();
    let hessians = jets.iter().flat_map(|jet| jet.hessian.as_flattened().to_vec());
    lines.singles("Perlin(1)(P2, with_hessian=True).hessian", hessians);
}

fn distributions(lines: &mut Lines) {
    let directions = DIRECTIONS.map(Vec3::from);
    let mut all = |expression: &str, ndf: &dyn Microfacet| {
        lines.singles(&format!("{expression}.d(M)"), directions.map(|m| ndf.d(m)));
        lines.singles(&format!("{expression}.pdf(M)"), directions.map(|m| ndf.pdf(m)));
        let sample = PAIRS.iter().flat_map(|&u| ndf.sample(Vec2::from(u)).to_array());
        lines.singles(&format!("{expression}.sample(U)"), sample);
        let inverse = directions.iter().flat_map(|&m| ndf.invert(m).to_array());
        lines.singles(&format!("{expression}.invert(M)"), inverse);
        lines.singles(&format!("{expression}.g2(M, M[1])"), directions.map(|v| ndf.g2(v, directions[1])));
        let split = GaussianSplit::new(Vec2::new(0.5, -0.25), 0.75);
        let rest = directions.map(|h| ndf.residual_ndf(h, split));
        lines.singles(&format!("{expression}.residual_ndf(M, [0.5, -0.25], 0.75)"), rest);
    };
    all("ndf.ggx(0.2, 0.4)", &Ggx::new(0.2, 0.4).unwrap());
    all("ndf.beckmann(0.3)", &Beckmann::new(0.3, 0.3).unwrap());
    all("ndf.ward(0.3, 0.1)", &Ward::new(0.3, 0.1).unwrap());
    all("ndf.student_t(0.3, 0.2, 3)", &StudentT::new(0.3, 0.2, 3.0).unwrap());
    all("ndf.blinn_phong(20)", &BlinnPhong::new(20.0).unwrap());
    all("ndf.ashikhmin_shirley(10, 50)", &AshikhminShirley::new(10.0, 50.0).unwrap());
    // Rows of the array from the top, of the map from the bottom.
    let texels: Vec<f32> = (0..64).map(|i| ((i * 7) % 11) as f32).collect();
    let rows: Vec<f32> = texels.chunks(8).rev().flatten().copied().collect();
    let (measure, reconstruction) = (Measure::ProjectedSolidAngle, Reconstruction::Bilinear);
    let map = NdfMap::from_texels(8, 8, &rows, measure, reconstruction).unwrap();
    lines.singles("ndf.from_array(TEXELS).d(M)", directions.map(|m| map.d(m)));
    let estimated = estimate_ndf(&directions[..4]).unwrap();
    lines.singles("ndf.estimate(M[:4]).d(M)", directions.map(|m| estimated.d(m)));
}

fn functions(lines: &mut Lines) {
    let x: Vec<f64> = (0..9).map(|i| f64::from(i) / 4.0 - 0.25).collect();
    let takagi = Fif::affine(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0], &[0.5, 0.5]).unwrap();
    lines.doubles("TAKAGI(X)", x.iter().map(|&x| takagi.evaluate(x, 0.0).value));
    lines.doubles(
        "TAKAGI.bounded(X, tolerance=1e-6).bound",
        x.iter().map(|&x| takagi.evaluate(x, 1e-6).bound),
    );
    lines.doubles("TAKAGI.integrate(X, 1.5).value", x.iter().map(|&x| takagi.integral_over(x, 1.5).value));
    lines.doubles("TAKAGI.moment(1, 2)[0]", [takagi.moment(1, 2).unwrap().value]);
    lines.doubles("TAKAGI.dimension", [takagi.dimension().lo, takagi.dimension().hi]);
    let smooth: Fif<3> = takagi.integral(0.0).unwrap();
    lines.doubles("TAKAGI.integral()(X)", x.iter().map(|&x| smooth.evaluate(x, 0.0).value));
    let hermite = Fif::hermite(&[0.0, 1.0, 3.0], &[0.0, 2.0, 1.0], &[1.0, 0.0, -1.0], &[0.2, -0.3]).unwrap();
    lines.doubles(
        "fif.hermite([0, 1, 3], [0, 2, 1], [1, 0, -1], [0.2, -0.3])(X)",
        x.iter().map(|&x| hermite.evaluate(x, 0.0).value),
    );
    let data: Vec<f64> = (0..33).map(|i| f64::from(i * i % 19)).collect();
    let at: Vec<f64> = (0..33).map(f64::from).collect();
    let fitted = fit::affine(&at, &data, &[0, 8, 20, 32]).unwrap();
    lines.doubles("fif.fit(range(33), [i * i % 19 for i in range(33)], [0, 8, 20, 32]).rms", [fitted.rms]);
    // With four coefficients, as the surfaces of the package have them.
    let q: Vec<[f64; 4]> =
        smooth.pieces().iter().map(|p| [p.map().q[0], p.map().q[1], p.map().q[2], 0.0]).collect();
    let alpha: Vec<f64> = smooth.pieces().iter().map(|p| p.map().alpha).collect();
    let values: Vec<f64> = [0.0, 1.0, 2.0].map(|x| smooth.evaluate(x, 0.0).value).to_vec();
    let cubic = || Fif::<4>::with_ordinates(&[0.0, 1.0, 2.0], &values, &alpha, &q).unwrap();
    let surface = HeightField::new(cubic(), cubic()).tabulated();
    let ray = Ray { origin: DVec3::new(0.1, 0.2, 3.0), direction: DVec3::new(0.5, 0.5, -1.0) };
    let hit = surface.intersect(&ray).unwrap();
    lines.doubles(
        "fif.product_surface(TAKAGI.integral(), TAKAGI.integral()).intersect([0.1, 0.2, 3], [0.5, 0.5, -1]).t",
        [hit.t],
    );
}

fn reflectances(lines: &mut Lines) {
    let directions = DIRECTIONS.map(Vec3::from);
    let mut all = |expression: &str, brdf: &dyn Brdf| {
        let wo = directions[1];
        let eval = directions.iter().flat_map(|&wi| brdf.eval(wo, wi).to_array());
        lines.singles(&format!("{expression}.eval(M[1], M)"), eval);
        lines.singles(&format!("{expression}.pdf(M[1], M)"), directions.map(|wi| brdf.pdf(wo, wi)));
        let samples = PAIRS.iter().flat_map(|&u| {
            brdf.sample(wo, 0.375, Vec2::from(u)).map_or([0.0; 3], |sample| sample.wi.to_array())
        });
        lines.singles(&format!("{expression}.sample(M[1], 0.375, U).wi"), samples);
    };
    let color = Vec3::new(0.8, 0.5, 0.25);
    all("shading.lambert(COLOR)", &Lambert::new(color).unwrap());
    all("shading.oren_nayar(COLOR, 0.5)", &EnergyPreservingOrenNayar::new(color, 0.5).unwrap());
    all("shading.charlie_sheen(COLOR, 0.4)", &CharlieSheen::new(color, 0.4).unwrap());
    let ggx = Ggx::new(0.3, 0.2).unwrap();
    all("shading.metal(ndf.ggx(0.3, 0.2), COLOR)", &CookTorrance::new(ggx, color));
    all("shading.ggx_metal(0.3, 0.2, f0=COLOR)", &EnergyCompensated::metal(ggx, color));
    let glass = Dielectric::new(1.5).unwrap();
    all("shading.dielectric(ndf.ggx(0.3, 0.2), 1.5)", &RoughDielectric::new(ggx, glass));
    let paint = StandardMaterialParameters {
        base_color: color,
        metallic: 0.0,
        roughness: 0.5,
        clearcoat: 1.0,
        ..Default::default()
    };
    all(
        "shading.standard_material(base_color=COLOR, metallic=0, roughness=0.5, clearcoat=1)",
        &StandardMaterial::new(paint).unwrap(),
    );
    let wet = OpenPbrParameters { base_color: color, coat_weight: 1.0, ..Default::default() };
    all("shading.open_pbr(base_color=COLOR, coat_weight=1)", &OpenPbr::new(wet).unwrap());
}

fn lines() -> String {
    let mut lines = Lines(String::new());
    kinds(&mut lines);
    sums(&mut lines);
    transforms(&mut lines);
    distributions(&mut lines);
    functions(&mut lines);
    reflectances(&mut lines);
    lines.0
}

fn file() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/golden.tsv")
}

#[test]
fn golden_values_are_up_to_date() {
    let found = std::fs::read_to_string(file()).unwrap();
    let expected = lines();
    for (found, expected) in found.lines().zip(expected.lines()) {
        assert_eq!(found, expected);
    }
    assert_eq!(found.len(), expected.len());
}

#[test]
#[ignore = "writes the golden values"]
fn write_golden_values() {
    std::fs::write(file(), lines()).unwrap();
}
