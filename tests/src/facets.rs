//! Textbook formulas of the parametric densities in f64, independent of the crate, and integrals
//! over them.

use core::f64::consts::{PI, TAU};

use asperity_ndf_sampling::{
    AshikhminShirley, Beckmann, Blend, BlinnPhong, Ggx, Microfacet, Mixture, Rotated, StudentT, Ward,
};
use glam::{DVec3, Vec2, Vec3};

/// A density of the crate with its textbook formula.
pub struct Facets {
    /// The density and its parameters.
    pub name: String,
    /// Width along x and y, the unit of slopes in bins and quadrature.
    pub width: [f64; 2],
    /// The textbook density.
    pub density: Box<dyn Fn(DVec3) -> f64 + Sync + Send>,
    /// The crate's density.
    pub crate_density: Box<dyn Fn(Vec3) -> f32 + Sync + Send>,
    /// The map from the unit square.
    pub sample: Box<dyn Fn(Vec2) -> Vec3 + Sync + Send>,
    /// The map from Gaussian coordinates, if any.
    pub warp_gaussian: Option<Box<dyn Fn(Vec2) -> Vec3 + Sync + Send>>,
    /// Its visible normals.
    pub sample_visible: Box<dyn Fn(Vec3, Vec2) -> Vec3 + Sync + Send>,
    /// Its density of visible normals.
    pub visible_pdf: Box<dyn Fn(Vec3, Vec3) -> f32 + Sync + Send>,
    /// Its projected area and Λ.
    pub area: Box<dyn Fn(Vec3) -> [f32; 2] + Sync + Send>,
    /// Whether sampling a visible normal takes microseconds.
    pub slow: bool,
    /// Its rotation angle.
    turn: f64,
    /// Quadrature pieces along the slope's length and its angle.
    pieces: [usize; 2],
}

/// The roughnesses of the tests.
pub const ROUGHNESSES: [[f32; 2]; 5] = [[0.02, 0.02], [0.1, 0.1], [0.3, 0.3], [1.0, 1.0], [0.4, 0.04]];

impl Facets {
    fn new<N: Microfacet + Copy + Sync + Send + 'static>(
        name: String,
        ndf: N,
        width: [f64; 2],
        density: impl Fn(DVec3) -> f64 + Sync + Send + 'static,
    ) -> Self {
        Self {
            name,
            width,
            density: Box::new(density),
            crate_density: Box::new(move |m| ndf.d(m)),
            sample: Box::new(move |u| ndf.sample(u)),
            warp_gaussian: Some(Box::new(move |z| ndf.warp_gaussian(z))),
            sample_visible: Box::new(move |v, u| ndf.sample_visible(v, u)),
            visible_pdf: Box::new(move |v, m| ndf.visible_pdf(v, m)),
            area: Box::new(move |v| [ndf.projected_area(v), ndf.lambda(v)]),
            slow: false,
            turn: 0.0,
            pieces: [14, 8],
        }
    }

    /// Returns every density at every valid roughness.
    ///
    /// # Panics
    ///
    /// If the crate returns an error.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for [x, y] in ROUGHNESSES {
            let alpha @ [ax, ay] = [f64::from(x), f64::from(y)];
            let name = |model: &str| format!("{model} ({x}, {y})");
            all.push(Self::new(name("GGX"), Ggx::new(x, y).expect("valid"), alpha, move |m| ggx(alpha, m)));
            let beckmann_ndf = Beckmann::new(x, y).expect("valid");
            all.push(Self::new(name("Beckmann"), beckmann_ndf, alpha, move |m| beckmann(alpha, m)));
            all.push(Self::new(name("Ward"), Ward::new(x, y).expect("valid"), alpha, move |m| {
                beckmann(alpha, m)
            }));
            for gamma in [1.7_f32, 4.0] {
                let ndf = StudentT::new(x, y, gamma).expect("valid");
                let density = move |m| student(alpha, f64::from(gamma), m);
                let mut facets = Self::new(format!("{} {gamma}", name("Student-t")), ndf, alpha, density);
                facets.slow = true;
                all.push(facets);
            }
            let [nu, nv] = alpha.map(|a| ((2.0 / (a * a) - 2.0) as f32).max(0.0));
            let ndf = AshikhminShirley::new(nu, nv).expect("valid");
            let exponents = [nu, nv].map(f64::from);
            all.push(Self::new(name("Ashikhmin–Shirley"), ndf, alpha, move |m| {
                ashikhmin_shirley(exponents, m)
            }));
            if x == y {
                let ndf = BlinnPhong::from_roughness(x).expect("valid");
                let n = f64::from(ndf.exponent());
                let mut facets =
                    Self::new(name("Blinn–Phong"), ndf, alpha, move |m| ashikhmin_shirley([n, n], m));
                facets.slow = true;
                all.push(facets);
                let diffuse = BlinnPhong::new(0.0).expect("valid");
                let ndf = Mixture::new(beckmann_ndf, diffuse, 0.6).expect("valid");
                let weight = f64::from(0.6_f32);
                let density = move |m| weight * beckmann(alpha, m) + (1.0 - weight) / PI;
                let width = [ax.sqrt(), ay.sqrt()];
                let facets = Self::new(name("Beckmann and diffuse"), ndf, width, density);
                all.push(Self { slow: true, pieces: [50, 8], ..facets });
            } else {
                let turned = Rotated::new(Ggx::new(x, y).expect("valid"), 0.7).expect("valid");
                let (sin, cos) = f64::from(0.7_f32).sin_cos();
                let back = move |m: DVec3| DVec3::new(cos * m.x + sin * m.y, cos * m.y - sin * m.x, m.z);
                let facets = Self::new(name("turned GGX"), turned, alpha, move |m| ggx(alpha, back(m)));
                all.push(Self { turn: f64::from(0.7_f32), ..facets });
                let weight = f64::from(0.3_f32);
                let blend = Blend::new(turned, beckmann_ndf, 0.3).expect("valid");
                let density = move |m| weight * ggx(alpha, back(m)) + (1.0 - weight) * beckmann(alpha, m);
                all.push(Self {
                    name: name("turned GGX and Beckmann"),
                    width: [ax, ax],
                    density: Box::new(density),
                    crate_density: Box::new(move |m| blend.d(m)),
                    sample: Box::new(move |u| blend.sample(u)),
                    warp_gaussian: None,
                    sample_visible: Box::new(move |v, u| blend.sample_visible(v, u)),
                    visible_pdf: Box::new(move |v, m| blend.visible_pdf(v, m)),
                    area: Box::new(move |v| [blend.projected_area(v), blend.lambda(v)]),
                    slow: false,
                    turn: 0.0,
                    pieces: [50, 60],
                });
            }
        }
        all
    }

    /// Returns the normal whose slope is `q` widths at angle `psi` relative to the rotated axes.
    #[must_use]
    pub fn normal(&self, q: f64, psi: f64) -> DVec3 {
        let ((sin, cos), (sin_turn, cos_turn)) = (psi.sin_cos(), self.turn.sin_cos());
        let (x, y) = (self.width[0] * q * cos, self.width[1] * q * sin);
        DVec3::new(cos_turn * x - sin_turn * y, sin_turn * x + cos_turn * y, 1.0).normalize()
    }

    /// Returns `x` and `y` in the rotated axes.
    fn unturned(&self, x: f64, y: f64) -> [f64; 2] {
        let (sin, cos) = self.turn.sin_cos();
        [cos * x + sin * y, cos * y - sin * x]
    }

    /// Returns `∫ f(m) max(0, v·m) dω` over all normals, with an error of 1e-6 if `f` is the
    /// density.
    pub fn projected(&self, v: DVec3, f: impl Fn(DVec3) -> f64) -> f64 {
        let [x, y] = self.unturned(v.x, v.y);
        let stretched = [self.width[0] * x, self.width[1] * y];
        let (steep, towards) = (stretched[0].hypot(stretched[1]), stretched[1].atan2(stretched[0]));
        // Slopes beyond q₀ face the view only at some azimuths. x = q/(1 + q) = 1 − y⁶ covers the
        // tails.
        let q0 = if steep > 0.0 { v.z.abs() / steep } else { f64::INFINITY };
        let bend = |q: f64| (1.0 / (1.0 + q)).powf(1.0 / 6.0);
        let ring = |y: f64| {
            let rest = y.powi(6);
            let q = (1.0 - rest) / rest;
            let half = if q > q0 {
                (-v.z / (steep * q)).acos()
            } else if v.z > 0.0 {
                PI
            } else {
                0.0
            };
            let azimuths = composite(towards - half, towards + half, self.pieces[1], |psi| {
                let m = self.normal(q, psi);
                f(m) * v.dot(m).max(0.0) * m.z.powi(3)
            });
            // ds = αx αy q dq dψ, dq = dx/(1 − x)².
            azimuths * q * 6.0 * y.powi(5) / (rest * rest)
        };
        let kink = bend(q0);
        let near = composite(kink, 1.0, self.pieces[0], ring);
        // The azimuths that face the view change like a square root at the kink.
        let far = composite(0.0, if kink > 0.0 { 1.0 } else { 0.0 }, self.pieces[0], |s| {
            2.0 * s * kink * ring(kink * (1.0 - s * s))
        });
        self.width[0] * self.width[1] * (near + far)
    }

    /// Returns the probabilities of the bins of [`bin`](Self::bin) under `f` over solid angle.
    pub fn probabilities(&self, f: impl Fn(DVec3) -> f64) -> Vec<f64> {
        let area = self.width[0] * self.width[1];
        (0..BINS * BINS)
            .map(|bin| {
                let (i, j) = ((bin / BINS) as f64, (bin % BINS) as f64);
                let edge = |k: f64| k / BINS as f64;
                composite(edge(i) * REACH, edge(i + 1.0) * REACH, 1, |x| {
                    let q = x / (1.0 - x);
                    let ring = composite(edge(j) * TAU, edge(j + 1.0) * TAU, 2, |psi| {
                        let m = self.normal(q, psi);
                        f(m) * m.z.powi(3)
                    });
                    area * ring * q / ((1.0 - x) * (1.0 - x))
                })
            })
            .collect()
    }

    /// Returns the bin of a normal: by the length of its slope in widths, then by the slope's
    /// angle.
    #[must_use]
    pub fn bin(&self, m: Vec3) -> Option<usize> {
        let m = m.as_dvec3();
        let [x, y] = self.unturned(m.x, m.y);
        let (x, y) = (x / (self.width[0] * m.z), y / (self.width[1] * m.z));
        let q = x.hypot(y);
        let ring = (q / (1.0 + q) / REACH * BINS as f64).floor();
        let sector = (y.atan2(x).rem_euclid(TAU) / TAU * BINS as f64).floor();
        (ring < BINS as f64).then(|| ring as usize * BINS + (sector as usize).min(BINS - 1))
    }
}

/// Number of bins along the slope's length and its angle.
pub const BINS: usize = 24;
/// Slopes are binned up to 9 widths.
const REACH: f64 = 0.9;

/// GGX, Walter et al. 2007.
#[must_use]
pub fn ggx([ax, ay]: [f64; 2], m: DVec3) -> f64 {
    1.0 / (PI * ax * ay * ((m.x / ax).powi(2) + (m.y / ay).powi(2) + m.z * m.z).powi(2))
}

/// Beckmann, Walter et al. 2007.
#[must_use]
pub fn beckmann([ax, ay]: [f64; 2], m: DVec3) -> f64 {
    let z2 = m.z * m.z;
    (-((m.x / ax).powi(2) + (m.y / ay).powi(2)) / z2).exp() / (PI * ax * ay * z2 * z2)
}

/// Student-t, Ribardière et al. 2017.
#[must_use]
pub fn student([ax, ay]: [f64; 2], gamma: f64, m: DVec3) -> f64 {
    let z2 = m.z * m.z;
    let q2 = ((m.x / ax).powi(2) + (m.y / ay).powi(2)) / z2;
    (1.0 + q2 / (gamma - 1.0)).powf(-gamma) / (PI * ax * ay * z2 * z2)
}

/// Ashikhmin and Shirley 2000, normalized to `∫ D cos θ dω = 1`; Blinn–Phong for equal exponents.
#[must_use]
pub fn ashikhmin_shirley([nu, nv]: [f64; 2], m: DVec3) -> f64 {
    let (x2, y2) = (m.x * m.x, m.y * m.y);
    let exponent = if x2 + y2 > 0.0 { (nu * x2 + nv * y2) / (x2 + y2) } else { 0.0 };
    // cos θ from the slope, because it is near 1.
    let ln_cos = -0.5 * ((x2 + y2) / (m.z * m.z)).ln_1p();
    ((nu + 2.0) * (nv + 2.0)).sqrt() / TAU * (exponent * ln_cos).exp()
}

/// Nodes and weights of Gauss–Legendre quadrature on [0, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_6, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// Returns the integral of `f` with five Gauss–Legendre nodes on each of `pieces` equal pieces.
fn composite(from: f64, to: f64, pieces: usize, f: impl Fn(f64) -> f64) -> f64 {
    if to <= from {
        return 0.0;
    }
    let step = (to - from) / pieces as f64;
    (0..pieces)
        .flat_map(|k| GAUSS.map(|(t, weight)| (from + step * (k as f64 + t), weight * step)))
        .map(|(x, weight)| weight * f(x))
        .sum()
}
