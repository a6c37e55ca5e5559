//! Multiple scattering: albedos and the factor of single scattering.

use asperity_shading::glam::Vec3;
use asperity_shading::reflectance::{DirectionalAlbedo, EnergyCompensated, GgxAlbedo, GlassAlbedo};
use asperity_shading::{Dielectric, Ggx};
use asperity_wgsl::shading::reflectance::{GGX_ALBEDO, GLASS_ALBEDO};

use super::{direction, floats, inputs, number, share, vec3, words};
use crate::case::{Bound, Case, Output};

/// Constants are rounded before or after their difference.
const WRITTEN: Bound = Bound::Absolute(1e-6);

pub(super) fn cases() -> Vec<Case> {
    vec![albedos()]
}

fn albedos() -> Case {
    Case {
        name: "shading/reflectance/energy".into(),
        parts: vec![&GGX_ALBEDO, &GLASS_ALBEDO],
        body: "\
    let wo = bitcast<vec3<f32>>(c.xyz);
    let f = b.xyz;
    let albedo = ggx_albedo(a.xy, wo);
    let bounces = energy_bounces(f, ggx_mean_albedo(a.xy));
    outcome.a = bits(vec4<f32>(albedo, ggx_mean_albedo(a.xy), glass_albedo(a.xy, a.z, wo), ggx_schlick_moment(a.xy, wo)));
    outcome.b = bits(vec4<f32>(energy_factor(bounces, albedo), ggx_mean_schlick_moment(a.xy)));"
            .into(),
        resources: [
            ("ggx_albedo_number", GgxAlbedo::table().collect::<Vec<_>>()),
            ("glass_albedo_number", GlassAlbedo::table().collect()),
        ]
        .map(|(name, table)| (name, table.into_iter().map(f32::to_bits).collect()))
        .into(),
        input: Box::new(|i| {
            let alpha = [0, 1].map(|k| 10.0_f32.powf(number(i, k, [-3.0, 0.1])));
            let alpha_y = if i.is_multiple_of(2) { alpha[0] } else { alpha[1] };
            let eta = number(i, 2, [-1.0, 1.0]).exp();
            let wo = direction(i, 10) * if i.is_multiple_of(3) { -1.0 } else { 1.0 };
            let f = [3, 4, 5].map(|k| share(i, k));
            let mut words = inputs(i, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, wo.x, wo.y, wo.z]);
            words[..8]
                .copy_from_slice(&[alpha[0], alpha_y, eta, 0.0, f[0], f[1], f[2], 0.0].map(f32::to_bits));
            words
        }),
        reference: Box::new(|inputs| {
            let [x, y, eta] = floats(inputs, 0);
            let (ggx, f, wo) = (Ggx::new(x, y).expect("roughnesses"), vec3(inputs, 4), vec3(inputs, 8));
            let (albedo, index) = (GgxAlbedo::new(&ggx), Dielectric::new(eta).expect("an index"));
            let factor: Vec3 = EnergyCompensated::metal(ggx, f).factor(wo);
            let glass = GlassAlbedo::new(&ggx, &index).albedo(wo);
            let [schlick, mean] = [albedo.schlick_moment(wo), albedo.mean_schlick_moment()];
            let mirror = [albedo.albedo(wo), albedo.mean_albedo()];
            words(&[mirror[0], mirror[1], glass, schlick, factor.x, factor.y, factor.z, mean])
        }),
        outputs: vec![
            Output::new("mirror", 0..1, WRITTEN, Bound::Absolute(2e-5)),
            Output::new("mean", 1..2, WRITTEN, Bound::Absolute(2e-5)),
            Output::new("glass", 2..3, WRITTEN, Bound::Absolute(1e-4)),
            Output::new("schlick", 3..4, WRITTEN, Bound::Absolute(2e-5)),
            Output::new("mean schlick", 7..8, WRITTEN, Bound::Absolute(2e-5)),
            Output::new("factor", 4..7, Bound::Relative(2e-5), Bound::Relative(1e-4)),
        ],
    }
}
