//! `opensimplex2`: the fast variant of OpenSimplex2, `f64` points.

use opensimplex2::fast;

use crate::{
    inputs::SEED,
    measure::Contender,
    row::{Kind, Row},
    scalar::values,
};

const NAME: &str = "opensimplex2";

pub(crate) fn contender(row: Row, step: f32) -> Option<Contender> {
    if row.kind != Kind::Simplex {
        return None;
    }
    let seed = i64::from(SEED);
    let form = row.form;
    match row.dimension {
        2 => Some(values(NAME, form, step, move |[x, y]: [f64; 2]| fast::noise2(seed, x, y))),
        3 => Some(values(NAME, form, step, move |[x, y, z]: [f64; 3]| fast::noise3_Fallback(seed, x, y, z))),
        4 => Some(values(NAME, form, step, move |[x, y, z, w]: [f64; 4]| {
            fast::noise4_Fallback(seed, x, y, z, w)
        })),
        _ => None,
    }
}
