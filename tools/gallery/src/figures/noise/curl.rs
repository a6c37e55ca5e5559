//! Curl noise: streamlines, and area-preserving advection of dye.

use asperity_noise::{Fbm, FbmSpectrum, Field, HasHessian, Simplex, WhiteNoise, curl::Curl2};
use asperity_render::image::tone::hex;
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn};
use crate::figures::noise::gradients::{hue, steepness};
use crate::figures::noise::plane::{Window, gray};
use asperity::failure::Result;

const CELLS: f32 = 3.0;
const OCTAVES: f32 = 2.0;
/// Points of a streamline on each side of a pixel, a pixel apart.
const REACH: usize = 22;
/// Advection distance of the dye: cells at the root mean square speed, and steps.
const WAY: f32 = 0.4;
const STEPS: usize = 24;
/// Dye squares per cell.
const FIELDS: f32 = 3.0;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let window = Window::new(context, CELLS);
    let sum = Fbm::<_, Vec2>::new(Simplex::new(context.seed), FbmSpectrum::CLOUD).with_octaves(OCTAVES);
    let flow = Curl2(sum);
    let speed = steepness(&window.map(context, |p: Vec2| flow.0.sample(p))?);
    let time = WAY / speed;
    let curl = |p| carried(p, time, |p| flow.velocity(p));
    let gradient = |p| carried(p, time, |p| -flow.0.sample(p).gradient);
    let stirred = "A checkerboard stirred into spirals.";
    let squeezed = "A checkerboard squeezed into thin lines around a few enlarged squares.";
    let words = ["streamlines", "streamlines of the curl", "Closed swirling lines, tinted by direction."];
    // Cabral, Leedom 1993, "Imaging Vector Fields Using Line Integral Convolution": white noise
    // blurred along the flow.
    let streamlines = window.draw(context, words, |p| {
        let smeared = |sign: f32| {
            let (mut p, mut sum) = (p, 0.0);
            for _ in 0..REACH {
                p += flow.velocity(p).normalize_or_zero() * (sign * window.step());
                sum += WhiteNoise::new(context.seed).value(p / window.step());
            }
            sum
        };
        let mean = (smeared(1.0) + smeared(-1.0)) / (2 * REACH) as f32;
        hue(flow.velocity(p) / (1.6 * speed)) * gray(0.62 + 2.0 * mean) * 1.9
    })?;
    let panels = vec![
        streamlines,
        window.draw(context, ["dye", "dye advected by the curl", stirred], |p| dye(curl(p)))?,
        window.draw(context, ["gradient", "dye advected by the gradient", squeezed], |p| dye(gradient(p)))?,
    ];
    let row = |name: &str, divergence: f32, areas: &[f32]| {
        let share = |t: f32| format!("{:.3}", areas[(t * (areas.len() - 1) as f32) as usize]);
        [name.to_owned(), format!("{divergence:.0}"), share(0.05), share(0.5), share(0.95)]
    };
    let [first, second] = divergences(window, &flow);
    let rows = [row("curl", first, &areas(window, curl)), row("gradient", second, &areas(window, gradient))];
    let noise = format!("simplex, r² = 0.5, {OCTAVES} octaves, lacunarity 2, gain 0.5, of variance 1");
    Ok(Drawn::new(3, panels)
        .fact("noise", noise)
        .fact("image", format!("{CELLS} × {CELLS} cells"))
        .fact("advection", format!("{WAY} cells at the root mean square speed, {STEPS} midpoint steps"))
        .fact("area before", "area before advection of a unit of area")
        .table(["advected by", "max. divergence", "area before, 5 %", "median", "95 %"], rows))
}

/// Returns the origin of the fluid at a point, by the midpoint rule backward in time.
fn carried(mut p: Vec2, time: f32, velocity: impl Fn(Vec2) -> Vec2) -> Vec2 {
    let step = time / STEPS as f32;
    for _ in 0..STEPS {
        let half = p - velocity(p) * (0.5 * step);
        p -= velocity(half) * step;
    }
    p
}

/// A checkerboard with a second, coarser pattern in another tint.
fn dye(origin: Vec2) -> Vec3 {
    let odd = |p: Vec2| p.floor().element_sum().rem_euclid(2.0) >= 1.0;
    let place = origin * FIELDS;
    let [dark, light] = if odd(place / 4.0) { [0x1f_4e6b, 0xe9_dcc4] } else { [0x8a_3b2e, 0xf3_e9d6] };
    hex(if odd(place) { dark } else { light })
}

/// Returns the area from which a unit of area came, at points of a grid, sorted.
fn areas(window: Window, origin: impl Fn(Vec2) -> Vec2) -> Vec<f32> {
    /// Half the finite-difference distance: wide enough for `f32`, narrow enough for the folds.
    const H: f32 = 1.0 / 1024.0;
    let area = |p| {
        let difference = |d: Vec2| (origin(p + d) - origin(p - d)) / (2.0 * H);
        difference(Vec2::X * H).perp_dot(difference(Vec2::Y * H))
    };
    let mut areas: Vec<f32> = places(window).map(area).collect();
    areas.sort_by(f32::total_cmp);
    areas
}

/// Returns points of a grid over the window.
fn places(window: Window) -> impl Iterator<Item = Vec2> {
    let row = (0..window.side).step_by(6);
    row.clone().flat_map(move |y| row.clone().map(move |x| window.point(x, y)))
}

/// Returns the maximum divergence of the curl and of the gradient over a grid of points.
fn divergences<F: HasHessian<Vec2>>(window: Window, flow: &Curl2<F>) -> [f32; 2] {
    places(window).fold([0.0_f32; 2], |[curl, gradient], p| {
        let [[xx, _], [_, yy]] = flow.velocity_and_jacobian(p).jacobian;
        let [[hxx, _], [_, hyy]] = flow.0.sample_with_hessian(p).hessian;
        [curl.max((xx + yy).abs()), gradient.max((hxx + hyy).abs())]
    })
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn areas_are_jacobian_determinants() {
        let window = Window { corner: Vec2::ZERO, cells: 2.0, side: 8 };
        for area in areas(window, |p| Vec2::new(2.0 * p.x + 0.7 * p.y, 1.5 * p.y)) {
            assert_abs_diff_eq!(area, 3.0, epsilon = 1e-2);
        }
    }

    #[test]
    fn rotation_moves_points_in_a_circle() {
        // A quarter turn at unit angular speed. The midpoint rule lags by h²/6 per unit of time,
        // 1.1e-3 in total.
        let origin = carried(Vec2::X, std::f32::consts::FRAC_PI_2, |p| Vec2::new(-p.y, p.x));
        assert_abs_diff_eq!(origin, Vec2::new(0.0, -1.0), epsilon = 1.2e-3);
    }
}
