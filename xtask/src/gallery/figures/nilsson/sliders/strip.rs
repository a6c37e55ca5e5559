//! A strip: one parameter of a material varied, all others kept.

use std::{fmt::Debug, sync::Arc};

use asperity_render::geometry::ray::Ray;
use asperity_render::image::Image;
use asperity_render::image::tone::hex;
use asperity_render::integrator::pixels::Sampling;
use asperity_render::light::lamps::{Lamp, Lamps, direction};
use asperity_render::materials::in_metres;
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::scenes::Form;
use asperity_shading::{ParameterError, material::Material};
use glam::Vec3;

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::figures::nilsson::sliders::fields::{fields, varied};

/// A parameter that is varied.
pub(super) struct Strip<P> {
    pub(super) field: &'static str,
    pub(super) options: Vec<P>,
    pub(super) view: View,
}

/// From where and in what light a material is seen.
#[derive(Clone)]
pub(super) struct View {
    pub(super) form: Form,
    pub(super) lamps: Vec<Lamp>,
    pub(super) mirrored: fn(&Ray) -> Vec3,
    pub(super) exposure: f32,
}

impl View {
    /// A patch so high, lit from the upper left, where bumps show, and a little from the right.
    pub(super) fn patch(height: f32) -> Self {
        let lamp = |azimuth, elevation, colour| Lamp { direction: direction(azimuth, elevation), colour };
        Self {
            form: Form::Patch { height, distance: 1e3 },
            lamps: vec![lamp(128.0, 42.0, hex(0xff_f2e2) * 1.1), lamp(-20.0, 60.0, hex(0xb9_d0ff) * 0.35)],
            mirrored: |_| Vec3::ZERO,
            exposure: 1.0,
        }
    }

    /// A ball of this diameter, of which so much is seen, lit from the upper left, from the right and from behind.
    pub(super) fn ball(diameter: f32, height: f32) -> Self {
        let lamp = |azimuth, elevation, colour| Lamp { direction: direction(azimuth, elevation), colour };
        Self {
            form: Form::Ball { diameter, height },
            lamps: vec![
                lamp(-132.0, 46.0, hex(0xff_f2e2)),
                lamp(-18.0, 22.0, hex(0xb9_d0ff) * 0.4),
                lamp(100.0, 40.0, hex(0xff_d6a8) * 0.5),
            ],
            mirrored: |_| Vec3::ZERO,
            exposure: 1.0,
        }
    }

    pub(super) fn exposed(self, exposure: f32) -> Self {
        Self { exposure, ..self }
    }

    /// With lamps so many times as bright.
    pub(super) fn lit(mut self, brightness: f32) -> Self {
        for lamp in &mut self.lamps {
            lamp.colour *= brightness;
        }
        self
    }

    /// With one lamp beside the eye of a ball: a full moon, nearly.
    pub(super) fn lit_from_the_eye(self) -> Self {
        Self { lamps: vec![Lamp { direction: direction(-104.0, 14.0), colour: hex(0xff_f2e2) }], ..self }
    }

    /// Height of the visible part in words.
    fn words(&self) -> String {
        let (Form::Patch { height, .. } | Form::Ball { height, .. }) = self.form;
        let thousandths = (height * 1e3).round();
        let [length, unit] = match thousandths {
            t if t < 20.0 => [t.to_string(), "mm".to_owned()],
            t if t < 1000.0 => [(t / 10.0).to_string(), "cm".to_owned()],
            t => [(t / 1e3).to_string(), "m".to_owned()],
        };
        format!("{length} {unit} high")
    }
}

/// All strips of a material.
pub(super) fn draw<P: Copy + Debug + Default, M: Material + Sync>(
    context: &Context<'_>,
    strips: &[Strip<P>],
    material: impl Fn(P) -> Result<M, ParameterError>,
) -> Result<Drawn, Failure> {
    let panels = strips.iter().map(|strip| strip.panel(context, &material)).collect::<Result<_, _>>()?;
    Ok(Drawn::new(2, panels).fact("samples per pixel", samples(context).to_string()))
}

/// Twice those of other pictures, for detail as fine as pixels.
fn samples(context: &Context<'_>) -> u32 {
    context.samples_per_pixel.saturating_mul(2)
}

impl<P: Copy + Debug + Default> Strip<P> {
    fn panel<M: Material + Sync>(
        &self,
        context: &Context<'_>,
        material: &impl Fn(P) -> Result<M, ParameterError>,
    ) -> Result<Panel, Failure> {
        let (across, gap) = (context.size * 3 / 2, (context.size / 96).max(1));
        // As high as one of five is wide.
        let height = (across - 4 * gap) / 5;
        let count = self.options.len() as u32;
        let width = (across - (count - 1) * gap) / count;
        let sampling = Sampling { width, height, samples_per_pixel: samples(context), seed: context.seed };
        let View { form, lamps, mirrored, exposure } = &self.view;
        let shape = Arc::new(form.shape());
        let mut pictures = Vec::new();
        for &parameters in &self.options {
            let objects =
                vec![Object::new(Arc::clone(&shape), in_metres(material(parameters)?, form.metres()))];
            let light = Light::Lamps { lamps: vec![Lamps::open(lamps.clone())], room: mirrored };
            let scene = Scene::new(objects, light, Backdrop::Studio);
            pictures.push(context.draw(&scene, sampling, &form.camera([width, height]))?.filmic(*exposure));
        }
        let image = side_by_side(&pictures, gap, hex(0x1d_1f23));
        let values = varied(&self.values());
        let alt = format!(
            "{count} pictures of the same surface: {} is {} on the left and {} on the right",
            self.field,
            values.first().map_or("", String::as_str),
            values.last().map_or("", String::as_str)
        );
        Ok(Panel::raster(self.field.replace('_', "-"), self.label(), alt, image))
    }

    /// The name of the field, its values, what else is not the default, and how much is seen.
    pub(super) fn label(&self) -> String {
        let default = fields(&P::default());
        let own = |(name, _): &&(String, String)| name == self.field;
        let usual = default.iter().find(own).map_or("", |(_, value)| value);
        let values = self.values();
        let marked = values.iter().zip(varied(&values)).map(|(value, words)| match value {
            value if value == usual => words + " (default)",
            _ => words,
        });
        let values: Vec<_> = marked.collect();
        let mut label = format!("{}: {}", self.field, values.join(" \u{b7} "));
        let base = self.options.first().map(fields).unwrap_or_default();
        let others = base.iter().zip(&default).filter(|(a, b)| a != b && a.0 != self.field);
        for (index, ((name, value), _)) in others.enumerate() {
            label += if index == 0 { "; with " } else { ", " };
            label += &format!("{name} {value}");
        }
        label + "; " + &self.view.words()
    }

    /// The value of the field in each picture.
    pub(super) fn values(&self) -> Vec<String> {
        let value = |parameters: &P| {
            let all = fields(parameters);
            all.into_iter().find(|(name, _)| name == self.field).map(|(_, value)| value)
        };
        self.options.iter().filter_map(value).collect()
    }
}

/// Pictures of equal heights in a row.
fn side_by_side(pictures: &[Image], gap: u32, between: Vec3) -> Image {
    let [width, height] = pictures.first().map_or([1, 1], |picture| [picture.width, picture.height]);
    let step = width + gap;
    let across = (step * pictures.len() as u32).saturating_sub(gap);
    Image::from_fn(across, height, |x, y| {
        let picture = &pictures[(x / step) as usize];
        if x % step < width { picture.pixels[(y * width + x % step) as usize] } else { between }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_stand_side_by_side() {
        let plain = |value| Image::from_fn(2, 2, |_, _| Vec3::splat(value));
        let row = side_by_side(&[plain(1.0), plain(2.0)], 1, Vec3::ZERO);
        assert_eq!([row.width, row.height], [5, 2]);
        assert_eq!([0, 1, 2, 3, 4].map(|x| row.at(x, 1).x), [1.0, 1.0, 0.0, 2.0, 2.0]);
    }
}
