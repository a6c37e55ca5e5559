//! Densities given on the command line: a formula such as `ggx:0.2,0.4`, `painted`, an image file,
//! or a normal map.

use std::{path::Path, sync::Arc};

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, Ggx, Measure, NdfMap, Reconstruction, StudentT, Ward,
    estimate_ndf,
    glam::Vec3,
    normal_map::{Blue, NormalMapFormat},
};
use asperity_render::image::content::{Content, ImageFileError};
use asperity_render::image::read::ImageFile;
use asperity_render::materials::SharedNdf;

use crate::failure::Failure;
use crate::input::images::Images;
use crate::output::sha256;
use crate::progress;

/// Texels per side of maps computed from formulas.
pub const SIZE: usize = 256;

/// Prefix of the file of a normal map.
pub const NORMAL_MAP: &str = "normal-map:";

/// The formulas: word before the colon, display name, parameters.
const FORMULAS: [(&str, &str, &str); 6] = [
    ("ggx", "GGX", "AX[,AY]"),
    ("beckmann", "Beckmann", "AX[,AY]"),
    ("ward", "Ward", "AX[,AY]"),
    ("student-t", "Student-t", "AX,AY,GAMMA"),
    ("blinn-phong", "Blinn\u{2013}Phong", "EXPONENT"),
    ("ashikhmin-shirley", "Ashikhmin\u{2013}Shirley", "NU,NV"),
];

/// A normal density and its specification.
pub struct Density {
    /// The specification that was parsed.
    pub spec: String,
    /// The density.
    pub ndf: Arc<SharedNdf>,
    /// The map, if the density is not a formula.
    map: Option<NdfMap>,
}

impl Density {
    /// Parses a specification; any other text is the path of an image file.
    pub fn parse(text: &str, reading: Images) -> Result<Self, Failure> {
        let read = || -> Result<(Arc<SharedNdf>, Option<NdfMap>), Failure> {
            let map = match text.split_once(':') {
                Some((word, numbers)) if FORMULAS.iter().any(|formula| formula.0 == word) => {
                    return Ok((formula(word, numbers)?, None));
                }
                _ if text == "painted" => painted()?,
                _ => match text.strip_prefix(NORMAL_MAP) {
                    Some(file) => estimated(Path::new(file), reading)?,
                    None => image_density(Path::new(text), reading)?,
                },
            };
            Ok((Arc::new(map.clone()), Some(map)))
        };
        let (ndf, map) = read().map_err(|error| format!("density `{text}`: {error}"))?;
        Ok(Self { spec: text.into(), ndf, map })
    }

    /// The densities shown in the gallery.
    pub fn of_the_gallery() -> Result<Vec<Self>, Failure> {
        ["ggx:0.2,0.4", "beckmann:0.3", "painted"]
            .iter()
            .map(|spec| Self::parse(spec, Images::USUAL))
            .collect()
    }

    /// Returns the density on the (x, y) map: the image's texels, or a formula's values at
    /// [`SIZE`]².
    pub fn map(&self) -> Result<NdfMap, Failure> {
        let from_ndf = || NdfMap::from_ndf(SIZE, SIZE, Reconstruction::Bilinear, self.ndf.as_ref());
        Ok(self.map.clone().map_or_else(from_ndf, Ok)?)
    }

    /// Whether the density is constant on each texel of its map.
    pub fn is_in_steps(&self) -> bool {
        self.map.as_ref().is_some_and(|map| map.view().reconstruction() == Reconstruction::Constant)
    }

    /// Returns the display name, e.g. `GGX 0.2, 0.4`.
    pub fn name(&self) -> String {
        let file = |path: &str| {
            Path::new(path).file_name().map_or(path.to_owned(), |name| name.to_string_lossy().into())
        };
        let formula = self.spec.split_once(':').and_then(|(word, numbers)| {
            let formula = FORMULAS.iter().find(|formula| formula.0 == word)?;
            Some(format!("{} {}", formula.1, numbers.replace(',', ", ")))
        });
        match self.spec.strip_prefix(NORMAL_MAP) {
            _ if self.spec == "painted" => "Painted, two lobes".into(),
            Some(path) => format!("Normals of {}", file(path)),
            None => formula.unwrap_or_else(|| file(&self.spec)),
        }
    }

    /// Returns the folder name, e.g. `ggx-0.2-0.4`. Equally named images in different folders get
    /// different names.
    pub fn slug(&self) -> String {
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

/// Two lobes and a diffuse floor, as an artist could paint them. No standard formula has this
/// shape.
///
/// ```text
/// D ∝ exp(−|n − (−0.38, 0.22)|²/0.020) + 0.6 exp(−|n − (0.35, −0.30)|²/0.045) + 0.02
/// ```
pub fn painted() -> Result<NdfMap, Failure> {
    let lobe = |n: Vec3, x: f32, y: f32, width: f32| {
        let (x, y) = (n.x - x, n.y - y);
        (-(x * x + y * y) / width).exp()
    };
    let paint = |n: Vec3| lobe(n, -0.38, 0.22, 0.020) + 0.6 * lobe(n, 0.35, -0.30, 0.045) + 0.02;
    Ok(NdfMap::from_fn(SIZE, SIZE, Measure::ProjectedSolidAngle, Reconstruction::Bilinear, paint)?)
}

/// Builds the density of a formula from its word and parameters.
fn formula(word: &str, text: &str) -> Result<Arc<SharedNdf>, Failure> {
    let parse = |text: &str| {
        text.trim().parse::<f32>().map_err(|_| Failure::from(format!("`{}` is not a number", text.trim())))
    };
    let numbers = text.split(',').map(parse).collect::<Result<Vec<_>, _>>()?;
    let form = FORMULAS.iter().find(|formula| formula.0 == word);
    let form = form.map(|&(word, _, numbers)| format!("{word}:{numbers}")).unwrap_or_default();
    let alpha_y = numbers.get(1).copied().or(numbers.first().copied());
    Ok(match (word, numbers.as_slice(), alpha_y) {
        ("ggx", &[x] | &[x, _], Some(y)) => Arc::new(Ggx::new(x, y)?),
        ("beckmann", &[x] | &[x, _], Some(y)) => Arc::new(Beckmann::new(x, y)?),
        ("ward", &[x] | &[x, _], Some(y)) => Arc::new(Ward::new(x, y)?),
        ("student-t", &[x, y, gamma], _) => Arc::new(StudentT::new(x, y, gamma)?),
        ("blinn-phong", &[exponent], _) => Arc::new(BlinnPhong::new(exponent)?),
        ("ashikhmin-shirley", &[n_u, n_v], _) => Arc::new(AshikhminShirley::new(n_u, n_v)?),
        _ => return Err(format!("got {} numbers (expected `{form}`)", numbers.len()).into()),
    })
}

/// Reads the density of an image. The error lists the formulas, because a mistyped formula is taken
/// for a file name.
fn image_density(path: &Path, reading: Images) -> Result<NdfMap, Failure> {
    let image = ImageFile::open(path, Content::Colors).map_err(|error| match error {
        ImageFileError::Unreadable { error } => {
            let formulas = FORMULAS.map(|(word, _, numbers)| format!("`{word}:{numbers}`")).join(", ");
            format!("expected {formulas}, `painted` or a readable image file: {error}").into()
        }
        error => Failure::from(error),
    })?;
    // Rows run from the bottom up: an image's first row is its top, a map's first row has n_y = −1.
    let texels: Vec<f32> = image.gray().chunks(image.width.max(1)).rev().flatten().copied().collect();
    let measure = reading.measure.unwrap_or(Measure::ProjectedSolidAngle);
    let reconstruction = reading.reconstruction.unwrap_or(Reconstruction::Constant);
    Ok(NdfMap::from_texels(image.width, image.height, &texels, measure, reconstruction)?)
}

/// Estimates the density of the normals of a normal map. Integer channels are unsigned, floats are
/// signed.
fn estimated(path: &Path, reading: Images) -> Result<NdfMap, Failure> {
    let note = |text: &str| progress::note(&format!("normal map `{}`: {text}", path.display()));
    let image = ImageFile::open(path, Content::Normals)?;
    let texel = |i: usize| {
        let value = |k: usize| image.planes.get(k).map(|plane| plane[i]);
        Some([value(0)?, value(1)?, value(2).unwrap_or(0.0)])
    };
    let texels: Option<Vec<[f32; 3]>> = (0..image.width * image.height).map(texel).collect();
    let mut texels = texels.ok_or("a normal map needs channels R, G, B or X, Y, Z, got a gray image")?;
    let signed =
        |texels: &[[f32; 3]]| texels.iter().map(|texel| texel.map(|c| 2.0 * c - 1.0)).collect::<Vec<_>>();
    if image.floats {
        // Texels without a normal, e.g. outside the data window of an OpenEXR file.
        texels.retain(|texel| image.planes.len() == 2 || *texel != [0.0; 3]);
        let unsigned = texels.as_flattened().iter().all(|c| (0.0..=1.0).contains(c));
        if unsigned
            && image.planes.len() == 3
            && off_unit(&signed(&texels)) < LENGTH
            && off_unit(&texels) > LENGTH
        {
            note("float channels are within [0, 1], so 0.5 is read as 0");
            texels = signed(&texels);
        }
    } else {
        texels = signed(&texels);
        let [red, green, blue] = [0, 1, 2].map(|k| spread(&texels, k));
        let off = off_unit(&texels) > LENGTH;
        let gray = texels.iter().all(|[x, y, z]| x == y && y == z);
        if off && (gray && green[1] > 0.0 || red[1] < CONSTANT && red[0].abs() > 0.9 && green[1] > blue[1]) {
            return Err("red channel is constant: maps with x in alpha (DXT5nm) are not supported".into());
        }
    }
    let blue = match reading.blue {
        Some(blue) => blue,
        None if image.planes.len() == 2 => Blue::Reconstructed,
        None if spread(&texels, 2)[1] < CONSTANT && off_unit(&texels) > LENGTH => {
            note("blue is constant, so z is computed from x and y (override with --blue)");
            Blue::Reconstructed
        }
        None => Blue::Read,
    };
    if blue == Blue::Read && off_unit(&texels) > 0.25 {
        note("vectors are far from unit length, so this may not be a normal map");
    }
    let tangent_space = reading.tangent_space.unwrap_or_default();
    let format = NormalMapFormat { tangent_space, blue, ..NormalMapFormat::default() };
    let normals: Vec<Vec3> = texels.into_iter().map(|texel| format.decode_signed(texel)).collect();
    Ok(estimate_ndf(&normals)?)
}

/// Mean length error above which vectors do not count as unit normals. Quantization to 8 bits alone
/// changes a length by at most 0.007.
const LENGTH: f32 = 0.02;

/// Standard deviation below which a channel counts as constant, given the noise of JPEG and WebP.
const CONSTANT: f32 = 0.04;

/// Returns the mean of | |n| − 1 |.
fn off_unit(texels: &[[f32; 3]]) -> f32 {
    let off = |&[x, y, z]: &[f32; 3]| f64::from(((x * x + y * y + z * z).sqrt() - 1.0).abs());
    (texels.iter().map(off).sum::<f64>() / texels.len().max(1) as f64) as f32
}

/// Returns the mean and standard deviation of a channel.
fn spread(texels: &[[f32; 3]], channel: usize) -> [f32; 2] {
    let mean = |of: &dyn Fn(f64) -> f64| {
        texels.iter().map(|texel| of(texel[channel].into())).sum::<f64>() / texels.len().max(1) as f64
    };
    let center = mean(&|c| c);
    [center as f32, mean(&|c| (c - center).powi(2)).sqrt() as f32]
}

#[cfg(test)]
mod tests {
    use std::fs;

    use approx::assert_abs_diff_eq;
    use asperity_ndf_sampling::normal_map::TangentSpace;
    use asperity_render::image::{Format, Image, formats::exr, tone::hex};

    use super::*;

    fn refused(text: &str) -> String {
        let error = Density::parse(text, Images::USUAL).err().expect("must be refused").to_string();
        assert!(!error.contains('\n'), "{error}");
        error
    }

    fn file(folder: &tempfile::TempDir, name: &str, bytes: &[u8]) -> String {
        let path = folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path.to_str().unwrap().into()
    }

    /// Returns a PNG with one color per row.
    fn png(width: u32, rows: &[u32]) -> Vec<u8> {
        Image::from_fn(width, rows.len() as u32, |_, y| hex(rows[y as usize])).encode(Format::Png).unwrap()
    }

    #[test]
    fn formula_errors_name_the_parameter() {
        for (text, word) in [
            ("ggx:0", "alpha_x"),
            ("ggx:0.2,-1", "alpha_y"),
            ("ggx:nan", "alpha_x"),
            ("beckmann:0.3,inf", "alpha_y"),
            ("ggx:", "not a number"),
            ("ggx:0.1,0.2,0.3", "got 3 numbers (expected `ggx:AX[,AY]`)"),
            ("student-t:0.1,0.2", "(expected `student-t:AX,AY,GAMMA`)"),
            ("student-t:0.1,0.2,1.2", "gamma"),
            ("blinn-phong:-1", "exponent"),
            ("ashikhmin-shirley:1,nan", "n_v"),
            ("velvet", "`ward:AX[,AY]`, `student-t:AX,AY,GAMMA`"),
        ] {
            let error = refused(text);
            assert!(error.contains(word) && error.contains(text), "{error}");
        }
    }

    #[test]
    fn image_black_or_empty_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        assert!(refused(&file(&folder, "black.png", &png(8, &[0; 8]))).contains("black"));
        assert!(refused(&file(&folder, "empty.png", b"")).contains("empty"));
    }

    #[test]
    fn image_of_one_pixel_and_row_order() {
        let folder = tempfile::tempdir().unwrap();
        let one = file(&folder, "one.png", &png(1, &[0x09_0909]));
        let density = Density::parse(&one, Images::USUAL).unwrap();
        // Uniform over the disk: D = 1/π.
        assert_abs_diff_eq!(density.ndf.d(Vec3::Z), std::f32::consts::FRAC_1_PI, epsilon = 1e-6);
        let two = file(&folder, "two.png", &png(1, &[0x80_8080, 0x40_4040]));
        let ndf = Density::parse(&two, Images::USUAL).unwrap().ndf;
        let [below, above] = [-0.6, 0.6].map(|y| ndf.d(Vec3::new(0.0, y, 0.8)));
        assert_abs_diff_eq!(below / above, 0.5, epsilon = 1e-5);
    }

    #[test]
    fn normal_map_in_both_tangent_spaces() {
        let folder = tempfile::tempdir().unwrap();
        // Both texels tilt toward the top of the image, where the green channel is larger in the
        // OpenGL convention.
        let spec = format!("{NORMAL_MAP}{}", file(&folder, "leaning.png", &png(2, &[0x80_cce6])));
        let up = Vec3::new(0.0, 0.6, 0.8);
        let down = Vec3::new(0.0, -0.6, 0.8);
        for (tangent_space, high, low) in
            [(TangentSpace::OpenGl, up, down), (TangentSpace::DirectX, down, up)]
        {
            let reading = Images { tangent_space: Some(tangent_space), ..Images::USUAL };
            let density = Density::parse(&spec, reading).unwrap();
            assert!(density.ndf.d(high) > 1.0 && density.ndf.d(low) == 0.0);
            assert_eq!(density.name(), "Normals of leaning.png");
        }
        // Without blue, as a PNG and as two channels, and with a blue channel that is not z.
        let lean = Density::parse(&spec, Images::USUAL).unwrap().ndf.d(up);
        let flat = [0x80_cc00, 0x80_80_00, 0x80_cc00, 0x80_80_00];
        for (name, bytes) in [
            ("zero.png", png(2, &flat)),
            ("half.png", png(2, &flat.map(|rgb| rgb | 0x80))),
            ("one.png", png(2, &flat.map(|rgb| rgb | 0xff))),
            ("two.exr", exr(1, 2, [("N.X", vec![0.0; 2]), ("N.Y", vec![0.6, 0.0])]).unwrap()),
        ] {
            let spec = format!("{NORMAL_MAP}{}", file(&folder, name, &bytes));
            let got = Density::parse(&spec, Images::USUAL).unwrap().ndf.d(up);
            assert!(got > 0.3 * lean && got < lean, "{name}: {got} of {lean}");
            let read = Images { blue: Some(Blue::Read), ..Images::USUAL };
            let rim = Density::parse(&spec, read).unwrap().ndf.d(up);
            assert!(name == "half.png" || rim != got, "{name}: {rim}");
        }
        // Lossy compression leaves a nearly constant blue channel.
        let noisy = Image::from_fn(64, 64, |_, y| hex(flat[y as usize / 16])).encode(Format::Jpeg).unwrap();
        let spec = format!("{NORMAL_MAP}{}", file(&folder, "noisy.jpg", &noisy));
        let got = Density::parse(&spec, Images::USUAL).unwrap().ndf.d(up);
        let read = Density::parse(&spec, Images { blue: Some(Blue::Read), ..Images::USUAL }).unwrap();
        assert!(got > 2.0 * read.ndf.d(up), "{got}");
        // Floats from 0 to 1, and pixels outside the data window.
        let unsigned =
            [("R", vec![0.5; 4]), ("G", vec![0.8, 0.8, 0.5, 0.5]), ("B", vec![0.9, 0.9, 1.0, 1.0])];
        let signed = [("R", vec![0.0; 4]), ("G", vec![0.6, 0.6, 0.0, 0.0]), ("B", vec![0.8, 0.8, 1.0, 0.0])];
        for (name, channels) in [("unsigned.exr", unsigned), ("signed.exr", signed)] {
            let spec = format!("{NORMAL_MAP}{}", file(&folder, name, &exr(2, 2, channels).unwrap()));
            let got = Density::parse(&spec, Images::USUAL).unwrap().ndf.d(up);
            assert!(got > 0.3 * lean && got < lean, "{name}: {got} of {lean}");
        }
        let swizzled = file(&folder, "dxt5nm.png", &png(2, &[0xff_cc00, 0xff_8000, 0xff_4000]));
        let swizzled = refused(&format!("{NORMAL_MAP}{swizzled}"));
        assert!(swizzled.contains("DXT5nm"), "{swizzled}");
        let gray = exr(1, 1, [("Y", vec![0.5])]).unwrap();
        let gray = refused(&format!("{NORMAL_MAP}{}", file(&folder, "gray.exr", &gray)));
        assert!(gray.contains("R, G, B"), "{gray}");
    }

    #[test]
    fn density_name_and_slug() {
        let density = Density::parse("ggx:0.2,0.4", Images::USUAL).unwrap();
        assert_eq!((density.name(), density.slug()), ("GGX 0.2, 0.4".into(), "ggx-0.2-0.4".into()));
    }
}
