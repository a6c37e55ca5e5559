//! Densities from the outside: `ggx:0.2,0.4`, `beckmann:0.3`, `painted`, or an image file.

use std::path::Path;

use asperity_ndf_sampling::{Beckmann, Ggx, Measure, NdfMap, Reconstruction, glam::Vec3};

use crate::{
    cli,
    figure::Failure,
    image_file::{ImageFile, ImageFileError},
    output::sha256,
    scene::material::SharedNdf,
};

/// Texels per side of the maps that are made from functions.
pub(crate) const SIZE: usize = 256;

/// What a specification is when it is no file.
const FORMS: &str = "neither `ggx:…`, `beckmann:…` nor `painted`";

/// A density of normals with the words that asked for it.
pub(crate) struct Density {
    spec: String,
    form: Form,
}

enum Form {
    Ggx(Ggx),
    Beckmann(Beckmann),
    Map(Box<NdfMap>),
}

impl Density {
    /// Reads a specification; an image is read from the file of that name.
    pub(crate) fn parse(text: &str, measure: cli::Measure) -> Result<Self, Failure> {
        let fail = |error: &dyn std::fmt::Display| Failure::from(format!("density `{text}`: {error}"));
        let form = if let Some(numbers) = text.strip_prefix("ggx:") {
            let [x, y] = roughness(numbers).map_err(|e| fail(&e))?;
            Form::Ggx(Ggx::new(x, y).map_err(|e| fail(&e))?)
        } else if let Some(numbers) = text.strip_prefix("beckmann:") {
            let [x, y] = roughness(numbers).map_err(|e| fail(&e))?;
            Form::Beckmann(Beckmann::new(x, y).map_err(|e| fail(&e))?)
        } else if text == "painted" {
            Form::Map(Box::new(painted()?))
        } else {
            Form::Map(Box::new(image_density(Path::new(text), measure).map_err(|e| fail(&e))?))
        };
        Ok(Self { spec: text.into(), form })
    }

    /// The densities that the gallery shows.
    pub(crate) fn of_the_gallery() -> Vec<Self> {
        let specs = ["ggx:0.2,0.4", "beckmann:0.3", "painted"];
        specs.iter().filter_map(|spec| Self::parse(spec, cli::Measure::Normals).ok()).collect()
    }

    /// The density itself.
    pub(crate) fn ndf(&self) -> &SharedNdf {
        match &self.form {
            Form::Ggx(ggx) => ggx,
            Form::Beckmann(beckmann) => beckmann,
            Form::Map(map) => map.as_ref(),
        }
    }

    /// The density on the (x, y) map: the image's own texels, or a function's at [`SIZE`]².
    pub(crate) fn map(&self) -> Result<NdfMap, Failure> {
        Ok(match &self.form {
            Form::Map(map) => map.as_ref().clone(),
            _ => NdfMap::from_ndf(SIZE, SIZE, Reconstruction::Constant, self.ndf())?,
        })
    }

    /// For people: `GGX 0.2, 0.4`.
    pub(crate) fn name(&self) -> String {
        match self.spec.split_once(':') {
            Some(("ggx", numbers)) => format!("GGX {}", numbers.replace(',', ", ")),
            Some(("beckmann", numbers)) => format!("Beckmann {}", numbers.replace(',', ", ")),
            _ if self.spec == "painted" => "Painted, two lobes".into(),
            _ => Path::new(&self.spec).file_name().map_or(self.spec.clone(), |n| n.to_string_lossy().into()),
        }
    }

    /// The words that asked for it.
    pub(crate) fn spec(&self) -> &str {
        &self.spec
    }

    /// For folders: `ggx-0.2-0.4`; two images of one name in different folders get different ones.
    pub(crate) fn slug(&self) -> String {
        let (_, name) = self.spec.rsplit_once(['/', '\\']).unwrap_or(("", &self.spec));
        let clean: String =
            name.chars().map(|c| if c.is_ascii_alphanumeric() || c == '.' { c } else { '-' }).collect();
        let clean = clean.trim_start_matches('.').to_owned();
        if name.len() == self.spec.len() {
            clean
        } else {
            format!("{clean}-{}", &sha256(self.spec.as_bytes())[..8])
        }
    }
}

/// Two lobes and a diffuse floor, as a painter would have it: a density that no formula of the literature gives.
///
/// ```text
/// D ∝ exp(−|n − (−0.38, 0.22)|²/0.020) + 0.6 exp(−|n − (0.35, −0.30)|²/0.045) + 0.02
/// ```
pub(crate) fn painted() -> Result<NdfMap, Failure> {
    let lobe = |n: Vec3, x: f32, y: f32, width: f32| {
        let (x, y) = (n.x - x, n.y - y);
        (-(x * x + y * y) / width).exp()
    };
    let paint = |n: Vec3| lobe(n, -0.38, 0.22, 0.020) + 0.6 * lobe(n, 0.35, -0.30, 0.045) + 0.02;
    Ok(NdfMap::from_fn(SIZE, SIZE, Measure::Normals, Reconstruction::Constant, paint)?)
}

fn roughness(numbers: &str) -> Result<[f32; 2], String> {
    let parse =
        |text: &str| text.trim().parse::<f32>().map_err(|_| format!("`{}` is not a number", text.trim()));
    match numbers.split_once(',') {
        Some((x, y)) => Ok([parse(x)?, parse(y)?]),
        None => parse(numbers).map(|alpha| [alpha, alpha]),
    }
}

fn image_density(path: &Path, measure: cli::Measure) -> Result<NdfMap, Failure> {
    let image = ImageFile::open(path).map_err(|error| match error {
        ImageFileError::Unreadable(error) => {
            format!("{FORMS}, and as an image file it cannot be read: {error}")
        }
        error => error.to_string(),
    })?;
    // An image's first row is its top, a map's first row has n_y = −1.
    let turned: Vec<f32> = image.grey().chunks(image.width.max(1)).rev().flatten().copied().collect();
    let measure = match measure {
        cli::Measure::Normals => Measure::Normals,
        cli::Measure::SolidAngle => Measure::SolidAngle,
    };
    Ok(NdfMap::from_texels(image.width, image.height, &turned, measure, Reconstruction::Constant)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn refused(text: &str) -> String {
        let error = Density::parse(text, cli::Measure::Normals).err().expect("must be refused").to_string();
        assert!(!error.contains('\n'), "{error}");
        error
    }

    fn file(folder: &tempfile::TempDir, name: &str, bytes: &[u8]) -> String {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path.to_str().unwrap().into()
    }

    fn encode(width: u32, height: u32, depth: png::BitDepth, samples: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(depth);
        encoder.write_header().unwrap().write_image_data(samples).unwrap();
        bytes
    }

    #[test]
    fn bad_roughness_is_named() {
        for (text, word) in [
            ("ggx:0", "alpha_x"),
            ("ggx:0.2,-1", "alpha_y"),
            ("ggx:nan", "alpha_x"),
            ("beckmann:0.3,inf", "alpha_y"),
            ("ggx:", "not a number"),
            ("ggx:0.1,0.2,0.3", "not a number"),
            ("velvet", "cannot be read"),
        ] {
            let error = refused(text);
            assert!(error.contains(word) && error.contains(text), "{error}");
        }
    }

    #[test]
    fn bad_images_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let good = encode(8, 8, png::BitDepth::Eight, &[200; 64]);
        assert!(refused(&file(&folder, "empty.png", b"")).contains("empty"));
        assert!(refused(&file(&folder, "text.png", b"not an image")).contains("neither PNG nor OpenEXR"));
        let black = encode(8, 8, png::BitDepth::Eight, &[0; 64]);
        assert!(refused(&file(&folder, "black.png", &black)).contains("black"));
        for length in [8, 20, good.len() / 2, good.len() - 20] {
            refused(&file(&folder, "cut.png", &good[..length]));
        }
        refused(&file(&folder, "cut.exr", &[0x76, 0x2f, 0x31, 0x01, 2, 0]));
    }

    #[test]
    fn one_pixel_and_sixteen_bits_are_densities() {
        let folder = tempfile::tempdir().unwrap();
        let one = file(&folder, "one.png", &encode(1, 1, png::BitDepth::Eight, &[9]));
        let density = Density::parse(&one, cli::Measure::Normals).unwrap();
        // Uniform over the disk: D = 1/π.
        assert!((density.ndf().density(Vec3::Z) - std::f32::consts::FRAC_1_PI).abs() < 1e-6);
        // The lower byte of a sample decides: 0x0100 above, 0x0101 below.
        let deep = [[1_u8, 0], [1, 1]].concat();
        let deep = file(&folder, "deep.png", &encode(1, 2, png::BitDepth::Sixteen, &deep));
        let density = Density::parse(&deep, cli::Measure::Normals).unwrap();
        let ratio = density.ndf().density(Vec3::new(0.0, -0.6, 0.8))
            / density.ndf().density(Vec3::new(0.0, 0.6, 0.8));
        assert!((ratio - 257.0 / 256.0).abs() < 1e-5, "{ratio}");
    }

    #[test]
    fn names_and_folders_follow_the_words() {
        let density = Density::parse("ggx:0.2,0.4", cli::Measure::Normals).unwrap();
        assert_eq!((density.name(), density.slug()), ("GGX 0.2, 0.4".into(), "ggx-0.2-0.4".into()));
        assert_eq!(Density::of_the_gallery().len(), 3);
    }
}
