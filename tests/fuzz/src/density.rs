//! Every density: parameters are accepted or rejected, and all results are finite, for any numbers
//! and directions.

use asperity_ndf_sampling::normal_map::NormalMapFormat;
use asperity_ndf_sampling::normal_table::{Chart, Spacing};
use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, Blend, BlinnPhong, Frame, GaussianDistribution, GaussianSplit, Ggx,
    KurtoticDistribution, Microfacet, Mixture, Ndf, NdfError, NoiseDistribution, Rotated, StudentT, Ward,
    add_detail, add_detail_normal, gaussian_cdf, inverse_gaussian_cdf,
};
use asperity_ndf_sampling::{ConditionalNdf, OffsetBeckmann};

use crate::numbers::Numbers;

/// Checks the invariants of every density.
pub(crate) fn ndf(ndf: &dyn Ndf, numbers: &mut Numbers<'_>) {
    let (z, u, m) = (numbers.pair(), numbers.pair(), numbers.direction());
    for normal in [ndf.warp_gaussian(z), ndf.sample(u)] {
        assert!((normal.length() - 1.0).abs() < 1e-5 && normal.z >= 0.0, "{normal} from {z} {u}");
        let back = ndf.invert(normal);
        assert!(back.is_finite(), "{back} of {normal}");
        density(ndf.d(normal));
        density(ndf.pdf(normal));
    }
    assert!(ndf.invert(m).is_finite(), "{m}");
    density(ndf.d(m));
    density(ndf.pdf(m));
    density(ndf.slope_density(numbers.pair()));
    let split = GaussianSplit::new(numbers.pair(), numbers.float());
    assert!((0.0..=1.0).contains(&split.resolved_variance()), "{split:?}");
    density(ndf.residual_ndf(m, split));
    let many = [m, numbers.direction(), numbers.vector()];
    let mut densities = [0.0; 3];
    ndf.residual_ndf_batch(&many, split, &mut densities);
    for (m, got) in many.into_iter().zip(densities) {
        assert_eq!(got.to_bits(), ndf.residual_ndf(m, split).to_bits(), "{m} {split:?}");
        density(got);
    }
    let bumped = add_detail_normal(&ndf, m, z, numbers.float());
    assert!((bumped.length() - 1.0).abs() < 1e-5, "{bumped}");
}

#[track_caller]
fn density(density: f32) {
    assert!(density >= 0.0 && density.is_finite(), "{density}");
}

/// Checks the invariants of densities with masking.
pub(crate) fn microfacet(facets: &impl Microfacet, numbers: &mut Numbers<'_>) {
    let (v, w, u) = (numbers.direction(), numbers.direction(), numbers.pair());
    assert!(facets.lambda(v) >= 0.0, "{v}");
    for share in [facets.g1(v), facets.g2(v, w), facets.g2_separable(v, w)] {
        assert!((0.0..=1.0).contains(&share), "{share} {v} {w}");
    }
    density(facets.projected_area(v));
    let m = facets.sample_visible(v, u);
    let name = std::any::type_name_of_val(facets);
    assert!((m.length() - 1.0).abs() < 1e-4 && m.z >= 0.0, "{name}: {m} from {v} {u}");
    let reflecting = facets.sample_reflecting(v, u);
    assert!((reflecting.length() - 1.0).abs() < 1e-4, "{name}: {reflecting} from {v} {u}");
    for normal in [m, w, reflecting] {
        density(facets.visible_pdf(v, normal));
        density(facets.reflecting_pdf(v, normal));
    }
}

fn refused(error: &NdfError) {
    assert_eq!(error.to_string().lines().count(), 1);
}

/// Checks a density with masking, if it is valid.
fn both<N: Microfacet + Copy>(made: Result<N, NdfError>, numbers: &mut Numbers<'_>) {
    match made {
        Ok(facets) => {
            ndf(&facets, numbers);
            microfacet(&facets, numbers);
            match Rotated::new(facets, numbers.float()) {
                Ok(turned) => {
                    ndf(&turned, numbers);
                    microfacet(&turned, numbers);
                }
                Err(error) => refused(&error),
            }
        }
        Err(error) => refused(&error),
    }
}

fn roughness(numbers: &mut Numbers<'_>) -> f32 {
    match numbers.byte() {
        0..=199 => numbers.between(1e-6, 1e6),
        _ => numbers.float(),
    }
}

pub(crate) fn attack(numbers: &mut Numbers<'_>) {
    let (x, y) = (roughness(numbers), roughness(numbers));
    match numbers.byte() % 12 {
        0 => both(Ggx::new(x, y), numbers),
        1 => both(Beckmann::new(x, y), numbers),
        2 => both(Ward::new(x, y), numbers),
        3 => {
            let gamma = if numbers.byte() < 200 { numbers.between(1.51, 1e12) } else { numbers.float() };
            both(StudentT::new(x, y, gamma), numbers);
        }
        4 => match BlinnPhong::new(numbers.between(1e-3, 1e13)) {
            Ok(blinn) => ndf(&blinn, numbers),
            Err(error) => refused(&error),
        },
        5 => both(AshikhminShirley::new(1e3 * x, 1e3 * y), numbers),
        6 => {
            let clamped = [numbers.float(), numbers.float(), numbers.float()];
            let [a, b, c] = clamped;
            both(Ok(Ggx::new_clamped(a, b)), numbers);
            both(Ok(StudentT::new_clamped(a, b, c)), numbers);
            both(Ok(AshikhminShirley::new_clamped(a, b)), numbers);
            ndf(&BlinnPhong::new_clamped(c), numbers);
        }
        7 => {
            let (Ok(a), Ok(b)) = (Ggx::isotropic(x), Beckmann::isotropic(y)) else { return };
            match Mixture::new(a, b, numbers.float()) {
                Ok(mixture) => {
                    ndf(&mixture, numbers);
                    microfacet(&mixture, numbers);
                }
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
        8 => {
            let (Ok(a), Ok(b)) = (Ggx::new(x, y), Beckmann::new(y, x)) else { return };
            match Blend::new(a, b, numbers.float()) {
                Ok(blend) => {
                    density(blend.d(numbers.direction()));
                    assert!(blend.sample(numbers.pair()).is_finite());
                    let v = numbers.direction();
                    assert!(blend.lambda(v) >= 0.0);
                    density(blend.projected_area(v));
                    let m = blend.sample_visible(v, numbers.pair());
                    assert!(m.is_finite());
                    density(blend.visible_pdf(v, m));
                }
                Err(error) => refused(&error),
            }
        }
        9 => {
            let Ok(ggx) = Ggx::new(x, y) else { return };
            ndf(&ConditionalNdf::new(ggx, numbers.pair(), numbers.float()), numbers);
            let Ok(beckmann) = Beckmann::new(x, y) else { return };
            ndf(&OffsetBeckmann::conditional(beckmann, numbers.pair(), numbers.float()), numbers);
            match OffsetBeckmann::new(numbers.pair(), [numbers.float(), numbers.float(), numbers.float()]) {
                Ok(offset) => ndf(&offset, numbers),
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
        10 => distributions(numbers),
        _ => rest(numbers),
    }
}

fn distributions(numbers: &mut Numbers<'_>) {
    if let Ok(noise) = GaussianDistribution::new(numbers.float()) {
        distribution(&noise, numbers);
    }
    match KurtoticDistribution::new(numbers.float(), numbers.float()) {
        Ok(noise) => distribution(&noise, numbers),
        Err(error) => refused(&error),
    }
    let (z, u) = (numbers.double(), numbers.double());
    let share = gaussian_cdf(z);
    assert!((0.0..=1.0).contains(&share) || z.is_nan(), "{z}: {share}");
    assert!(!inverse_gaussian_cdf(u).is_nan() || u.is_nan() || !(0.0..=1.0).contains(&u), "{u}");
}

/// Checks the invariants of every noise distribution.
pub(crate) fn distribution(noise: &dyn NoiseDistribution, numbers: &mut Numbers<'_>) {
    let (r, z, u) = (numbers.float(), numbers.float(), numbers.float());
    assert!(noise.invert(r).is_finite(), "{r}");
    assert!(!noise.warp_gaussian(z).is_nan(), "{z}");
    assert!((0.0..=1.0).contains(&noise.cdf(r)), "{r}");
    assert!(!noise.quantile(u).is_nan(), "{u}");
}

fn rest(numbers: &mut Numbers<'_>) {
    let frame = Frame::from_normal(numbers.direction());
    orthonormal(&frame);
    orthonormal(&Frame::from_normal_tangent(numbers.direction(), numbers.vector()));
    assert!(add_detail(numbers.pair(), numbers.pair(), numbers.float()).is_finite());
    let texel = [numbers.byte(), numbers.byte(), numbers.byte()];
    let n = NormalMapFormat::default().decode_u8(texel);
    assert!((n.length() - 1.0).abs() < 1e-5, "{n}");
    let n = NormalMapFormat::default().decode_signed(numbers.vector().to_array());
    assert!((n.length() - 1.0).abs() < 1e-5, "{n}");
    let _ = NormalMapFormat::default().encode_u16(numbers.vector());
    for chart in [Chart::Projected, Chart::Slopes, Chart::Stereographic] {
        let m = chart.to_normal(numbers.pair());
        assert!((m.length() - 1.0).abs() < 1e-5, "{m}");
        assert!(chart.to_point(numbers.direction()).is_finite());
    }
    for spacing in [Spacing::Coordinates, Spacing::Quantiles, Spacing::Warped] {
        assert!(spacing.coordinate(numbers.float()).is_finite());
        assert!((0.0..=1.0).contains(&spacing.place(numbers.float())));
    }
}

fn orthonormal(frame: &Frame) {
    let Frame { normal, tangent, bitangent } = *frame;
    for unit in [normal, tangent, bitangent] {
        assert!((unit.length() - 1.0).abs() < 1e-5, "{frame:?}");
    }
    for dot in [normal.dot(tangent), tangent.dot(bitangent), bitangent.dot(normal)] {
        assert!(dot.abs() < 1e-5, "{frame:?}");
    }
}
