//! Rows of a kind in the plane against their points one by one.

use asperity_core::lanes::Task;

use crate::{
    contract::kernel::Kernel,
    lanes::{Lanes, level::Level},
    row::row::{Row, Strip},
};

const COUNT: usize = 131;

/// Starts and steps: ascending and descending, across more columns than are kept at once, and without any.
const ROWS: [(f32, f32); 8] =
    [(-3.3, 0.07), (2.9, -0.21), (-7.0, 0.5), (-7.0, 0.9), (7.5, -0.7), (7.5, -0.9), (0.4, 1.3), (1e6, 0.25)];

struct Rows<'a, K>(&'a K);

impl<K: Kernel<2>> Task for Rows<'_, K> {
    type Output = ();

    fn run<S: Lanes>(self, s: S) {
        for (x, step) in ROWS {
            let row = Row::new([x, 0.7], step, 0);
            let (mut values, mut gradients) = ([f32::NAN; COUNT], [[f32::NAN; COUNT]; 2]);
            let strip = Strip::<2, true> {
                row,
                seed: 5,
                values: &mut values,
                gradients: gradients.each_mut().map(|g| &mut g[..]),
            };
            if !self.0.shares(&row, COUNT, false) {
                continue;
            }
            let done = self.0.rows(s, &mut K::RowScratch::default(), strip);
            for i in 0..done {
                let expected = self.0.lone::<true>(row.point(i), 5);
                assert_eq!((values[i], gradients.map(|g| g[i])), expected, "{x} + {i} · {step}");
            }
        }
    }
}

/// Whether rows have the bits of their points, at every level of the machine.
pub(crate) fn check(noise: &impl Kernel<2>) {
    for level in Level::available() {
        level.instructions().run(Rows(noise));
    }
}
