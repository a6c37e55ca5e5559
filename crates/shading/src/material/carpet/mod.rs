//! Car carpet, after Nilsson 2008, §4.2: threads, fibers, seams, dark areas and rim light.

mod carpet;
mod dark_area;
mod fiber;
mod rim_light;
mod seam;
mod thread;

pub use carpet::{Carpet, CarpetParameters};
pub use fiber::{Fiber, Fibers, FibersParameters};
pub use seam::{Seam, SeamPattern, Seams, SeamsParameters};
