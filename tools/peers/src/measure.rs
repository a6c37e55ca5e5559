//! Rounds over all contenders of a row in turn, so that none has the machine's good minutes to itself.

use std::{
    hint::black_box,
    time::{Duration, Instant},
};

/// Shortest time that is measured at once: far above the clock's own cost and grain.
const SHORTEST: Duration = Duration::from_micros(300);

/// Depths of the stack that rounds go through, about a page together.
const DEPTHS: u32 = 32;

/// One library at one SIMD level, ready to work off a row's samples once.
pub(crate) struct Contender {
    pub(crate) library: &'static str,
    /// `scalar`, what the compiler makes of plain code for the target's baseline, or the set of instructions as the
    /// processor's makers name it, in lower case.
    pub(crate) level: &'static str,
    /// Samples of one pass.
    pub(crate) samples: usize,
    pub(crate) pass: Box<dyn FnMut()>,
}

/// Nanoseconds per sample, by contender and round.
pub(crate) fn rounds(contenders: &mut [Contender], rounds: u32) -> Vec<Vec<f64>> {
    let repeats: Vec<_> = contenders.iter_mut().map(|c| repeats(&mut c.pass)).collect();
    let mut times = vec![Vec::with_capacity(rounds as usize); contenders.len()];
    for round in 0..rounds {
        for turn in 0..contenders.len() {
            // Another one goes first each round, so that nobody always follows the same neighbour's cache.
            let index = (round as usize + turn) % contenders.len();
            let contender = &mut contenders[index];
            let mut took = Duration::ZERO;
            deeper(round % DEPTHS, &mut || took = time(&mut contender.pass, repeats[index]));
            times[index].push(per_sample(took, repeats[index], contender.samples));
        }
    }
    times
}

/// Passes that take long enough together, after one to warm up.
fn repeats(pass: &mut dyn FnMut()) -> u32 {
    pass();
    let mut repeats = 1;
    while repeats < 1 << 20 && time(pass, repeats) < SHORTEST {
        repeats *= 2;
    }
    repeats
}

/// Calls from further down the stack. Where spilled registers lie relative to constants and arrays, modulo a page, was
/// worth up to a factor of two to one and the same function; a process has one such place, the median over rounds has many.
#[inline(never)]
fn deeper(frames: u32, call: &mut dyn FnMut()) {
    let frame = black_box([0_u8; 80]);
    match frames.checked_sub(1) {
        Some(fewer) => deeper(fewer, call),
        None => call(),
    }
    black_box(frame);
}

fn time(pass: &mut dyn FnMut(), repeats: u32) -> Duration {
    let start = Instant::now();
    for _ in 0..repeats {
        pass();
    }
    start.elapsed()
}

fn per_sample(time: Duration, repeats: u32, samples: usize) -> f64 {
    time.as_secs_f64() * 1e9 / f64::from(repeats) / samples as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{cell::RefCell, rc::Rc};

    #[test]
    fn time_is_shared_out_among_passes_and_samples() {
        assert_eq!(per_sample(Duration::from_nanos(6000), 3, 1000), 2.0);
    }

    #[test]
    fn depths_differ_by_a_frame_and_stay_within_four_pages() {
        let place = |depth| {
            let mut place = 0;
            deeper(depth, &mut || place = std::ptr::from_ref(&black_box(0_u8)).addr());
            place
        };
        let places: Vec<_> = (0..DEPTHS).map(place).collect();
        assert!(places.windows(2).all(|pair| pair[1] < pair[0]), "{places:?}");
        // Frames of a build without optimisation are larger.
        let reach = places[0] - places[DEPTHS as usize - 1];
        assert!((2048..=16384).contains(&reach), "{reach}");
    }

    #[test]
    fn everybody_has_a_turn_in_every_round() {
        let log = Rc::new(RefCell::new(Vec::new()));
        let mut contenders: Vec<_> = (0..3)
            .map(|name| {
                let log = Rc::clone(&log);
                let pass = move || {
                    log.borrow_mut().push(name);
                    std::thread::sleep(SHORTEST);
                };
                Contender { library: "", level: "scalar", samples: 1, pass: Box::new(pass) }
            })
            .collect();
        let times = rounds(&mut contenders, 4);
        assert!(times.iter().all(|of_one| of_one.len() == 4));
        // Two passes of each before the first round: one to warm up, one that is long enough.
        assert_eq!(log.borrow()[6..], [0, 1, 2, 1, 2, 0, 2, 0, 1, 0, 1, 2]);
    }
}
