//! Every error contains the parameter, its rule and the invalid value, and has the underlying error
//! as its source.

use asperity_fif::glam::DVec3;
use asperity_fif::{
    FifError, FixedFif, FoldedSurface, HeightField, Intersect, Interval, PeriodicSurface, Ray, RecurrentFif,
    cochran_2000, fit,
};

use crate::properties::f;

#[test]
fn errors_contain_parameter_and_value() {
    let torus =
        |side, matrix, z: &[f64]| PeriodicSurface::new(side, matrix, 0.3, z, &[[0.0; 2]; 4]).unwrap_err();
    let folded = |x: &[f64], z: &[f64]| {
        FoldedSurface::new(x, &[0.0, 1.0, 2.0], 0.1, z, &[[0.0; 2]; 9]).unwrap_err().to_string()
    };
    let (knots, turning, mut dented) = ([0.0, 1.0, 2.0], [[2, -1], [1, 2]], [0.5; 9]);
    dented[5] = f64::NAN;
    let mut high = [1e308; 9];
    high[4] = -1e308;
    let ray = Ray { origin: DVec3::Z, direction: DVec3::NEG_Z };
    let surface = HeightField::new(f(), f());
    let batch = surface.intersect_batch(&[ray; 2], Interval::new(0.0, 1.0), 0.0, &mut [None]);
    let steep = FixedFif::<2, 20>::new(&knots, &[0.0; 2], &[[0.0; 20]; 2]).unwrap();
    let cases = [
        (torus(3, turning, &[0.0; 4]).to_string(), "`side` must be a power of two from 2 to 32768, got 3"),
        (
            torus(2, [[1, 1], [1, 2]], &[0.0; 4]).to_string(),
            "`matrix` must have a determinant of magnitude at least 2, got 1",
        ),
        (torus(2, turning, &[0.0; 3]).to_string(), "`z` must have 4 elements, got 3"),
        (folded(&knots[1..], &[0.5; 6]), "`x` must have at least 3 elements, got 2"),
        (
            folded(&[0.0, 2.0, 1.0], &[0.5; 9]),
            "`x[2]` must be finite and greater than the previous knot, got 1",
        ),
        (folded(&knots, &dented), "`z` and `d` must be finite, got NaN at node (1, 2)"),
        (batch.unwrap_err().to_string(), "`hits` must have 2 elements, got 1"),
        (
            steep.inner_product(&steep).unwrap_err().to_string(),
            "degree of the product with `other` must be at most 32, got 38",
        ),
        (
            fit::knots(&knots, &[0.0; 3], -1.0, 8).unwrap_err().to_string(),
            "`tolerance` must be at least 0, got -1",
        ),
    ];
    for (said, sentence) in cases {
        assert_eq!(said, sentence);
    }
    let magnitude = format!("`z` and `d` are too large: magnitude {} overflows the error bounds", 1e308);
    assert_eq!(folded(&knots, &high), magnitude);
}

#[test]
fn fits_and_recurrent_systems_check_the_rules_of_systems() {
    let (x, y) = ([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 0.0, 1.0]);
    let fitted = fit::affine(&x, &y[..3], &[0, 1, 3]).unwrap_err();
    assert_eq!(fitted, FifError::Length { parameter: "y", expected: 4, got: 3 });
    let recurrent = RecurrentFif::affine(&x, &y, &[0.5; 2], &[[0, 3]; 3]).unwrap_err();
    assert_eq!(recurrent, FifError::Length { parameter: "alpha", expected: 3, got: 2 });

    // A sum of overflowing numbers.
    let large = cochran_2000::f().unwrap().scaled(5e307).unwrap();
    let error = large.sum(&large).unwrap_err();
    assert!(matches!(error, FifError::Unbounded { .. } | FifError::JoinUp { .. }), "{error}");
}
