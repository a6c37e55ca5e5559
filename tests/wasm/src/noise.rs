//! Golden bits of noise: those that its own test has pinned.

#[path = "../../../crates/noise/tests/golden/computed.rs"]
mod computed;
#[path = "../../../crates/noise/tests/golden/pinned.rs"]
mod pinned;

use pinned::{FIELDS, NUMBERS};

use crate::digest::Report;

pub(crate) fn tell(report: &mut Report) {
    let (mut fields, mut numbers) = (0, 0);
    let mut row = |name: &str, golden: bool, digest: u32| {
        let name = [name, " (other than golden)"];
        report.row(&name[..if golden { 1 } else { 2 }].concat(), |bits| bits.push(f64::from(digest)));
    };
    computed::fields(&mut |name, golden| {
        row(name, FIELDS.get(fields) == Some(&(name, golden)), golden.digest);
        fields += 1;
    });
    computed::batches(&mut |name, golden| row(name, FIELDS.contains(&(name, golden)), golden.digest));
    computed::numbers(&mut |name, digest| {
        row(name, NUMBERS.get(numbers) == Some(&(name, digest)), digest);
        numbers += 1;
    });
}
