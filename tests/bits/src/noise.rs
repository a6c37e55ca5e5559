//! Golden bits of noise: the same values as pinned in the crate's own test.

#[path = "../../../crates/noise/tests/golden/computed.rs"]
mod computed;

use alloc::format;

use crate::digest::Report;

pub(crate) fn tell(report: &mut Report) {
    report.group("noise: kinds and sums");
    computed::fields(&mut |name, golden| {
        report.row(&format!("{name}, {}-D", golden.dimension), |bits| {
            bits.push(golden.sample.map(f32::from_bits));
            bits.push(f64::from(golden.digest));
        });
    });
    report.group("noise: batches at every level");
    computed::batches(&mut |name, golden| {
        report.row(&format!("{name}, {}-D", golden.dimension), |bits| bits.push(f64::from(golden.digest)));
    });
    report.group("noise: words, directions, spectra");
    computed::numbers(&mut |name, digest| report.row(name, |bits| bits.push(f64::from(digest))));
}
