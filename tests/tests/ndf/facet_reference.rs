//! Every parametric density, Smith term and sampling map against the reference values.

use asperity_ndf_sampling::{AshikhminShirley, Beckmann, BlinnPhong, Ggx, Microfacet, Ndf, StudentT, Ward};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::reference::{self, numbers, rows};
use glam::{DVec3, Vec2, Vec3};
use serde_json::Value;

fn number(item: &Value, name: &str) -> f64 {
    item[name].as_f64().unwrap_or_else(|| panic!("{name}: a number in {item}"))
}

fn alpha(item: &Value) -> [f32; 2] {
    [number(item, "alpha_x") as f32, number(item, "alpha_y") as f32]
}

/// Returns the density of an item.
pub(crate) fn ndf(item: &Value) -> Box<dyn Microfacet + Sync> {
    match item["model"].as_str().expect("a model") {
        "ggx" => Box::new(Ggx::new(alpha(item)[0], alpha(item)[1]).expect("valid")),
        "beckmann" => Box::new(Beckmann::new(alpha(item)[0], alpha(item)[1]).expect("valid")),
        "blinn_phong" => Box::new(BlinnPhong::new(number(item, "n") as f32).expect("valid")),
        "ashikhmin_shirley" => {
            let [nu, nv] = ["n_u", "n_v"].map(|name| number(item, name) as f32);
            Box::new(AshikhminShirley::new(nu, nv).expect("valid"))
        }
        other => panic!("unknown model {other}"),
    }
}

fn items(file: &Value) -> &Vec<Value> {
    file["items"].as_array().expect("items")
}

fn vector(row: &[f64]) -> DVec3 {
    DVec3::from_slice(row)
}

/// The file's Λ of Beckmann are differences of 30-digit numbers, some even negative. With 60 digits
/// they differ by up to 2e-32.
const LOST: f64 = 3e-32;

/// Half the spacing of `f32` numbers, relative.
const ROUNDING: f64 = 0.5 * f32::EPSILON as f64;

#[test]
fn densities() {
    let file = reference::read("ndf/ndf_eval.json");
    let directions = rows(&file["directions"]);
    let (mut worst, mut compared) = (0.0_f64, 0);
    for item in items(&file) {
        let ndf = ndf(item);
        for (direction, expected) in directions.iter().zip(numbers(&item["D"])) {
            let m = vector(direction);
            let got = f64::from(ndf.d(m.as_vec3()));
            // Densities that fall like exp(−a) amplify the rounding of the two slopes, and of α, by
            // a and by 2.
            let peak = f64::from(ndf.d(Vec3::Z));
            let fall = match item["model"].as_str() {
                Some("ggx") => 0.0,
                Some("beckmann") if m.z > 0.0 => {
                    let [x, y] = alpha(item).map(f64::from);
                    ((m.x / x).powi(2) + (m.y / y).powi(2)) / (m.z * m.z)
                }
                _ if expected > 0.0 => (peak / expected).ln().max(0.0) + 4.0,
                _ => 0.0,
            };
            let relative = 1e-6 + 8.0 * ROUNDING * fall;
            // Below 1e-37 f32 has no significant digits left.
            let tolerance = relative * expected + 1e-37;
            assert_abs_diff_eq!(got, expected, epsilon = tolerance, "{} at {m}", item["model"]);
            if fall < 14.0 && expected > 0.0 {
                worst = worst.max((got / expected - 1.0).abs());
            }
            compared += 1;
        }
    }
    println!("ndf_eval: worst relative error of D over peaks down to e⁻¹⁰: {worst:.1e}, {compared} values");
    assert!(compared == 11 * 200 && worst < 1e-5, "{compared} {worst:e}");
}

#[test]
fn smith_terms() {
    let file = reference::read("ndf/smith.json");
    let (views, lights) = (rows(&file["v"]), rows(&file["w"]));
    let (mut worst_lambda, mut worst_g, mut compared) = (0.0_f64, 0.0_f64, 0);
    for item in items(&file) {
        let ndf = ndf(item);
        let [ax, ay] = alpha(item).map(f64::from);
        let columns = ["Lambda_v", "G1_v", "G1_w", "G2_separable", "G2_height_correlated"]
            .map(|name| numbers(&item[name]));
        for (k, (v, w)) in views.iter().zip(&lights).enumerate() {
            let (v, w) = (vector(v), vector(w));
            let (v32, w32) = (v.as_vec3(), w.as_vec3());
            let got =
                [ndf.lambda(v32), ndf.g1(v32), ndf.g1(w32), ndf.g2_separable(v32, w32), ndf.g2(v32, w32)]
                    .map(f64::from);
            let expected: Vec<f64> = columns.iter().map(|column| column[k]).collect();
            // Beckmann's Λ falls like exp(−a²), which amplifies the rounding of v and α by 2a² and
            // of 1/a by 1.
            let a2 = (v.z * v.z / ((ax * v.x).powi(2) + (ay * v.y).powi(2))).min(1e3);
            let fall = if item["model"] == "beckmann" { 2.0 * a2 } else { 2.0 };
            let error = (got[0] - expected[0]).abs();
            assert!(
                error <= (1e-6 + 3.0 * ROUNDING * fall) * expected[0] + LOST,
                "{} at {v}: Λ {:e} != {:e}",
                item["model"],
                got[0],
                expected[0]
            );
            if fall < 40.0 && expected[0] > 0.0 {
                worst_lambda = worst_lambda.max(error / expected[0]);
            }
            for (got, expected) in got.iter().zip(&expected).skip(1) {
                let error = (got / expected - 1.0).abs();
                assert!(error < 1e-6, "{} at {v}, {w}: {got} != {expected}", item["model"]);
                worst_g = worst_g.max(error);
            }
            compared += 5;
        }
    }
    println!(
        "smith: worst relative error of Λ down to e⁻²⁰: {worst_lambda:.1e}, of G₁ and G₂: {worst_g:.1e}, {compared} values"
    );
    assert!(compared == 7 * 150 * 5 && worst_lambda < 1e-5, "{compared}");
}

/// Returns the distance of a normal from the expected normal in the plane, relative to the expected
/// tilt, or along z.
fn off(got: Vec3, expected: DVec3) -> f64 {
    let off = got.as_dvec3() - expected;
    (off.truncate().length() / expected.truncate().length().max(1e-9)).max(off.z.abs())
}

/// Returns this distance minus the part explained by the rounding of `u`.
fn error(got: Vec3, expected: DVec3, u: [f64; 2]) -> f64 {
    let distance = off(got, expected);
    // Slopes are at most powers of −2/3 of either rest of u, and odd about ½; rotations are by 2π.
    let rest = |u: f64| ROUNDING / u.min(1.0 - u).min((u - 0.5).abs() + if u == 0.5 { 1.0 } else { 0.0 });
    let rest = u.iter().map(|&u| rest(u)).sum::<f64>();
    distance - rest - 2.0 * core::f64::consts::PI * ROUNDING
}

fn vec2(u: &[f64]) -> (Vec2, [f64; 2]) {
    (Vec2::new(u[0] as f32, u[1] as f32), [u[0], u[1]])
}

#[test]
fn sampling_maps() {
    let file = reference::read("ndf/sampling_maps.json");
    let (u, z) = (rows(&file["u"]), rows(&file["z"]));
    let mut worst = [0.0_f64; 3];
    for item in items(&file) {
        let ndf = ndf(item);
        for (u, expected) in u.iter().zip(rows(&item["polar"])) {
            let (u32, u) = vec2(u);
            let error = error(ndf.sample(u32), vector(&expected), u);
            assert!(error < 1e-6, "{} polar at {u:?}: {} {error:e}", item["model"], ndf.sample(u32));
            worst[0] = worst[0].max(off(ndf.sample(u32), vector(&expected)));
        }
        for (z, expected) in z.iter().zip(rows(&item["radial_from_gaussian"])) {
            let expected = vector(&expected);
            let got = ndf.warp_gaussian(Vec2::new(z[0] as f32, z[1] as f32));
            let error = off(got, expected);
            assert!(error < 1e-6, "{} radial at {z:?}: {got} != {expected} {error:e}", item["model"]);
            worst[1] = worst[1].max(error);
            // Every component to its own relative error: small slopes and small cosines keep their
            // precision.
            for (got, expected) in got.to_array().into_iter().zip(expected.as_vec3().to_array()) {
                let error = if expected == 0.0 { got.abs() } else { (got / expected - 1.0).abs() };
                assert!(error < 2e-6, "{} radial at {z:?}: {got:e} != {expected:e}", item["model"]);
            }
            let (back, z) = (ndf.invert(expected.as_vec3()), Vec2::new(z[0] as f32, z[1] as f32));
            let tolerance = if item["model"] == "blinn_phong" { 1e-5 } else { 4e-6 };
            assert_abs_diff_eq!(back, z, epsilon = tolerance, "{}", item["model"]);
        }
        // The file has no slopes of Blinn–Phong.
        if item["slope_rosenblatt"].is_null() {
            continue;
        }
        // From the zenith every normal is visible with its own frequency, and the slope along x is
        // sampled before the slope along y.
        let slopes: Box<dyn Microfacet> = match item["model"].as_str().unwrap() {
            "ggx" => Box::new(StudentT::new(alpha(item)[0], alpha(item)[1], 2.0).unwrap()),
            _ => ndf,
        };
        for (u, expected) in u.iter().zip(rows(&item["slope_rosenblatt"])) {
            let (u32, u) = vec2(u);
            let got = slopes.sample_visible(Vec3::Z, u32);
            let error = error(got, vector(&expected), u);
            assert!(error < 1e-6, "{} slopes at {u:?}: {got} != {expected:?} {error:e}", item["model"]);
            worst[2] = worst[2].max(off(got, vector(&expected)));
        }
    }
    println!(
        "sampling_maps: worst errors over the tilt, with the rounding of u: polar {:.1e}, radial {:.1e}, slopes {:.1e}",
        worst[0], worst[1], worst[2]
    );
}

#[test]
fn visible_normals() {
    let file = reference::read("ndf/vndf_ggx.json");
    let (squares, mut worst) = (rows(&file["u"]), 0.0_f64);
    for item in items(&file) {
        let ggx = Ggx::new(alpha(item)[0], alpha(item)[1]).unwrap();
        let v = vector(&numbers(&item["wo"])).as_vec3();
        for (u, expected) in squares.iter().zip(rows(&item["dupuy_benyoub2023"])) {
            let (u32, u) = vec2(u);
            let error = error(ggx.sample_visible(v, u32), vector(&expected), u);
            assert!(error < 4e-6, "{v} at {u:?}: {} != {expected:?} {error:e}", ggx.sample_visible(v, u32));
            worst = worst.max(off(ggx.sample_visible(v, u32), vector(&expected)));
        }
    }
    println!("vndf_ggx: worst error over the tilt, with the rounding of u: {worst:.1e}");
}

#[test]
fn lobes_of_older_models() {
    let file = reference::read("ndf/ward_blinn_phong.json");
    let pairs: Vec<[DVec3; 2]> = file["pairs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|pair| {
            let pair = rows(pair);
            [vector(&pair[0]), vector(&pair[1])]
        })
        .collect();
    let mut worst = [0.0_f64; 2];
    // The rounding grows with the exponent of the decay from the peak.
    let mut compare = |k: usize, [wi, wo]: [DVec3; 2], got: f64, peak: f64, expected: f64| {
        let (fall, error) = ((peak / expected.max(1e-300)).ln(), (got - expected).abs());
        assert!(
            error <= (1e-6 + 8.0 * ROUNDING * fall) * expected + 1e-37,
            "{wi} {wo}: {got:e} != {expected:e}"
        );
        if fall < 10.0 {
            worst[k] = worst[k].max(error / expected);
        }
    };
    for item in file["ward"].as_array().unwrap() {
        let ward = Ward::new(alpha(item)[0], alpha(item)[1]).unwrap();
        for ([wi, wo], expected) in pairs.iter().zip(numbers(&item["ward92"])) {
            let lobe = |h: Vec3| f64::from(ward.lobe(h)) / (wi.z * wo.z).sqrt();
            compare(0, [*wi, *wo], lobe((*wi + *wo).normalize().as_vec3()), lobe(Vec3::Z), expected);
        }
    }
    for item in file["blinn_phong"].as_array().unwrap() {
        let phong = BlinnPhong::new(number(item, "n") as f32).unwrap();
        for ([wi, wo], row) in pairs.iter().zip(rows(&item["rows"])) {
            let lobe = |h: Vec3| f64::from(phong.d(h));
            compare(1, [*wi, *wo], lobe((*wi + *wo).normalize().as_vec3()), lobe(Vec3::Z), row[0]);
        }
    }
    println!("ward_blinn_phong: worst relative error of Ward {:.1e}, Blinn–Phong {:.1e}", worst[0], worst[1]);
}

#[test]
fn marginals() {
    let file = reference::read("ndf/marginals.json");
    let mut worst = 0.0_f64;
    for item in items(&file) {
        let ndf = ndf(item);
        for (x, expected) in numbers(&item["x"]).into_iter().zip(numbers(&item["m"])) {
            let nx = 2.0 * x - 1.0;
            let chord = (1.0 - nx * nx).sqrt();
            // m = ∫ 4 D dy along the chord, with n_y = chord sin t and 4000 midpoints, exact for
            // periodic integrands.
            let steps = 4000;
            let sum: f64 = (0..steps)
                .map(|k| {
                    let (sin, cos) =
                        ((f64::from(k) + 0.5) / f64::from(steps) * core::f64::consts::PI).sin_cos();
                    // n_y runs from −chord to chord like the cosine.
                    sin * f64::from(ndf.d(DVec3::new(nx, chord * cos, chord * sin).as_vec3()))
                })
                .sum();
            let got = 2.0 * chord * sum * core::f64::consts::PI / f64::from(steps);
            // Below 1e-37 f32 has no significant digits left.
            let error = (got - expected).abs() / (expected + 1e-32);
            assert!(error < 1e-5, "{} at {x}: {got} != {expected} {error:e}", item["model"]);
            worst = worst.max(error);
        }
    }
    println!("marginals: worst relative error of ∫ 4 D dy: {worst:.1e}");
}
