//! Means over the facets that a view sees.

use asperity_ndf_sampling::{Ggx, Microfacet};
use glam::{Vec2, Vec3};

/// The view at this cosine and this share of the x-axis in its azimuth.
pub(crate) fn view(cosine: f64, share: f64) -> Vec3 {
    let z = cosine.clamp(1e-5, 1.0);
    let across = (1.0 - z * z).sqrt();
    Vec3::new((across * share.sqrt()) as f32, (across * (1.0 - share).sqrt()) as f32, z as f32)
}

/// The mean over visible normals of a function of the normal.
///
/// The normals are a Fibonacci lattice: total reflection has a kink along a curve, which a grid would
/// follow.
pub(crate) fn visible_mean(ggx: Ggx, wo: Vec3, normals: u32, of: impl Fn(Vec3) -> f32) -> f64 {
    // Seen along an axis the other half of the azimuths is symmetric.
    let turns = if wo.y == 0.0 { 0.5 } else { 1.0 };
    let [mut sum, mut all] = [0.0; 2];
    for k in 0..normals {
        // The tail is towards u₂ = 1. u₂ = 1 − t³ resolves it for every roughness.
        let t = (f64::from(k) + 0.5) / f64::from(normals);
        let u = Vec2::new(
            (turns * (0.5 + f64::from(k) * 0.618_033_988_749_894_9).fract()) as f32,
            (1.0 - t * t * t) as f32,
        );
        sum += t * t * f64::from(of(ggx.sample_visible(wo, u)));
        all += t * t;
    }
    sum / all
}
