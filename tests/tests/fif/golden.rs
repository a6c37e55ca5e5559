//! Pinned bits: a change here is value-breaking and belongs in the changelog.

use std::array;

use asperity_fif::glam::DVec3;
use asperity_fif::{Fif, HeightField, Intersect, Interval, PeriodicSurface, Ray, RecurrentFif, cochran_2000};

use crate::properties::g_hat;

fn pinned(name: &str, got: f64, want: u64) {
    assert_eq!(got.to_bits(), want, "{name}: {got:?} is {:#018x}", got.to_bits());
}

#[test]
fn values_have_pinned_bits() {
    let (f, g) = (cochran_2000::f().unwrap(), cochran_2000::g().unwrap());
    pinned("f", f.evaluate(0.7, 1e-12).value, 0x3ff5_5555_5555_5222);
    pinned("f bound", f.evaluate(0.7, 1e-12).bound, 0x3d57_e5f2_a312_db83);
    pinned("g", g.evaluate(1.3, 1e-9).value, 0x3fe7_aa7a_7cb5_dcf0);
    pinned(
        "f at an address",
        f.value_at_address([0, 1, 1].into_iter().cycle(), 1e-12).unwrap().value,
        0x3ff4_e5e0_a72f_0aaa,
    );
    let uneven = Fif::affine(&[0.0, 0.2, 0.7, 1.0], &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).unwrap();
    pinned("uneven", uneven.evaluate(0.55, 1e-12).value, 0x3fda_2d0e_53ef_3786);
    pinned("uneven integral", uneven.total_integral(), 0x3fcc_524d_848b_b92d);
    pinned("composite", g.pieces()[0].map().compose(g.pieces()[1].map()).q[1], 0xbfc6_6666_6666_6666);
    pinned("maximum", g.extrema(1e-6).maximum.hi, 0x3fff_1340_9876_b2e7);
    let hermite = Fif::hermite(&[0.0, 0.4, 1.0], &[0.0, 1.0, 0.5], &[1.0, 0.0, -1.0], &[0.3, -0.4]).unwrap();
    pinned("hermite", hermite.evaluate(0.3, 1e-12).value, 0x3fec_a3c9_bcac_a65a);
}

#[test]
fn surfaces_have_pinned_bits() {
    let surface = HeightField::new(g_hat(), g_hat()).tabulated();
    pinned("height", surface.height(0.7, 1.6), 0x3fe3_78dd_5f90_5280);
    pinned("normal", surface.normal(0.7, 1.6).unwrap().x, 0x3f80_b3ca_503a_26ff);
    let ray = Ray { origin: DVec3::new(-1.0, 2.5, 2.0), direction: DVec3::new(1.0, -0.75, -0.625) };
    pinned("hit", surface.intersect(&ray).unwrap().t, 0x3ffe_c84a_4d53_6191);
}

#[test]
fn tables_have_pinned_bits() {
    let (f, g) = (cochran_2000::f().unwrap(), cochran_2000::g().unwrap());
    let fast = g.table(1e-12).unwrap();
    pinned("fast", fast.value(1.3), 0x3fe7_aa7a_7cb5_dcef);
    pinned("fast near the left end", fast.value(3e-4), 0x3fcc_062d_0c88_4f2b);
    pinned("fast bound", fast.bound(), 0x3d4f_20e0_8c59_b4ec);
    let fast = f.table(1e-6).unwrap().to_f32();
    pinned("fast in f32", f64::from(fast.value(0.7)), 0x3ff5_5554_a000_0000);
    pinned("fast in f32, bound", f64::from(fast.bound()), 0x3eba_be2f_8000_0000);
    let x = [0.0, 0.2, 0.7, 1.0];
    let uneven = Fif::affine(&x, &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).unwrap();
    let fast = uneven.table(1e-12).unwrap();
    pinned("uneven table", fast.value(0.55), 0x3fda_2d0e_53ef_3559);
    pinned("uneven table, bound", fast.bound(), 0x3d56_6e32_2687_3505);
    let mut nodes = [0.0; 65];
    g.grid(&mut nodes).unwrap();
    pinned("grid", nodes[37], 0x3fd7_b92c_cf6b_e37f);
    let even = Fif::affine(&[0.0, 1.0, 2.0, 3.0], &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).unwrap();
    let mut nodes = [0.0; 28];
    even.grid(&mut nodes).unwrap();
    pinned("grid of thirds", nodes[11], 0x3fe2_0c49_ba5e_3540);
}

#[test]
fn jets_have_pinned_bits() {
    let jet = cochran_2000::g_hat().unwrap().table(1e-12).unwrap().evaluate_jet(0.7);
    pinned("value of a jet", jet.value.value, 0x3fe4_99b6_d997_bfb7);
    pinned("slope of a jet", jet.slope.value, 0xbf85_4e97_9326_221b);
    pinned("integral of a jet", jet.integral.value, 0x3fce_47b7_55fc_35f8);
    pinned("bound of a slope", jet.slope.bound, 0x3d72_8e9d_b4b5_7b9c);
    let hermite = Fif::hermite(
        &[-1.0, 0.0, 1.0, 2.0],
        &[0.3, 1.0, -0.5, 2.0],
        &[1.0, 0.0, -1.0, 0.5],
        &[0.3, -0.2, 0.1],
    );
    let jets = hermite.unwrap().table(1e-9).unwrap();
    let jet = jets.jet(0.77);
    pinned("value of a jet over thirds", jet.value, 0x3fc9_ba15_7d9e_e0d4);
    pinned("slope of a jet over thirds", jet.slope, 0xc00e_848d_8c81_b516);
    pinned("integral of a jet over thirds", jet.integral, 0x3ff0_7f79_a9a1_ad23);
    let twice: Fif<4> = cochran_2000::f_hat().unwrap().integral(0.0).unwrap();
    let [_, _, second] = twice.table(1e-12).unwrap().derivatives(0.7);
    pinned("second derivative", second.value, 0x3ff5_5555_5555_554d);
}

#[test]
fn recurrent_systems_have_pinned_bits() {
    let (x, y) = ([0.0, 1.0, 2.0, 3.5, 4.0], [0.25, 1.0, -0.5, 1.0, 0.3]);
    let f = RecurrentFif::affine(&x, &y, &[0.7, -0.3, 0.9, -0.8], &[[0, 2], [1, 4], [1, 4], [2, 4]]).unwrap();
    pinned("recurrent value", f.evaluate(2.9, 1e-9).value, 0xbff2_0378_6656_014b);
    pinned("recurrent bound", f.evaluate(2.9, 1e-9).bound, 0x3df8_b98a_8fd2_e2e2);
    pinned("recurrent integral", f.integral(3.1).value, 0x3fed_e0c8_3539_70ea);
    pinned("recurrent range", f.range().hi, 0x4019_28d3_1c27_f67b);
}

#[test]
fn sums_have_pinned_bits() {
    let (f, g) = (cochran_2000::f().unwrap(), cochran_2000::g().unwrap());
    pinned("moment", g.moment(2, 1).unwrap().value, 0x3fdf_d3a0_6d3a_06d0);
    pinned("second power", g.moment(0, 2).unwrap().value, 0x3ff1_9c0f_6018_99c0);
    pinned("moment over an interval", g.moment_over(1, 2, 0.3, 1.1).unwrap().value, 0x3fdb_d0a6_7ca4_b71f);
    pinned("second integral", g.nth_integral(2, 1.3).unwrap().value, 0x3fe8_0144_2e36_c387);
    pinned("norm", f.norm_squared().unwrap().value, 0x4001_c71c_71c7_1c71);
    pinned("inner product", f.inner_product(&g).unwrap().value, 0x3fef_8da7_40da_740e);
    pinned("integral over an interval", g.integral_over(0.3, 1.1).value, 0x3fe4_cecb_c186_b733);
    pinned("mean", g.mean(0.3, 1.1).value, 0x3fea_027e_b1e8_64ff);
}

#[test]
fn tori_have_pinned_bits() {
    let z: [f64; 16] = array::from_fn(|k| f64::from((7 * k as u32) % 16) / 16.0);
    let d: [[f64; 2]; 16] =
        array::from_fn(|k| [f64::from((5 * k as u32) % 16) / 8.0 - 1.0, 0.25 * z[15 - k]]);
    let torus = PeriodicSurface::new(4, [[2, -1], [1, 2]], 0.375, &z, &d).unwrap();
    pinned("height of a torus", torus.height(0.3, 0.7), 0x3fb5_bc6e_bf5c_1927);
    pinned("gradient of a torus", torus.gradient(0.3, 0.7).x, 0x3ffb_4fd1_8476_c08f);
    pinned("normal of a torus", torus.normal(0.3, 0.7).y, 0x3fbb_22fb_138f_58cb);
    pinned("mean of a torus", torus.mean().value, 0x3fde_0000_0000_0000);
    let (x, y) = (Interval::new(0.25, 0.5), Interval::new(0.1, 0.2));
    pinned("bound of a torus", torus.bounds(x, y).height.hi, 0x3ff6_addd_dddd_de18);
}
