//! Parameters written to files and read back through their validating constructors.
#![expect(clippy::unwrap_used, reason = "a test that cannot read its own file has failed")]

use std::fmt::Debug;

use asperity_ndf_sampling::normal_map::{NormalMapFormat, TangentSpace};
use asperity_ndf_sampling::normal_table::{Chart, Spacing, TableLayout};
use asperity_ndf_sampling::{AshikhminShirley, Beckmann, BlinnPhong, Ggx, Measure, StudentT, Ward};
use asperity_noise::{FbmSpectrum, Grid, Normalization, Rotation};
use asperity_shading::glam::Vec3;
use asperity_shading::material::{GlassWaves, PaintFlakes};
use asperity_shading::{
    CarpetParameters, LevelOfDetail, MetallicPaintParameters, ScratchesParameters, TemperedGlassParameters,
    VariationsParameters,
};
use serde::{Serialize, de::DeserializeOwned};

/// Reads a value back, and compares the serialized form with the text.
fn stands<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T, text: &str) {
    let written = serde_json::to_string(value).unwrap();
    assert_eq!(written, text);
    assert_eq!(&serde_json::from_str::<T>(&written).unwrap(), value, "{written}");
}

/// Returns the error message for a text.
#[track_caller]
fn refused<T: DeserializeOwned + Debug>(text: &str, message: &str) {
    let error = serde_json::from_str::<T>(text).unwrap_err().to_string();
    assert!(error.starts_with(message), "{error}");
}

#[test]
fn spectra_and_grids_round_trip() {
    stands(&FbmSpectrum::default(), r#"{"lacunarity":2.17,"gain":0.5,"max_octaves":10}"#);
    let grid = Grid { origin: Vec3::X, step: Vec3::splat(0.5), size: [4, 3, 2] };
    stands(&grid, r#"{"origin":[1.0,0.0,0.0],"step":[0.5,0.5,0.5],"size":[4,3,2]}"#);
    stands(&(Normalization::UnitVariance, Rotation::Aligned), r#"["unit_variance","aligned"]"#);
    refused::<FbmSpectrum>(
        r#"{"lacunarity":0.9,"gain":0.5,"max_octaves":10}"#,
        "`lacunarity` must be finite and above 1, got 0.9",
    );
    refused::<FbmSpectrum>(r#"{"lacunarity":2.0,"gain":0.5,"octaves":10}"#, "unknown field `octaves`");
}

#[test]
fn densities_are_deserialized_by_their_constructors() {
    stands(&Ggx::new(0.1, 0.3).unwrap(), r#"{"alpha_x":0.1,"alpha_y":0.3}"#);
    stands(&Beckmann::isotropic(0.7).unwrap(), r#"{"alpha_x":0.7,"alpha_y":0.7}"#);
    stands(&Ward::new(0.1, 0.3).unwrap(), r#"{"alpha_x":0.1,"alpha_y":0.3}"#);
    stands(&StudentT::new(0.1, 0.3, 2.5).unwrap(), r#"{"alpha_x":0.1,"alpha_y":0.3,"gamma":2.5}"#);
    stands(&BlinnPhong::new(20.0).unwrap(), r#"{"exponent":20.0}"#);
    stands(&AshikhminShirley::new(50.0, 10.0).unwrap(), r#"{"n_u":50.0,"n_v":10.0}"#);
    refused::<Ggx>(r#"{"alpha_x":0.1,"alpha_y":-0.3}"#, "`alpha_y` must be ");
    refused::<StudentT>(r#"{"alpha_x":0.1,"alpha_y":0.3,"gamma":1.0}"#, "`gamma` must be ");
    refused::<BlinnPhong>(r#"{"exponent":-1.0}"#, "`exponent` must be ");
    let layout = TableLayout { spacing: Spacing::Warped, chart: Chart::Slopes };
    stands(&(layout, Measure::SolidAngle), r#"[{"spacing":"warped","chart":"slopes"},"solid_angle"]"#);
    let directx = NormalMapFormat { tangent_space: TangentSpace::DirectX, ..NormalMapFormat::default() };
    let written = serde_json::to_string(&directx).unwrap();
    assert_eq!(serde_json::from_str::<NormalMapFormat>(&written).unwrap(), directx);
}

/// Reads back parameters and empty parameters. An unknown name is an error.
fn parameters<T: Serialize + DeserializeOwned + PartialEq + Debug + Default>(some: &T) {
    assert_ne!(some, &T::default());
    let written = serde_json::to_string(some).unwrap();
    assert_eq!(&serde_json::from_str::<T>(&written).unwrap(), some, "{written}");
    assert_eq!(serde_json::from_str::<T>("{}").unwrap(), T::default());
    refused::<T>(r#"{"no_such_parameter":1}"#, "unknown field `no_such_parameter`");
}

#[test]
fn material_parameters_round_trip_with_defaults() {
    parameters(&CarpetParameters { roughness: 0.3, ..Default::default() });
    let flakes = PaintFlakes::Counted { spacing: 0.01, bin: 0.1 };
    parameters(&MetallicPaintParameters { flakes, ..Default::default() });
    parameters(&TemperedGlassParameters { waves: GlassWaves::Noise, ..Default::default() });
    parameters(&ScratchesParameters { scratch_cover: 4.0, ..Default::default() });
    parameters(&VariationsParameters { seed: 9, ..Default::default() });
    stands(&LevelOfDetail::Fractal, r#""fractal""#);
}
