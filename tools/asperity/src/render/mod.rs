//! `asperity render`: renders one image of one object.

mod files;
mod frames;
pub(crate) mod materials;
mod options;
mod picture;

use std::sync::atomic::AtomicBool;

use crate::cli::render::{Material, Render};
use crate::failure::{Interrupted, Result};
use crate::invocation::Invocation;
use crate::output::Output;
use crate::progress;
use crate::render::frames::Frames;
use crate::render::materials::Parameters;
use crate::render::picture::Picture;
use asperity_render::integrator::pixels::Watch;

/// Renders the image progressively, writes each pass, and prints the path.
pub(crate) fn render(wanted: &Render, invocation: &Invocation, interrupted: &AtomicBool) -> Result<()> {
    if let Some(material) = wanted.help_material {
        return help(material);
    }
    if let Some(frames) = Frames::of(wanted)? {
        return frames::draw(wanted, &frames, invocation, interrupted);
    }
    let picture = Picture::new(wanted)?;
    let output = Output::new(picture.folder.clone())?;
    let bar = progress::bar("render");
    let mut drawn = None;
    let result = picture.refined(Watch { progress: &bar, interrupted }, &mut |image, samples, noise| {
        let image = picture.developed(image);
        output.stream(&picture.name, |file| image.write(picture.format, file))?;
        let grain = if noise.is_finite() { format!(", noise {noise:.4}") } else { String::new() };
        let count = if samples == 1 { "1 sample".into() } else { format!("{samples} samples") };
        let progress = format!("{count} per pixel{grain}");
        bar.set_prefix(progress.clone());
        bar.set_length(0);
        bar.set_position(0);
        drawn = Some(progress);
        Ok(())
    });
    bar.finish_and_clear();
    let Some(progress) = drawn else { return result };
    match result {
        // The last finished pass was already written.
        Err(error) if error.is::<Interrupted>() => {}
        result => result?,
    }
    progress::say(&format!("image written to {} ({progress})", output.place(&picture.name)));
    Ok(())
}

/// Lists the parameters of a material.
fn help(material: Material) -> Result<()> {
    let own = Parameters::usual(material)?;
    let options = match material {
        Material::Bumps => {
            "--tint, --roughness or --ndf or --normal-map, --scale, --rule, --octaves, --frequency, --gain, --bump-noise"
        }
        Material::Chrome => "--tint, --roughness",
        _ => "--tint, --roughness, --scale",
    };
    progress::say(&format!("options: {options}"));
    let mut lines = own.lines().peekable();
    if lines.peek().is_some() {
        progress::say("parameters, set with --set name=value; colors are linear r,g,b or '#rrggbb':");
    }
    lines.for_each(|line| progress::say(&line));
    Ok(())
}
