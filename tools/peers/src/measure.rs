//! Rounds over all contenders of a row in turn, so that changes of machine load affect all of them.

use std::{
    hint::black_box,
    time::{Duration, Instant},
};

/// Shortest measured duration: far above the cost and the resolution of the clock.
const SHORTEST: Duration = Duration::from_micros(300);

/// Stack depths used by the rounds, about a page in total.
const DEPTHS: u32 = 32;

/// A library at a SIMD level, with a function that computes a row's samples once.
pub(crate) struct Contender {
    pub(crate) library: &'static str,
    /// `scalar`, i.e. plain code compiled for the target's baseline, or the lower-case name of the
    /// instruction set.
    pub(crate) level: &'static str,
    /// Samples of one pass.
    pub(crate) samples: usize,
    pub(crate) pass: Box<dyn FnMut()>,
}

/// Returns nanoseconds per sample, by contender and round.
pub(crate) fn rounds(contenders: &mut [Contender], rounds: u32) -> Vec<Vec<f64>> {
    let repeats: Vec<_> = contenders.iter_mut().map(|c| repeats(&mut c.pass)).collect();
    let mut times = vec![Vec::with_capacity(rounds as usize); contenders.len()];
    for round in 0..rounds {
        for turn in 0..contenders.len() {
            // The first contender changes each round, so that the cache state left by a neighbor
            // varies.
            let index = (round as usize + turn) % contenders.len();
            let contender = &mut contenders[index];
            let mut took = Duration::ZERO;
            deeper(round % DEPTHS, &mut || took = time(&mut contender.pass, repeats[index]));
            times[index].push(per_sample(took, repeats[index], contender.samples));
        }
    }
    times
}

/// Returns a number of passes that take long enough, after one warm-up pass.
fn repeats(pass: &mut dyn FnMut()) -> u32 {
    pass();
    let mut repeats = 1;
    while repeats < 1 << 20 && time(pass, repeats) < SHORTEST {
        repeats *= 2;
    }
    repeats
}

/// Calls from a greater stack depth. The position of spilled registers relative to constants and
/// arrays, modulo a page, changed the time of one function by up to a factor of two. A process has
/// one position, but the median over rounds covers many.
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
    fn time_is_divided_by_passes_and_samples() {
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
        // Frames of an unoptimized build are larger.
        let reach = places[0] - places[DEPTHS as usize - 1];
        assert!((2048..=16384).contains(&reach), "{reach}");
    }

    #[test]
    fn every_contender_runs_in_every_round() {
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
        // Two passes of each before the first round: a warm-up pass, and a pass that is long
        // enough.
        assert_eq!(log.borrow()[6..], [0, 1, 2, 1, 2, 0, 2, 0, 1, 0, 1, 2]);
    }
}
