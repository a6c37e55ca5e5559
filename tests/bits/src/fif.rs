//! Fractal interpolation functions, their tables, surfaces and rays at many points.

use alloc::format;

use asperity_fif::{
    Bounded, Fif, HeightField, Hit, Intersect, Interval, PeriodicSurface, Ray, RecurrentFif, cochran_2000,
    glam::DVec3,
};

use crate::digest::{Bits, Digest, Report, plane, square, unit};

const POINTS: u32 = 200;

impl Bits for Bounded {
    fn push_to(self, digest: &mut Digest) {
        digest.push([self.value, self.bound]);
    }
}

impl Bits for Interval {
    fn push_to(self, digest: &mut Digest) {
        digest.push([self.lo, self.hi]);
    }
}

impl Bits for Hit {
    fn push_to(self, digest: &mut Digest) {
        digest.push(self.t);
        digest.push(self.normal);
    }
}

/// Returns abscissa `i` in an interval.
fn within(domain: Interval, i: u32) -> f64 {
    domain.lo + (domain.hi - domain.lo) * f64::from(unit(i, 0))
}

fn curves(report: &mut Report) -> Option<()> {
    report.group("fif: curves and tables");
    let uneven = Fif::affine(&[0.0, 0.2, 0.7, 1.0], &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).ok()?;
    let [f, g] = [cochran_2000::f().ok()?, cochran_2000::g().ok()?]
        .map(|f| f.table(1e-6).map(|table| table.system().clone()));
    for (name, f) in [("f", f.ok()?), ("g", g.ok()?), ("uneven", uneven)] {
        report.row(name, |bits| {
            for i in 0..POINTS {
                let (a, b) = (within(f.domain(), i), within(f.domain(), i + POINTS));
                bits.push(f.evaluate(a, 1e-10));
                bits.push([f.integral_over(a.min(b), a.max(b)).value, f.modulus().at(a * 0.01)]);
            }
            bits.push([f.extrema(1e-6).maximum, f.extrema(1e-6).minimum, f.dimension(), f.range()]);
        });
        let table = f.table(1e-6).ok()?;
        let single = table.to_f32();
        report.row(&format!("table of {name}"), |bits| {
            let x: [f64; POINTS as usize] = core::array::from_fn(|i| within(f.domain(), i as u32));
            let mut y = [0.0; POINTS as usize];
            bits.push(if table.values(&x, &mut y).is_ok() { 1.0_f32 } else { 0.0 });
            bits.push(y);
            let mut y = [0.0; POINTS as usize];
            bits.push(if single.values(&x.map(|x| x as f32), &mut y).is_ok() { 1.0_f32 } else { 0.0 });
            bits.push(y);
        });
    }
    let smooth = cochran_2000::g_hat().ok()?.table(1e-12).ok()?;
    report.row("jets", |bits| {
        for i in 0..POINTS {
            let jet = smooth.evaluate_jet(within(smooth.system().domain(), i));
            bits.push([jet.value, jet.slope, jet.integral]);
        }
    });
    let (x, y) = ([0.0, 1.0, 2.0, 3.5, 4.0], [0.25, 1.0, -0.5, 1.0, 0.3]);
    let f = RecurrentFif::affine(&x, &y, &[0.7, -0.3, 0.9, -0.8], &[[0, 2], [1, 4], [1, 4], [2, 4]]).ok()?;
    report.row("recurrent", |bits| {
        (0..POINTS).for_each(|i| bits.push(f.evaluate(within(f.domain(), i), 1e-9)))
    });
    Some(())
}

fn rays(bits: &mut Digest, surface: &impl Intersect) {
    for i in 0..POINTS {
        let [across, along] = [plane(i), square(i)].map(|v| v.as_dvec2());
        let ray =
            Ray { origin: across.extend(2.5), direction: DVec3::new(along.x - 0.5, along.y - 0.5, -1.0) };
        bits.push(surface.intersect(&ray));
    }
}

fn surfaces(report: &mut Report) -> Option<()> {
    report.group("fif: surfaces and rays");
    let smooth = HeightField::new(cochran_2000::g_hat().ok()?, cochran_2000::g_hat().ok()?).tabulated();
    report.row("height field", |bits| {
        for i in 0..POINTS {
            let [x, y] = (square(i) * 2.0).as_dvec2().to_array();
            bits.push(smooth.height(x, y));
            bits.push(smooth.normal(x, y));
        }
        rays(bits, &smooth);
    });
    let rough = HeightField::new(cochran_2000::f().ok()?, cochran_2000::f().ok()?);
    report.row("rough height field", |bits| rays(bits, &rough));
    let z: [f64; 16] = core::array::from_fn(|k| f64::from((7 * k as u32) % 16) / 16.0);
    let d: [[f64; 2]; 16] =
        core::array::from_fn(|k| [f64::from((5 * k as u32) % 16) / 8.0 - 1.0, 0.25 * z[15 - k]]);
    let torus = PeriodicSurface::new(4, [[2, -1], [1, 2]], 0.375, &z, &d).ok()?;
    report.row("torus", |bits| {
        for i in 0..POINTS {
            let [x, y] = square(i).as_dvec2().to_array();
            bits.push(torus.evaluate(x, y, 1e-9));
            bits.push(torus.normal(x, y));
        }
        rays(bits, &torus);
    });
    Some(())
}

pub(crate) fn tell(report: &mut Report) {
    for part in [curves, surfaces] {
        if part(report).is_none() {
            report.row("invalid system", |_| ());
        }
    }
}
