//! Encloses √2 by interval arithmetic: bisects an interval until its ends are adjacent floats.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_core::Interval;

fn main() {
    let (mut low, mut high) = (1.0_f64, 2.0);
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        let square = Interval::new(middle, middle).product(Interval::new(middle, middle));
        if square.contains(2.0) {
            break;
        } else if middle * middle < 2.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    println!("√2 is in [{low:?}, {high:?}]");
    assert!(low <= core::f64::consts::SQRT_2 && core::f64::consts::SQRT_2 <= high);
}
