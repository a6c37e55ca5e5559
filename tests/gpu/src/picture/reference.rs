//! Images rendered by the crates.

use asperity_shading::ndf_sampling::{Frame, Ggx};
use asperity_shading::{Footprint, LevelOfDetail, half_vector, level_of_detail::ResolvedBumps};
use glam::Vec3;

use crate::picture::{
    Look, raster,
    scene::{Corner, Scene},
};

/// Returns the 8-bit sRGB color of every pixel.
///
/// `bumps` returns the resolved bumps at a surface point with a frame.
pub(crate) fn picture(
    scene: &Scene,
    look: &Look,
    bumps: impl Fn(&Corner, &Frame, Footprint) -> ResolvedBumps,
    size: u32,
) -> Result<Vec<[u8; 3]>, String> {
    let ggx = Ggx::new(look.alpha.x, look.alpha.y).map_err(|error| error.to_string())?;
    let light = scene.view.light.as_vec3();
    let pixels = raster::seen(scene, size).into_iter();
    Ok(pixels
        .map(|seen| {
            let Some(seen) = seen else { return BACKGROUND };
            let corner = seen.corner(scene);
            let frame = Frame::from_normal_tangent(corner.normal.as_vec3(), corner.tangent.as_vec3());
            let from_eye = corner.position - scene.view.eye;
            let wo = -from_eye.normalize().as_vec3();
            let [cos_eye, cos_light] = [wo, light].map(|w| w.dot(frame.normal));
            if cos_eye.is_nan() || cos_eye <= 0.0 {
                return tone(0.0);
            }
            let pixel =
                Footprint::from_distance(from_eye.length() as f32, scene.view.pixel_angle as f32, cos_eye);
            let mut coordinates = bumps(&corner, &frame, pixel);
            coordinates.variance = coordinates.variance.min(look.share);
            let h = frame.to_local(half_vector(light, wo));
            let lamp = LevelOfDetail::Exact.radiance(&ggx, h, coordinates) * cos_light.max(0.0);
            let m = frame.to_world(LevelOfDetail::Exact.normal(&ggx, coordinates));
            tone((lamp + sky(2.0 * m.dot(wo) * m - wo, light)) * look.exposure)
        })
        .collect())
}

/// A sky by the elevation of a direction, with a broad glow about the light.
fn sky(direction: Vec3, light: Vec3) -> f32 {
    let square = direction.dot(light).max(0.0).powi(2);
    0.05 + 0.1 * direction.z.max(0.0) + 0.5 * square * square * square
}

/// Background color.
pub(crate) const BACKGROUND: [u8; 3] = [236, 234, 228];

/// Returns sRGB of radiance compressed into [0, 1), as in the shader.
fn tone(light: f32) -> [u8; 3] {
    let linear = light * Vec3::new(1.0, 0.62, 0.36) + Vec3::new(0.012, 0.009, 0.008);
    encoded(linear)
}

/// Returns sRGB of radiance compressed into [0, 1).
pub(super) fn encoded(light: Vec3) -> [u8; 3] {
    (light / (1.0 + light)).to_array().map(|x| {
        let encoded = if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
        (encoded * 255.0).round() as u8
    })
}
