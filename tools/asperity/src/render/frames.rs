//! Frame sequences: the camera orbits the subject, or zooms in.

use std::sync::atomic::AtomicBool;

use crate::cli::render::Render;
use crate::failure::{Interrupted, Result};
use crate::invocation::Invocation;
use crate::job::{self, Step};
use crate::output::Output;
use crate::progress;
use crate::render::picture::Picture;
use asperity_render::integrator::pixels::Watch;

/// The camera path of a sequence.
pub(crate) struct Frames {
    count: u32,
    /// Degrees about the vertical. The end of the range would repeat the first frame.
    turn: f32,
    /// Magnification of the first and the last frame.
    zoom: [f32; 2],
}

impl Frames {
    /// Returns the requested sequence, if any.
    pub(super) fn of(wanted: &Render) -> Result<Option<Self>> {
        let Some(count) = wanted.frames else { return Ok(None) };
        let turn = wanted.turn.unwrap_or(if wanted.zoom_to.is_some() { 0.0 } else { 360.0 });
        if turn != 0.0 && wanted.zoom != 1.0 {
            return Err("`--zoom` cannot be combined with `--turn`: use `--turn 0` or `--zoom-to`".into());
        }
        let zoom = [wanted.zoom, wanted.zoom_to.unwrap_or(wanted.zoom)];
        Ok(Some(Self { count, turn, zoom }))
    }

    /// Returns angle in degrees and magnification of a frame, counted from 1.
    fn seen(&self, frame: u32) -> (f32, f32) {
        let done = frame.saturating_sub(1) as f32;
        let share = done / self.count.saturating_sub(1).max(1) as f32;
        let [first, last] = self.zoom;
        (self.turn * done / self.count.max(1) as f32, first * (last / first).powf(share))
    }
}

/// Returns the file name of a frame: the zero-padded number replaces the row of `#`.
fn name(pattern: &str, frame: u32) -> Option<String> {
    let begin = pattern.find('#')?;
    let digits = pattern[begin..].bytes().take_while(|&byte| byte == b'#').count();
    let (before, after) = (&pattern[..begin], &pattern[begin + digits..]);
    let number = frame.to_string();
    let zeros = "0".repeat(digits.saturating_sub(number.len()));
    (!after.contains('#')).then(|| format!("{before}{zeros}{number}{after}"))
}

/// Renders the requested frames, each written atomically, or writes them as a job.
pub(super) fn draw(
    wanted: &Render,
    frames: &Frames,
    invocation: &Invocation,
    interrupted: &AtomicBool,
) -> Result<()> {
    let mut picture = Picture::new(wanted)?;
    let pattern = picture.name.clone();
    let [first, last] = wanted.frame.unwrap_or([1, frames.count]);
    if last > frames.count {
        return Err(format!("frame {last} is out of range (expected 1 to {})", frames.count).into());
    }
    let name = |frame: u32| {
        name(&pattern, frame).ok_or_else(|| {
            format!(
                "frames `{}`: file name must contain one row of `#` for the frame number, e.g. frame-####.png",
                wanted.out.display()
            )
        })
    };
    name(first)?;
    if let Some(file) = &wanted.job {
        let mut arguments = job::arguments(invocation.arguments(), &["--job", "--frame", "--out"])?;
        let out = std::path::absolute(&wanted.out)?.display().to_string();
        arguments.extend(["--out".into(), out, "--frame".into(), job::number("Frame")]);
        let tasks = Some(("Frame", format!("{first}-{last}")));
        let place = job::write(
            file,
            "asperity-frames",
            &invocation.command,
            &[Step { name: "Frames", tasks, arguments, after: None }],
        )?;
        progress::say(&format!(
            "job written to {place} ({} tasks; run it with `openjd run` or on a farm)",
            last - first + 1
        ));
        return Ok(());
    }
    let output = Output::new(picture.folder.clone())?;
    for frame in first..=last {
        let (degrees, zoom) = frames.seen(frame);
        picture.from(degrees, zoom);
        let bar = progress::bar(&format!("frame {frame} of {first}–{last}"));
        let mut image = None;
        let result = picture.refined(Watch { progress: &bar, interrupted }, &mut |drawn, _, _| {
            image = Some(drawn);
            bar.set_length(0);
            bar.set_position(0);
            Ok(())
        });
        bar.finish_and_clear();
        match result {
            Err(error) if error.is::<Interrupted>() => {
                progress::say(&format!(
                    "{} frames are done; resume with `--frame {frame}-{last}`",
                    frame - first
                ));
                return Err(error);
            }
            result => result?,
        }
        if let Some(image) = image {
            let image = picture.developed(image);
            output.stream(&name(frame)?, |file| image.write(picture.format, file))?;
        }
    }
    let count = last - first + 1;
    let frames = if count == 1 { "1 frame".into() } else { format!("{count} frames") };
    progress::say(&format!("{frames} written to {}", output.place(&pattern)));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn name_fills_the_row_of_number_signs() {
        assert_eq!(name("frame-####.png", 7).as_deref(), Some("frame-0007.png"));
        assert_eq!(name("#.png", 123).as_deref(), Some("123.png"));
        assert_eq!((name("a.png", 1), name("#-#.png", 1)), (None, None));
        // Longer than the maximum width of a formatted number.
        assert_eq!(name(&"#".repeat(70_000), 1).map(|name| name.len()), Some(70_000));
    }

    #[test]
    fn turn_excludes_its_end_and_zoom_is_exponential() {
        let frames = Frames { count: 4, turn: 360.0, zoom: [1.0, 8.0] };
        let seen = [1, 2, 3, 4].map(|frame| frames.seen(frame));
        assert_eq!(seen.map(|(turn, _)| turn), [0.0, 90.0, 180.0, 270.0]);
        for ((_, zoom), wanted) in seen.into_iter().zip([1.0, 2.0, 4.0, 8.0]) {
            assert!((zoom / wanted - 1.0).abs() < 1e-6, "{zoom}");
        }
        assert_eq!(Frames { count: 1, turn: 360.0, zoom: [2.0, 2.0] }.seen(1), (0.0, 2.0));
    }
}
