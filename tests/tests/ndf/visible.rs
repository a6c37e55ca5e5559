//! Projected areas, Λ and densities of visible normals, against integrals of the textbook
//! densities.

use asperity_tests::assert_abs_diff_eq;
use asperity_tests::facets::Facets;
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// Angles of the views from the normal in degrees; the last two are grazing.
const ANGLES: [f64; 6] = [0.0, 20.0, 50.0, 75.0, 88.0, 90.0];

fn view(angle: f64) -> Vec3 {
    let (sin, cos) = angle.to_radians().sin_cos();
    DVec3::new(sin * 0.8, sin * -0.6, if angle == 90.0 { 0.0 } else { cos }).as_vec3()
}

#[test]
fn projected_areas_match_their_integrals() {
    let worst: Vec<_> = Facets::all()
        .into_par_iter()
        .map(|facets| {
            let (mut worst, mut worst_lambda) = (0.0_f64, 0.0_f64);
            for angle in ANGLES {
                let v = view(angle);
                let (exact, towards) = (facets.projected(v.as_dvec3(), &facets.density), v.as_dvec3());
                // The back-facing part, for Λ without cancellation.
                let hidden = facets.projected(-towards, &facets.density);
                let [area, lambda] = (facets.area)(v).map(f64::from);
                let error = (area / exact - 1.0).abs();
                // Measured 6e-7, from the quadrature in the tails of Student-t 1.7; 2e-7 for the
                // others.
                assert!(error < 2e-6, "{} at {angle}°: {area:e} != {exact:e}", facets.name);
                worst = worst.max(error);
                if v.z > 0.0 {
                    let exact = hidden / towards.z;
                    let error = (lambda - exact).abs() / (exact + 1e-12);
                    // Measured 8e-7 for the same reason. Below 1e-12 only the magnitude is
                    // compared.
                    assert!(error < 2e-6, "{} at {angle}°: Λ {lambda:e} != {exact:e}", facets.name);
                    worst_lambda = worst_lambda.max(error);
                }
            }
            (facets.name, worst, worst_lambda)
        })
        .collect();
    for (name, worst, lambda) in &worst {
        println!("{name}: projected area {worst:.1e}, Λ {lambda:.1e}");
    }
}

#[test]
fn densities_integrate_to_one() {
    let worst: Vec<_> = Facets::all()
        .into_par_iter()
        .map(|facets| {
            // From the zenith the projected area is the area of the macrosurface.
            let density = |m: DVec3| f64::from((facets.crate_density)(m.as_vec3()));
            let total = facets.projected(DVec3::Z, density);
            assert_abs_diff_eq!(total, 1.0, epsilon = 1e-5, "{}: ∫ D cos θ = {total}", facets.name);
            let exact = facets.projected(DVec3::Z, &facets.density);
            assert_abs_diff_eq!(exact, 1.0, epsilon = 1e-5, "{}: the textbook's", facets.name);
            let mut worst = (total - 1.0).abs();
            for angle in ANGLES {
                let v = view(angle);
                // D_v over max(0, v·m), which the integral multiplies again.
                let total = facets.projected(v.as_dvec3(), |m| {
                    let cos = v.as_dvec3().dot(m);
                    if cos > 0.0 { f64::from((facets.visible_pdf)(v, m.as_vec3())) / cos } else { 0.0 }
                });
                let error = (total - 1.0).abs();
                assert!(error < 1e-5, "{} at {angle}°: ∫ D_v = {total}", facets.name);
                worst = worst.max(error);
            }
            worst
        })
        .collect();
    println!("worst of ∫ D cos θ and ∫ D_v: {:.1e}", worst.into_iter().fold(0.0, f64::max));
}
