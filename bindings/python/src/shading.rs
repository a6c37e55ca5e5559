//! BSDFs and materials over arrays.

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::reflectance::{
    BsdfSample, CharlieSheen, EnergyCompensated, RoughDielectric, SampleKind, ZeltnerFuzz,
};
use asperity_shading::{
    Brdf, Conductor, CookTorrance, Dielectric, EnergyPreservingOrenNayar, Ggx, Lambert, OpenPbr, Phong,
    StandardMaterial,
};
use pyo3::prelude::*;
use serde::de::DeserializeOwned;

use crate::batch::{Flat, Rows, map, value_error};
use crate::ndf::Ndf;

/// A BSDF in the frame of the surface.
#[pyclass(frozen, module = "asperity._asperity")]
pub(crate) struct Bsdf(Box<dyn Brdf + Send + Sync>);

fn new(brdf: impl Brdf + Send + Sync + 'static) -> Bsdf {
    Bsdf(Box::new(brdf))
}

/// Reads parameters, of which the file or the keywords have those that differ from the defaults.
fn parameters<P: DeserializeOwned>(json: &str) -> PyResult<P> {
    serde_json::from_str(json).map_err(|error| {
        let said = error.to_string();
        // A position in text that the caller has not written.
        value_error(said.split(" at line ").next().unwrap_or_default())
    })
}

#[pymethods]
impl Bsdf {
    #[staticmethod]
    fn lambert(albedo: [f32; 3]) -> PyResult<Self> {
        Lambert::new(albedo.into()).map(new).map_err(value_error)
    }

    #[staticmethod]
    fn oren_nayar(albedo: [f32; 3], roughness: f32) -> PyResult<Self> {
        EnergyPreservingOrenNayar::new(albedo.into(), roughness).map(new).map_err(value_error)
    }

    #[staticmethod]
    fn phong(specular: [f32; 3], exponent: f32) -> PyResult<Self> {
        Phong::new(specular.into(), exponent).map(new).map_err(value_error)
    }

    #[staticmethod]
    fn charlie_sheen(color: [f32; 3], alpha: f32) -> PyResult<Self> {
        CharlieSheen::new(color.into(), alpha).map(new).map_err(value_error)
    }

    #[staticmethod]
    fn zeltner_fuzz(color: [f32; 3], alpha: f32) -> PyResult<Self> {
        ZeltnerFuzz::new(color.into(), alpha).map(new).map_err(value_error)
    }

    /// Mirrors with a distribution and a reflectance at normal incidence.
    #[staticmethod]
    fn metal(py: Python<'_>, ndf: &Ndf, f0: [f32; 3]) -> PyResult<Self> {
        masked(py, ndf)?;
        Ok(new(CookTorrance::new(ndf.0.clone(), color("f0", f0)?)))
    }

    /// Mirrors with a distribution and the indices of a conductor per channel.
    #[staticmethod]
    fn conductor(py: Python<'_>, ndf: &Ndf, eta: [f32; 3], k: [f32; 3]) -> PyResult<Self> {
        masked(py, ndf)?;
        let channel = |i: usize| Conductor::new(eta[i], k[i]).map_err(value_error);
        Ok(new(CookTorrance::new(ndf.0.clone(), [channel(0)?, channel(1)?, channel(2)?])))
    }

    /// A rough dielectric with a distribution, which reflects and transmits.
    #[staticmethod]
    fn dielectric(py: Python<'_>, ndf: &Ndf, ior: f32, thin: Option<[f32; 3]>) -> PyResult<Self> {
        masked(py, ndf)?;
        let fresnel = Dielectric::new(ior).map_err(value_error)?;
        Ok(match thin {
            None => new(RoughDielectric::new(ndf.0.clone(), fresnel)),
            Some(tint) => new(RoughDielectric::thin(ndf.0.clone(), fresnel, color("thin", tint)?)),
        })
    }

    /// GGX mirrors with every bounce.
    #[staticmethod]
    fn ggx_metal(alpha_x: f32, alpha_y: f32, f0: [f32; 3]) -> PyResult<Self> {
        let ggx = Ggx::new(alpha_x, alpha_y).map_err(value_error)?;
        Ok(new(EnergyCompensated::metal(ggx, color("f0", f0)?)))
    }

    /// Rough glass of GGX facets with every bounce.
    #[staticmethod]
    fn ggx_glass(alpha_x: f32, alpha_y: f32, ior: f32) -> PyResult<Self> {
        let ggx = Ggx::new(alpha_x, alpha_y).map_err(value_error)?;
        Ok(new(EnergyCompensated::glass(ggx, Dielectric::new(ior).map_err(value_error)?)))
    }

    #[staticmethod]
    fn standard_material(json: &str) -> PyResult<Self> {
        StandardMaterial::new(parameters(json)?).map(new).map_err(value_error)
    }

    #[staticmethod]
    fn open_pbr(json: &str) -> PyResult<Self> {
        OpenPbr::new(parameters(json)?).map(new).map_err(value_error)
    }

    /// f of rows of `wo` and `wi`.
    fn eval<'py>(&self, py: Python<'py>, rows: Rows<'py>, threads: Option<isize>) -> PyResult<Flat<'py>> {
        map(py, &rows, threads, |[a, b, c, d, e, f]: [f32; 6]| {
            self.0.eval(Vec3::new(a, b, c), Vec3::new(d, e, f)).to_array()
        })
    }

    /// The density of `sample` of rows of `wo` and `wi`.
    fn pdf<'py>(&self, py: Python<'py>, rows: Rows<'py>, threads: Option<isize>) -> PyResult<Flat<'py>> {
        map(py, &rows, threads, |[a, b, c, d, e, f]: [f32; 6]| {
            [self.0.pdf(Vec3::new(a, b, c), Vec3::new(d, e, f))]
        })
    }

    /// Samples of rows of `wo`, `uc` and `u`: `wi`, `eval_cos`, pdf, and the kind; 0 without a sample.
    fn sample<'py>(&self, py: Python<'py>, rows: Rows<'py>, threads: Option<isize>) -> PyResult<Flat<'py>> {
        map(py, &rows, threads, |[a, b, c, uc, u, v]: [f32; 6]| {
            let Some(BsdfSample { wi, eval_cos, pdf, kind }) =
                self.0.sample(Vec3::new(a, b, c), uc, Vec2::new(u, v))
            else {
                return [0.0; 8];
            };
            let kind = match kind {
                SampleKind::Reflection => 1.0,
                SampleKind::Transmission => 2.0,
                SampleKind::SpecularReflection => 3.0,
                SampleKind::SpecularTransmission => 4.0,
            };
            [wi.x, wi.y, wi.z, eval_cos.x, eval_cos.y, eval_cos.z, pdf, kind]
        })
    }

    fn transmits(&self) -> bool {
        self.0.transmits()
    }
}

/// Checks that a distribution has masking, and computes its tables.
fn masked(py: Python<'_>, ndf: &Ndf) -> PyResult<()> {
    let ndf = py.detach(|| ndf.0.0.microfacet());
    ndf.map(|_| ()).ok_or_else(|| value_error("a conditional distribution has no masking"))
}

fn color(name: &str, color: [f32; 3]) -> PyResult<Vec3> {
    match color.iter().find(|c| !(0.0..=1.0).contains(*c)) {
        Some(c) => Err(value_error(format!("`{name}` must be within [0, 1], got {c}"))),
        None => Ok(color.into()),
    }
}
