//! Uniforms of materials. Each query takes the parameters in the order of the page's controls. It
//! returns the number of words of the material's uniform, that uniform, and the uniform of sums of
//! octaves.

use alloc::{string::String, string::ToString, vec::Vec};

use asperity_noise::gpu::FbmUniform3d;
use asperity_noise::{Fbm, FbmSpectrum, Normalization, Perlin, Turbulence};
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::material::{
    BrickWall, Elimination, FibersParameters, GlassBody, GlassWaves, PolishedMarble, SeamPattern,
};
use asperity_shading::texture::{Gas, Steam};
use asperity_shading::{
    Brick, Carpet, CarpetParameters, Marble, MetallicPaint, MetallicPaintParameters, Scratches,
    ScratchesParameters, ShadingError, TemperedGlass, TemperedGlassParameters, Variations,
    VariationsParameters,
};

use crate::words;

/// Consecutive numbers; 0 at the end.
struct Turn<'a>(core::slice::Iter<'a, f64>);

impl<'a> Turn<'a> {
    fn new(numbers: &'a [f64]) -> Self {
        Self(numbers.iter())
    }

    fn float(&mut self) -> f32 {
        self.0.next().copied().unwrap_or(0.0) as f32
    }

    fn whole(&mut self) -> u32 {
        self.0.next().copied().unwrap_or(0.0) as u32
    }

    fn is(&mut self) -> bool {
        self.float() != 0.0
    }

    fn plane(&mut self) -> Vec2 {
        Vec2::new(self.float(), self.float())
    }

    fn space(&mut self) -> Vec3 {
        Vec3::new(self.float(), self.float(), self.float())
    }
}

fn said(error: ShadingError) -> String {
    error.to_string()
}

fn answer(uniform: &impl bytemuck::NoUninit, sums: &[FbmUniform3d]) -> Vec<u32> {
    let uniform = words(uniform);
    let mut answer = Vec::from([uniform.len() as u32]);
    answer.extend(uniform);
    answer.extend(words(&FbmUniform3d::array(sums)));
    answer
}

pub(crate) fn paint(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let mut next = Turn::new(numbers);
    let parameters = MetallicPaintParameters {
        specular: next.space(),
        pigment: next.space(),
        flake_roughness: next.float(),
        flake_sparkle_pixel_size: next.float(),
        flake_sparkle_physical_size: next.float(),
        flake_sparkle_variation: next.float(),
        flake_sparkle_boost: next.float(),
        flake_sparkle_boost_target: next.space(),
        flake_sparkle_elimination: next.float(),
        smart_flake_sparkle: match (next.is(), next.float()) {
            (true, unit) => Elimination::Adaptive { unit },
            (false, _) => Elimination::Fixed,
        },
        passive_flake_size: next.float(),
        passive_flake_strength: next.float(),
        passive_flake_detail: next.whole(),
        orange_peel_strength: next.float(),
        orange_peel_size: next.float(),
        coat_index: next.float(),
        coat_roughness: next.float(),
        seed: next.whole(),
        ..Default::default()
    };
    let paint = MetallicPaint::new(parameters).map_err(said)?;
    Ok(answer(&paint.gpu(0), &paint.gpu_sums()))
}

pub(crate) fn carpet(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let mut next = Turn::new(numbers);
    let parameters = CarpetParameters {
        diffuse: next.space(),
        specular: next.space(),
        roughness: next.float(),
        specular_roughness: next.float(),
        diffuse_thread_size: next.float(),
        diffuse_thread_strength: next.float(),
        diffuse_thread_bump_strength: next.float(),
        specular_thread_size: next.float(),
        specular_thread_strength: next.float(),
        dark_area_size: next.float(),
        dark_area_strength: next.float(),
        seams_pattern: match next.whole() {
            0 => SeamPattern::None,
            1 => SeamPattern::Lines,
            _ => SeamPattern::Grid,
        },
        seams_propagation: next.plane(),
        seam_distance: next.float(),
        seams_amplitude: next.float(),
        seams_bump_strength: next.float(),
        seam_crossover_size: next.float(),
        seam_crossover_strength: next.float(),
        fiber_strength: next.float(),
        fiber_bump_strength: next.float(),
        fibers: FibersParameters {
            fiber_length: next.float(),
            fiber_width: next.float(),
            fiber_bend: next.float(),
            fiber_direction: next.plane(),
            fiber_spread: next.float(),
            fiber_contrast: next.float(),
            ..Default::default()
        },
        fake_rim_light: next.float(),
        fake_rim_light_width: next.float(),
        fake_rim_light_color: next.space(),
        seed: next.whole(),
    };
    let carpet = Carpet::new(parameters).map_err(said)?;
    Ok(answer(&carpet.gpu(0), &carpet.gpu_sums()))
}

pub(crate) fn glass(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let mut next = Turn::new(numbers);
    let parameters = TemperedGlassParameters {
        wave_frequency: next.float(),
        wave_amplitude: next.float(),
        wave_propagation_vector: next.space(),
        waves: if next.is() { GlassWaves::Noise } else { GlassWaves::Sine },
        body: if next.is() { GlassBody::Solid } else { GlassBody::Pane },
        index: next.float(),
        tint: next.space(),
        roughness: next.float(),
        seed: next.whole(),
    };
    let glass = TemperedGlass::new(parameters).map_err(said)?;
    Ok(answer(&glass.gpu(0), &[glass.gpu_sum()]))
}

pub(crate) fn scratches(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let mut next = Turn::new(numbers);
    let parameters = ScratchesParameters {
        scratch_size: next.float(),
        scratch_length: next.float(),
        scratch_width: next.float(),
        scratch_strength: next.float(),
        scratch_cover: next.float(),
        scratch_direction: next.plane(),
        scratch_spread: next.float(),
        specular: next.space(),
        roughness: next.float(),
        seed: next.whole(),
    };
    let scratches = Scratches::new(parameters).map_err(said)?;
    Ok(answer(&scratches.gpu(), &[]))
}

pub(crate) fn variations(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let mut next = Turn::new(numbers);
    let parameters = VariationsParameters {
        diffuse: next.space(),
        specular: next.space(),
        roughness: next.float(),
        gloss_roughness: next.float(),
        small_blemish_size: next.float(),
        small_blemish_bump_strength: next.float(),
        small_blemish_color_strength: next.float(),
        dent_strength: next.float(),
        dent_size: next.float(),
        dent_cover: next.float(),
        dent_detail: next.whole(),
        seed: next.whole(),
    };
    let variations = Variations::new(parameters).map_err(said)?;
    Ok(answer(&variations.gpu(0), &variations.gpu_sums()))
}

pub(crate) fn brick(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let mut next = Turn::new(numbers);
    let wall = BrickWall {
        bricks: Brick::new(next.float(), next.float(), next.float()).map_err(said)?,
        depth: next.float(),
        clay: next.space(),
        variation: next.float(),
        mortar: next.space(),
        roughness: next.float(),
    };
    Ok(answer(&wall.gpu(), &[]))
}

pub(crate) fn marble(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let mut next = Turn::new(numbers);
    let marble = Marble::new(Perlin::default(), next.float(), next.whole()).map_err(said)?;
    let stone = PolishedMarble { marble, tint: next.space(), polish: next.float() };
    Ok(answer(&stone.gpu(), &[]))
}

pub(crate) fn steam(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let mut next = Turn::new(numbers);
    let spectrum = FbmSpectrum::new(next.float(), next.float(), 8).map_err(|error| error.to_string())?;
    let octaves = Fbm::new(Perlin::new(next.whole()), spectrum)
        .with_normalization(Normalization::UnitRange)
        .with_shape(Turbulence)
        .with_octaves(next.float());
    let gas = Gas::new(octaves, next.float(), next.float()).map_err(said)?;
    let gas = if next.is() { gas.with_veins() } else { gas };
    Steam::new(Vec3::ZERO, next.float(), next.float()).map_err(said)?;
    Ok(answer(&gas.gpu(0), &[gas.gpu_sum()]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parameters_out_of_range_return_the_crate_message() {
        let mut numbers = [20.0, 1e-4, 0.0, 1.0, 0.0, 0.0, 0.0, 1.52, 1.0, 1.0, 1.0, 0.0, 1.0];
        assert_eq!(glass(&numbers, &[]).map(|words| words[0]), Ok(16));
        numbers[7] = 0.5;
        assert_eq!(glass(&numbers, &[]), Err("`index` must be between 1 and 4, got 0.5".into()));
    }

    #[test]
    fn missing_numbers_are_an_error_or_zero() {
        for question in [paint, carpet, glass, scratches, variations, brick, marble, steam] {
            let answer = question(&[], &[]);
            assert!(
                answer.as_ref().is_ok_and(|words| words.len() > 1)
                    || answer.is_err_and(|e| e.lines().count() == 1)
            );
        }
    }
}
