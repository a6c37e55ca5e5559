//! Densities from the outside: `ggx:0.2,0.4` and its like, `painted`, an image file, or the density of a normal map.

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

/// Texels per side of the maps that are made from functions.
pub const SIZE: usize = 256;

/// Prefix of the file of a normal map.
pub const NORMAL_MAP: &str = "normal-map:";

/// The formulas: the word before the colon, the name, and what the numbers are.
const FORMULAS: [(&str, &str, &str); 6] = [
    ("ggx", "GGX", "AX[,AY]"),
    ("beckmann", "Beckmann", "AX[,AY]"),
    ("ward", "Ward", "AX[,AY]"),
    ("student-t", "Student-t", "AX,AY,GAMMA"),
    ("blinn-phong", "Blinn\u{2013}Phong", "EXPONENT"),
    ("ashikhmin-shirley", "Ashikhmin\u{2013}Shirley", "NU,NV"),
];

/// A density of normals with the words that asked for it.
pub struct Density {
    /// The specification it was read from.
    pub spec: String,
    /// The density.
    pub ndf: Arc<SharedNdf>,
    /// The map that it is, where it is no formula.
    map: Option<NdfMap>,
}

impl Density {
    /// Reads a specification; an image is read from the file of that name.
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

    /// The densities that the gallery shows.
    pub fn of_the_gallery() -> Result<Vec<Self>, Failure> {
        ["ggx:0.2,0.4", "beckmann:0.3", "painted"]
            .iter()
            .map(|spec| Self::parse(spec, Images::USUAL))
            .collect()
    }

    /// The density on the (x, y) map: the image's own texels, or a function's at [`SIZE`]².
    pub fn map(&self) -> Result<NdfMap, Failure> {
        let from_ndf = || NdfMap::from_ndf(SIZE, SIZE, Reconstruction::Bilinear, self.ndf.as_ref());
        Ok(self.map.clone().map_or_else(from_ndf, Ok)?)
    }

    /// Whether it is constant on each texel of its map.
    pub fn is_in_steps(&self) -> bool {
        self.map.as_ref().is_some_and(|map| map.view().reconstruction() == Reconstruction::Constant)
    }

    /// For people: `GGX 0.2, 0.4`.
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

    /// For folders: `ggx-0.2-0.4`; two images of one name in different folders get different ones.
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

/// Two lobes and a diffuse floor, as a painter would have it: a density that no formula of the literature gives.
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
    Ok(NdfMap::from_fn(SIZE, SIZE, Measure::Normals, Reconstruction::Bilinear, paint)?)
}

/// The density of a formula's word and its numbers.
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
        _ => return Err(format!("got {} numbers, write `{form}`", numbers.len()).into()),
    })
}

/// The density of an image; the error names the formulas, for a mistyped one is taken for a file.
fn image_density(path: &Path, reading: Images) -> Result<NdfMap, Failure> {
    let image = ImageFile::open(path, Content::Colors).map_err(|error| match error {
        ImageFileError::Unreadable { error } => {
            let formulas = FORMULAS.map(|(word, _, numbers)| format!("`{word}:{numbers}`")).join(", ");
            format!("neither {formulas} nor `painted`, and as an image file it cannot be read: {error}")
                .into()
        }
        error => Failure::from(error),
    })?;
    // Rows from the bottom up: an image's first row is its top, a map's first row has n_y = −1.
    let texels: Vec<f32> = image.grey().chunks(image.width.max(1)).rev().flatten().copied().collect();
    let measure = reading.measure.unwrap_or(Measure::Normals);
    let reconstruction = reading.reconstruction.unwrap_or(Reconstruction::Constant);
    Ok(NdfMap::from_texels(image.width, image.height, &texels, measure, reconstruction)?)
}

/// The density of a normal map's normals: integers unsigned, floats signed.
fn estimated(path: &Path, reading: Images) -> Result<NdfMap, Failure> {
    let note = |text: &str| progress::note(&format!("normal map `{}`: {text}", path.display()));
    let image = ImageFile::open(path, Content::Normals)?;
    let texel = |i: usize| {
        let value = |k: usize| image.planes.get(k).map(|plane| plane[i]);
        Some([value(0)?, value(1)?, value(2).unwrap_or(0.0)])
    };
    let texels: Option<Vec<[f32; 3]>> = (0..image.width * image.height).map(texel).collect();
    let mut texels = texels.ok_or("a normal map needs the channels R, G, B or X, Y, Z, got gray")?;
    let signed =
        |texels: &[[f32; 3]]| texels.iter().map(|texel| texel.map(|c| 2.0 * c - 1.0)).collect::<Vec<_>>();
    if image.floats {
        // No normals, such as outside the data of an OpenEXR file.
        texels.retain(|texel| image.planes.len() == 2 || *texel != [0.0; 3]);
        let unsigned = texels.as_flattened().iter().all(|c| (0.0..=1.0).contains(c));
        if unsigned
            && image.planes.len() == 3
            && off_unit(&signed(&texels)) < LENGTH
            && off_unit(&texels) > LENGTH
        {
            note("its floats are from 0 to 1, so 0.5 stands for 0");
            texels = signed(&texels);
        }
    } else {
        texels = signed(&texels);
        let [red, green, blue] = [0, 1, 2].map(|k| spread(&texels, k));
        let off = off_unit(&texels) > LENGTH;
        let gray = texels.iter().all(|[x, y, z]| x == y && y == z);
        if off && (gray && green[1] > 0.0 || red[1] < CONSTANT && red[0].abs() > 0.9 && green[1] > blue[1]) {
            return Err("x is not in red: maps with x in alpha (DXT5nm) are not supported".into());
        }
    }
    let blue = match reading.blue {
        Some(blue) => blue,
        None if image.planes.len() == 2 => Blue::Reconstructed,
        None if spread(&texels, 2)[1] < CONSTANT && off_unit(&texels) > LENGTH => {
            note("blue is constant, so z follows from x and y; --blue sets it");
            Blue::Reconstructed
        }
        None => Blue::Read,
    };
    if blue == Blue::Read && off_unit(&texels) > 0.25 {
        note("its vectors are far from unit length; is it a normal map?");
    }
    let tangent_space = reading.tangent_space.unwrap_or_default();
    let format = NormalMapFormat { tangent_space, blue, ..NormalMapFormat::default() };
    let normals: Vec<Vec3> = texels.into_iter().map(|texel| format.decode_signed(texel)).collect();
    Ok(estimate_ndf(&normals)?)
}

/// The mean error of length from which on vectors are not unit normals: 8 bits alone move a length by at most 0.007.
const LENGTH: f32 = 0.02;

/// The standard deviation of a channel that is constant, by the noise of JPEG and WebP.
const CONSTANT: f32 = 0.04;

/// The mean of | |n| − 1 |.
fn off_unit(texels: &[[f32; 3]]) -> f32 {
    let off = |&[x, y, z]: &[f32; 3]| f64::from(((x * x + y * y + z * z).sqrt() - 1.0).abs());
    (texels.iter().map(off).sum::<f64>() / texels.len().max(1) as f64) as f32
}

/// Mean and standard deviation of a channel.
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

    /// A PNG with a colour for every row.
    fn png(width: u32, rows: &[u32]) -> Vec<u8> {
        Image::from_fn(width, rows.len() as u32, |_, y| hex(rows[y as usize])).encode(Format::Png).unwrap()
    }

    #[test]
    fn bad_roughness_is_named() {
        for (text, word) in [
            ("ggx:0", "alpha_x"),
            ("ggx:0.2,-1", "alpha_y"),
            ("ggx:nan", "alpha_x"),
            ("beckmann:0.3,inf", "alpha_y"),
            ("ggx:", "not a number"),
            ("ggx:0.1,0.2,0.3", "got 3 numbers, write `ggx:AX[,AY]`"),
            ("student-t:0.1,0.2", "write `student-t:AX,AY,GAMMA`"),
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
    fn images_of_no_density_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        assert!(refused(&file(&folder, "black.png", &png(8, &[0; 8]))).contains("black"));
        assert!(refused(&file(&folder, "empty.png", b"")).contains("empty"));
    }

    #[test]
    fn one_pixel_is_a_density_and_rows_run_downwards() {
        let folder = tempfile::tempdir().unwrap();
        let one = file(&folder, "one.png", &png(1, &[0x09_0909]));
        let density = Density::parse(&one, Images::USUAL).unwrap();
        // Uniform over the disk: D = 1/π.
        assert_abs_diff_eq!(density.ndf.density(Vec3::Z), std::f32::consts::FRAC_1_PI, epsilon = 1e-6);
        let two = file(&folder, "two.png", &png(1, &[0x80_8080, 0x40_4040]));
        let ndf = Density::parse(&two, Images::USUAL).unwrap().ndf;
        let [below, above] = [-0.6, 0.6].map(|y| ndf.density(Vec3::new(0.0, y, 0.8)));
        assert_abs_diff_eq!(below / above, 0.5, epsilon = 1e-5);
    }

    #[test]
    fn a_normal_map_is_read_in_both_tangent_spaces() {
        let folder = tempfile::tempdir().unwrap();
        // Both texels lean to the top of the image, where the green channel grows in OpenGL's sense.
        let spec = format!("{NORMAL_MAP}{}", file(&folder, "leaning.png", &png(2, &[0x80_cce6])));
        let up = Vec3::new(0.0, 0.6, 0.8);
        let down = Vec3::new(0.0, -0.6, 0.8);
        for (tangent_space, high, low) in
            [(TangentSpace::OpenGl, up, down), (TangentSpace::DirectX, down, up)]
        {
            let reading = Images { tangent_space: Some(tangent_space), ..Images::USUAL };
            let density = Density::parse(&spec, reading).unwrap();
            assert!(density.ndf.density(high) > 1.0 && density.ndf.density(low) == 0.0);
            assert_eq!(density.name(), "Normals of leaning.png");
        }
        // Without blue, in a PNG and as two channels, and with a blue that is not z.
        let lean = Density::parse(&spec, Images::USUAL).unwrap().ndf.density(up);
        let flat = [0x80_cc00, 0x80_80_00, 0x80_cc00, 0x80_80_00];
        for (name, bytes) in [
            ("zero.png", png(2, &flat)),
            ("half.png", png(2, &flat.map(|rgb| rgb | 0x80))),
            ("one.png", png(2, &flat.map(|rgb| rgb | 0xff))),
            ("two.exr", exr(1, 2, [("N.X", vec![0.0; 2]), ("N.Y", vec![0.6, 0.0])]).unwrap()),
        ] {
            let spec = format!("{NORMAL_MAP}{}", file(&folder, name, &bytes));
            let got = Density::parse(&spec, Images::USUAL).unwrap().ndf.density(up);
            assert!(got > 0.3 * lean && got < lean, "{name}: {got} of {lean}");
            let read = Images { blue: Some(Blue::Read), ..Images::USUAL };
            let rim = Density::parse(&spec, read).unwrap().ndf.density(up);
            assert!(name == "half.png" || rim != got, "{name}: {rim}");
        }
        // Lossy compression leaves a blue that is nearly constant.
        let noisy = Image::from_fn(64, 64, |_, y| hex(flat[y as usize / 16])).encode(Format::Jpeg).unwrap();
        let spec = format!("{NORMAL_MAP}{}", file(&folder, "noisy.jpg", &noisy));
        let got = Density::parse(&spec, Images::USUAL).unwrap().ndf.density(up);
        let read = Density::parse(&spec, Images { blue: Some(Blue::Read), ..Images::USUAL }).unwrap();
        assert!(got > 2.0 * read.ndf.density(up), "{got}");
        // Floats from 0 to 1, and pixels outside the data.
        let unsigned =
            [("R", vec![0.5; 4]), ("G", vec![0.8, 0.8, 0.5, 0.5]), ("B", vec![0.9, 0.9, 1.0, 1.0])];
        let signed = [("R", vec![0.0; 4]), ("G", vec![0.6, 0.6, 0.0, 0.0]), ("B", vec![0.8, 0.8, 1.0, 0.0])];
        for (name, channels) in [("unsigned.exr", unsigned), ("signed.exr", signed)] {
            let spec = format!("{NORMAL_MAP}{}", file(&folder, name, &exr(2, 2, channels).unwrap()));
            let got = Density::parse(&spec, Images::USUAL).unwrap().ndf.density(up);
            assert!(got > 0.3 * lean && got < lean, "{name}: {got} of {lean}");
        }
        let swizzled = file(&folder, "dxt5nm.png", &png(2, &[0xff_cc00, 0xff_8000, 0xff_4000]));
        let swizzled = refused(&format!("{NORMAL_MAP}{swizzled}"));
        assert!(swizzled.contains("DXT5nm"), "{swizzled}");
        let grey = exr(1, 1, [("Y", vec![0.5])]).unwrap();
        let grey = refused(&format!("{NORMAL_MAP}{}", file(&folder, "grey.exr", &grey)));
        assert!(grey.contains("R, G, B"), "{grey}");
    }

    #[test]
    fn names_and_folders_follow_the_words() {
        let density = Density::parse("ggx:0.2,0.4", Images::USUAL).unwrap();
        assert_eq!((density.name(), density.slug()), ("GGX 0.2, 0.4".into(), "ggx-0.2-0.4".into()));
    }
}
