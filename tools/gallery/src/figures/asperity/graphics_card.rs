//! The shaders on the available GPU, compared with the crates.

use std::path::Path;

use asperity_render::image::content::Content;
use asperity_render::image::read::ImageFile;
use asperity_render::image::{Image, tone::linear};
use glam::Vec3;

use crate::figure::{Context, Drawn, Panel};
use asperity::failure::{Failure, Result};
use asperity::progress;
use asperity_output::cargo::{SHADERS, cargo, shaders};

pub(crate) fn draw_teapot(context: &Context<'_>) -> Result<Drawn> {
    let alt = "A copper teapot, from the whole to single bumps, rendered twice.";
    draw(context, "teapot", "×1, ×10, ×100, ×10⁴", alt)
}

pub(crate) fn draw_plane(context: &Context<'_>) -> Result<Drawn> {
    let alt =
        "A copper plane up to the horizon with a broad highlight that breaks up into bumps, rendered twice.";
    draw(context, "plane", "×1, ×10, ×100, ×10⁴", alt)
}

pub(crate) fn draw_textured(context: &Context<'_>) -> Result<Drawn> {
    let alt = "A teapot and a plane at two zooms; below, the same with slightly sharper bumps.";
    draw(context, "textured", "teapot and plane at ×1, then at ×10", alt)
}

pub(crate) fn draw_materials(context: &Context<'_>) -> Result<Drawn> {
    let alt = "Floors of carpet, paint, scratched and dented metal, glass, brick, tiles and bumps, each rendered twice.";
    draw(context, "materials", "by the shader; below, by the crates", alt)
}

/// Returns the program's image and table. If the program cannot be built or finds no adapter,
/// returns the image in the repository.
fn draw(context: &Context<'_>, subject: &str, label: &str, alt: &str) -> Result<Drawn> {
    let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let folder = tempfile::tempdir()?;
    let file = format!("gpu-{subject}.png");
    let found = if context.drivers {
        on_adapter(context, root, subject, folder.path())?
    } else {
        Err("`cargo xtask gallery --only gpu` draws it on this machine".to_owned())
    };
    context.checkpoint()?;
    let (path, said) = match &found {
        Ok(said) => (folder.path().join(&file), said.as_str()),
        Err(why) => {
            progress::say(&format!("  using {file} from the repository: {why}"));
            (root.join("docs/pictures").join(&file), "rendered earlier, by llvmpipe")
        }
    };
    let picture = image(&path)?;
    let mut panel = Panel::new(subject, label, alt, picture);
    panel.span = 4;
    let mut lines = said.lines().filter(|line| !line.is_empty());
    let drawn = Drawn::new(4, vec![panel]).fact("adapter", lines.next().unwrap_or_default());
    let mut rows = lines.filter(|line| line.starts_with("| ")).map(cells);
    Ok(match rows.next() {
        Some(head) => drawn.table(head, rows),
        None => drawn,
    })
}

/// Returns the program's output about an image, or the reason why there is no image.
fn on_adapter(
    context: &Context<'_>,
    root: &Path,
    subject: &str,
    folder: &Path,
) -> Result<Result<String, String>> {
    let built = cargo(&root.join(SHADERS), "build --quiet --release --locked").output()?;
    if !built.status.success() {
        return Ok(Err(format!("`cargo build` in {SHADERS} failed")));
    }
    let mut pictures = shaders(root, "pictures");
    pictures.args(["--fastest", "--only", subject, "--size", &context.size.to_string(), "--out"]).arg(folder);
    let output = pictures.output()?;
    let error = String::from_utf8_lossy(&output.stderr);
    let error = error.lines().rev().find_map(|line| line.strip_prefix("error: ")).unwrap_or_default();
    match (output.status.success(), error) {
        (true, _) => Ok(Ok(String::from_utf8_lossy(&output.stdout).into_owned())),
        (false, none) if none.starts_with("no adapter") => Ok(Err(none.to_owned())),
        (false, broken) => Err(Failure::from(format!("the shaders' {subject}: {broken}"))),
    }
}

fn cells(row: &str) -> Vec<String> {
    row.trim_matches('|').split('|').map(|cell| cell.trim().to_owned()).collect()
}

/// Returns the linear radiance of an sRGB image.
fn image(path: &Path) -> Result<Image> {
    let file =
        ImageFile::open(path, Content::Colors).map_err(|error| format!("{}: {error}", path.display()))?;
    let [r, g, b] = file.colors();
    let at = |x: u32, y: u32| y as usize * file.width + x as usize;
    Ok(Image::from_fn(file.width as u32, file.height as u32, |x, y| {
        let i = at(x, y);
        Vec3::new(linear(r[i]), linear(g[i]), linear(b[i]))
    }))
}

#[cfg(test)]
mod tests {
    use asperity_render::image::Format;

    use super::*;

    #[test]
    fn table_rows_become_cells() {
        assert_eq!(cells("| teapot-1 | 0.001 % | 0.00 | 227 |"), ["teapot-1", "0.001 %", "0.00", "227"]);
    }

    #[test]
    fn images_in_the_repository_keep_their_bytes() {
        let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
        for subject in ["teapot", "plane", "textured", "materials"] {
            let path = root.join("docs/pictures").join(format!("gpu-{subject}.png"));
            let [before, after] = [
                ImageFile::open(&path, Content::Colors).unwrap(),
                ImageFile::decode(&image(&path).unwrap().encode(Format::Png).unwrap(), Content::Colors)
                    .unwrap(),
            ];
            assert_eq!(before, after, "{subject}");
        }
    }
}
