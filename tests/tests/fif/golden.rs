//! Pinned bits: a change here is value-breaking and belongs in the change log.

use asperity_fif::glam::DVec3;
use asperity_fif::{Cached, FifBuf, FixedSmooth, HeightField, Ray, paper};

fn pinned(name: &str, got: f64, want: u64) {
    assert_eq!(got.to_bits(), want, "{name}: {got:?} is {:#018x}", got.to_bits());
}

#[test]
fn values_have_the_pinned_bits() {
    let (f, g) = (paper::f().unwrap(), paper::g().unwrap());
    pinned("f", f.evaluate(0.7, 1e-12).value, 0x3ff5_5555_5555_5222);
    pinned("f bound", f.evaluate(0.7, 1e-12).bound, 0x3d57_e5f2_a312_db83);
    pinned("g", g.evaluate(1.3, 1e-9).value, 0x3fe7_aa7a_7cb5_dcf0);
    pinned(
        "f at an address",
        f.value_at_address([0, 1, 1].into_iter().cycle(), 1e-12).unwrap().value,
        0x3ff4_e5e0_a72f_0aaa,
    );
    let uneven = FifBuf::affine(&[0.0, 0.2, 0.7, 1.0], &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).unwrap();
    pinned("uneven", uneven.evaluate(0.55, 1e-12).value, 0x3fda_2d0e_53ef_3786);
    pinned("uneven integral", uneven.total_integral(), 0x3fcc_524d_848b_b92d);
    pinned("composite", paper::G_MAPS[0].compose(&paper::G_MAPS[1]).q[1], 0xbfc6_6666_6666_6666);
    pinned("maximum", g.extrema(1e-6).maximum.hi, 0x3fff_1340_9876_b2e7);
    let hermite =
        FifBuf::hermite(&[0.0, 0.4, 1.0], &[0.0, 1.0, 0.5], &[1.0, 0.0, -1.0], &[0.3, -0.4]).unwrap();
    pinned("hermite", hermite.evaluate(0.3, 1e-12).value, 0x3fec_a3c9_bcac_a65a);
}

#[test]
fn surfaces_have_the_pinned_bits() {
    let axis = FixedSmooth::<2, 3, 2>::integral(paper::g().unwrap(), 0.0).unwrap();
    let surface = HeightField::new(Cached::new(axis), Cached::new(axis));
    pinned("height", surface.height(0.7, 1.6), 0x3fe3_78dd_5f90_5280);
    pinned("normal", surface.normal(0.7, 1.6).unwrap().x, 0x3f80_b3ca_503a_26ff);
    let ray = Ray { origin: DVec3::new(-1.0, 2.5, 2.0), direction: DVec3::new(1.0, -0.75, -0.625) };
    pinned("hit", surface.first_hit(&ray).unwrap().t, 0x3ffe_c84a_4d53_6198);
}
