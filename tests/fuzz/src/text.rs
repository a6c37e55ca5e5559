//! External text: systems and parameters in JSON, and command lines.

use std::cell::RefCell;

use asperity_fif::{Fif, FixedFif};
use asperity_ndf_sampling::normal_map::NormalMapFormat;
use asperity_ndf_sampling::normal_table::TableLayout;
use asperity_ndf_sampling::{AshikhminShirley, Beckmann, BlinnPhong, Ggx, Measure, Ndf, StudentT, Ward};
use asperity_noise::{FbmSpectrum, Grid, Normalization, Rotation};
use asperity_shading::{
    Carpet, CarpetParameters, LevelOfDetail, MetallicPaint, MetallicPaintParameters, Scratches,
    ScratchesParameters, TemperedGlass, TemperedGlassParameters, Variations, VariationsParameters,
};
use clap::{CommandFactory, FromArgMatches};
use glam::{Vec2, Vec3};
use serde::Serialize;
use serde::de::DeserializeOwned;

use asperity::cli::Cli;
use asperity::input::{density::Density, fif_system::System, images::Images};

/// Returns the parsed value, which must round-trip, or `None` with an error message.
fn read<T: DeserializeOwned + Serialize>(text: &[u8]) -> Option<T> {
    match serde_json::from_slice::<T>(text) {
        Ok(value) => {
            let written = serde_json::to_string(&value).expect("what was read is written");
            let again = serde_json::from_str::<T>(&written).expect("what was written is read");
            assert_eq!(serde_json::to_string(&again).expect("is written"), written);
            Some(value)
        }
        Err(error) => {
            // It quotes names of the text verbatim, including newlines. The tool escapes what it
            // prints.
            assert!(!error.to_string().is_empty());
            None
        }
    }
}

fn density<N: Ndf + DeserializeOwned + Serialize>(text: &[u8]) {
    if let Some(ndf) = read::<N>(text) {
        let m = ndf.warp_gaussian(Vec2::new(0.3, -0.8));
        assert!(m.is_finite() && ndf.d(m) >= 0.0);
    }
}

pub(crate) fn json(data: &[u8]) {
    density::<Ggx>(data);
    density::<Beckmann>(data);
    density::<Ward>(data);
    density::<StudentT>(data);
    density::<BlinnPhong>(data);
    density::<AshikhminShirley>(data);
    read::<Measure>(data);
    read::<TableLayout>(data);
    read::<NormalMapFormat>(data);
    read::<FbmSpectrum>(data);
    read::<Grid<Vec3>>(data);
    read::<(Normalization, Rotation)>(data);
    read::<LevelOfDetail>(data);
    let _ = read::<CarpetParameters>(data).map(Carpet::new);
    let _ = read::<MetallicPaintParameters>(data).map(MetallicPaint::new);
    let _ = read::<TemperedGlassParameters>(data).map(TemperedGlass::new);
    let _ = read::<ScratchesParameters>(data).map(Scratches::new);
    let _ = read::<VariationsParameters>(data).map(Variations::new);
    read::<FixedFif<2, 2>>(data);
    if let Some(f) = read::<Fif<4>>(data) {
        let got = f.evaluate(f.domain().middle(), 1e-9);
        assert!(got.value.is_finite() && got.bound >= 0.0, "{got:?}");
    }
    let Ok(text) = std::str::from_utf8(data) else { return };
    match System::parse(text, "attack") {
        Ok(system) => {
            let f = &system.fif;
            let got = f.evaluate(f.domain().middle(), 1e-9);
            assert!(got.value.is_finite() && got.bound >= 0.0, "{got:?}");
            assert!(!system.slug().contains(['/', '.', '\\']));
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1, "{error}"),
    }
}

thread_local! {
    /// Created once, because this takes longer than parsing a line.
    static COMMAND: RefCell<clap::Command> = RefCell::new(Cli::command());
}

/// Parses command line arguments, one per line, and densities.
pub(crate) fn words(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let words = text.split('\n').map(str::to_owned);
    COMMAND.with_borrow_mut(|command| {
        let words = ["asperity".to_owned()].into_iter().chain(words);
        let read = command.try_get_matches_from_mut(words);
        if let Err(error) = read.and_then(|matches| Cli::from_arg_matches(&matches)) {
            assert!([0, 2].contains(&error.exit_code()), "{error}");
        }
    });
    for word in text.split('\n').filter(|word| word.contains(':') && !word.starts_with("normal-map:")) {
        // A word that is not a formula would be a file name.
        let formula = ["ggx:", "beckmann:", "ward:", "student-t:", "blinn-phong:", "ashikhmin-shirley:"];
        if !formula.iter().any(|name| word.starts_with(name)) {
            continue;
        }
        match Density::parse(word, Images::USUAL) {
            Ok(density) => {
                let m = density.ndf.warp_gaussian(Vec2::new(0.3, -0.8));
                assert!(m.is_finite() && density.ndf.d(m) >= 0.0, "{word}");
                let slug = density.slug();
                assert!(!slug.is_empty() && !slug.starts_with('.') && !slug.contains(['/', '\\']), "{slug}");
            }
            Err(error) => assert!(error.to_string().contains("density"), "{error}"),
        }
    }
}
