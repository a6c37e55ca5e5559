//! Normal distribution functions over arrays.

use std::path::{Path, PathBuf};

use asperity::input::density::{Density, NORMAL_MAP, painted};
use asperity::input::images::Images;
use asperity_ndf_sampling::glam::{Vec2, Vec3};
use asperity_ndf_sampling::normal_map::{Blue, TangentSpace};
use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, BlinnPhong, ConditionalNdf, GaussianSplit, Ggx, Isotropic, Measure, Ndf as _,
    NdfMap, Reconstruction, Rotated, StudentT, Ward, estimate_ndf,
};
use numpy::{PyArray1, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::batch::{Flat, Rows, map, value_error};
use crate::distribution::{Analytic, Distribution, Shared, Tabulated};
use crate::parallel;

/// A normal distribution function.
#[pyclass(frozen, module = "asperity._asperity")]
pub(crate) struct Ndf(pub(crate) Shared);

fn new(distribution: impl Distribution + 'static) -> Ndf {
    Ndf(Shared::new(distribution))
}

fn of_map(map: NdfMap) -> Ndf {
    new(Tabulated::new(map))
}

#[pymethods]
impl Ndf {
    /// An NDF in closed form, by its name.
    #[staticmethod]
    fn formula(name: &str, parameters: Vec<f32>) -> PyResult<Self> {
        let said = value_error;
        Ok(match (name, &parameters[..]) {
            ("ggx", &[x, y]) => new(Analytic(Ggx::new(x, y).map_err(said)?)),
            ("beckmann", &[x, y]) => new(Analytic(Beckmann::new(x, y).map_err(said)?)),
            ("ward", &[x, y]) => new(Analytic(Ward::new(x, y).map_err(said)?)),
            ("student_t", &[x, y, gamma]) => new(Analytic(StudentT::new(x, y, gamma).map_err(said)?)),
            ("blinn_phong", &[exponent]) => new(Analytic(BlinnPhong::new(exponent).map_err(said)?)),
            ("ashikhmin_shirley", &[u, v]) => new(Analytic(AshikhminShirley::new(u, v).map_err(said)?)),
            _ => return Err(value_error(format!("unknown distribution `{name}`"))),
        })
    }

    /// The painted NDF of the documentation.
    #[staticmethod]
    fn painted() -> PyResult<Self> {
        painted().map(of_map).map_err(value_error)
    }

    /// An isotropic NDF from values at equally spaced cosines, from the horizon to the zenith.
    #[staticmethod]
    fn isotropic(values: Vec<f32>) -> PyResult<Self> {
        Isotropic::new(&values).map(|table| new(Tabulated::new(table))).map_err(value_error)
    }

    /// An NDF from an image of the (x, y) disk whose first row is its top.
    #[staticmethod]
    fn from_texels(py: Python<'_>, texels: Rows<'_>, measure: &str, reconstruction: &str) -> PyResult<Self> {
        let (measure, reconstruction) = (measure_of(measure)?, reconstruction_of(reconstruction)?);
        let (height, width) = (texels.shape()[0], texels.shape()[1]);
        let texels = texels.as_slice().map_err(value_error)?;
        let map = py.detach(|| {
            let rows: Vec<f32> = texels.chunks(width.max(1)).rev().flatten().copied().collect();
            NdfMap::from_texels(width, height, &rows, measure, reconstruction)
        });
        map.map(of_map).map_err(value_error)
    }

    /// An NDF from an image file.
    #[staticmethod]
    fn from_image(py: Python<'_>, path: PathBuf, measure: &str, reconstruction: &str) -> PyResult<Self> {
        let images = Images {
            measure: Some(measure_of(measure)?),
            reconstruction: Some(reconstruction_of(reconstruction)?),
            ..Images::USUAL
        };
        read(py, "", &path, images)
    }

    /// The NDF of the normals of a normal map file.
    #[staticmethod]
    fn from_normal_map(
        py: Python<'_>,
        path: PathBuf,
        tangent_space: Option<&str>,
        blue: Option<&str>,
    ) -> PyResult<Self> {
        let tangent_space = match tangent_space {
            None => None,
            Some("opengl") => Some(TangentSpace::OpenGl),
            Some("directx") => Some(TangentSpace::DirectX),
            Some(other) => {
                return Err(value_error(format!("`tangent_space` must be opengl or directx, got `{other}`")));
            }
        };
        let blue = match blue {
            None => None,
            Some("z") => Some(Blue::Read),
            Some("unused") => Some(Blue::Reconstructed),
            Some(other) => return Err(value_error(format!("`blue` must be z or unused, got `{other}`"))),
        };
        read(py, NORMAL_MAP, &path, Images { tangent_space, blue, ..Images::USUAL })
    }

    /// The NDF of normals.
    #[staticmethod]
    fn estimate(py: Python<'_>, normals: Rows<'_>) -> PyResult<Self> {
        let normals = normals.as_slice().map_err(value_error)?.as_chunks::<3>().0;
        let map = parallel::until_signal(py, |_| {
            let normals: Vec<Vec3> = normals.iter().map(|&n| Vec3::from(n)).collect();
            estimate_ndf(&normals)
        })?;
        map.map(of_map).map_err(value_error)
    }

    /// The NDF rotated by an angle from x towards y.
    fn rotated(&self, py: Python<'_>, angle: f32) -> PyResult<Self> {
        if py.detach(|| self.0.0.microfacet()).is_none() {
            return Err(value_error("a conditional distribution has no rotation: rotate it before"));
        }
        Rotated::new(self.0.clone(), angle).map(new).map_err(value_error)
    }

    /// The rest of the NDF where a part of the Gaussian noise is resolved.
    fn conditional(&self, z: [f32; 2], variance: f32) -> Self {
        new(ConditionalNdf::new(self.0.clone(), Vec2::from(z), variance))
    }

    /// Values of a method by name, of rows of its arguments.
    fn evaluate<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        rows: Rows<'py>,
        threads: Option<isize>,
    ) -> PyResult<Flat<'py>> {
        let ndf = &self.0;
        match method {
            "d" => map(py, &rows, threads, |m: [f32; 3]| [ndf.d(m.into())]),
            "pdf" => map(py, &rows, threads, |m: [f32; 3]| [ndf.pdf(m.into())]),
            "slope_density" => map(py, &rows, threads, |s: [f32; 2]| [ndf.slope_density(s.into())]),
            "warp_gaussian" => map(py, &rows, threads, |z: [f32; 2]| ndf.warp_gaussian(z.into()).into()),
            "invert" => map(py, &rows, threads, |m: [f32; 3]| ndf.invert(m.into()).into()),
            "sample" => map(py, &rows, threads, |u: [f32; 2]| ndf.sample(u.into()).into()),
            "residual_ndf" => map(py, &rows, threads, |[x, y, z, a, b, s]: [f32; 6]| {
                [ndf.residual_ndf(Vec3::new(x, y, z), GaussianSplit::new(Vec2::new(a, b), s))]
            }),
            _ => self.visible(py, method, &rows, threads),
        }
    }

    /// The texels of an NDF that is a map, proportional to D, and their width and height.
    fn texels<'py>(&self, py: Python<'py>, size: usize) -> Flat<'py> {
        let texels = py.detach(|| {
            let step = 2.0 / size.max(1) as f32;
            let texel = |i: usize| {
                let (x, y) = (i % size.max(1), i / size.max(1));
                let (x, y) = ((x as f32 + 0.5) * step - 1.0, 1.0 - (y as f32 + 0.5) * step);
                let z2 = 1.0 - x * x - y * y;
                if z2 > 0.0 { self.0.d(Vec3::new(x, y, z2.sqrt())) } else { 0.0 }
            };
            (0..size * size).map(texel).collect::<Vec<f32>>()
        });
        PyArray1::from_vec(py, texels)
    }

    /// Whether the NDF is a map.
    fn is_map(&self) -> bool {
        self.0.0.map().is_some()
    }
}

impl Ndf {
    fn visible<'py>(
        &self,
        py: Python<'py>,
        method: &str,
        rows: &Rows<'py>,
        threads: Option<isize>,
    ) -> PyResult<Flat<'py>> {
        // The tables of a map take a while.
        let ndf = py.detach(|| self.0.0.microfacet());
        let ndf = ndf.ok_or_else(|| value_error("a conditional distribution has no masking"))?;
        match method {
            "lambda" => map(py, rows, threads, |v: [f32; 3]| [ndf.lambda(v.into())]),
            "projected_area" => map(py, rows, threads, |v: [f32; 3]| [ndf.projected_area(v.into())]),
            "g1" => map(py, rows, threads, |v: [f32; 3]| [ndf.g1(v.into())]),
            "g2" => map(py, rows, threads, |r: [f32; 6]| {
                let [v, w] = two(r);
                [ndf.g2(v, w)]
            }),
            "visible_pdf" => map(py, rows, threads, |r: [f32; 6]| {
                let [v, m] = two(r);
                [ndf.visible_pdf(v, m)]
            }),
            "sample_visible" => map(py, rows, threads, |[x, y, z, a, b]: [f32; 5]| {
                ndf.sample_visible(Vec3::new(x, y, z), Vec2::new(a, b)).into()
            }),
            _ => Err(value_error(format!("unknown method `{method}`"))),
        }
    }
}

fn two([a, b, c, d, e, f]: [f32; 6]) -> [Vec3; 2] {
    [Vec3::new(a, b, c), Vec3::new(d, e, f)]
}

fn read(py: Python<'_>, prefix: &str, path: &Path, images: Images) -> PyResult<Ndf> {
    let text = format!("{prefix}{}", std::path::absolute(path)?.display());
    let map = parallel::until_signal(py, |_| {
        let density = Density::parse(&text, images).map_err(|error| error.to_string())?;
        density.map().map_err(|error| error.to_string())
    })?;
    map.map(of_map).map_err(value_error)
}

fn measure_of(name: &str) -> PyResult<Measure> {
    match name {
        "normals" => Ok(Measure::ProjectedSolidAngle),
        "solid_angle" => Ok(Measure::SolidAngle),
        _ => Err(value_error(format!("`measure` must be normals or solid_angle, got `{name}`"))),
    }
}

fn reconstruction_of(name: &str) -> PyResult<Reconstruction> {
    match name {
        "constant" => Ok(Reconstruction::Constant),
        "bilinear" => Ok(Reconstruction::Bilinear),
        _ => Err(value_error(format!("`reconstruction` must be constant or bilinear, got `{name}`"))),
    }
}
