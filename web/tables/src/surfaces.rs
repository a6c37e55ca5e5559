//! Surfaces of fractal interpolation functions and their rays: products, and a surface that is not
//! a product.

use alloc::{boxed::Box, string::String, vec::Vec};
use core::ptr;
use core::sync::atomic::{AtomicPtr, Ordering};

use asperity_fif::glam::{DVec2, DVec3};
use asperity_fif::{FoldedSurface, HeightField, Intersect, Interval, Ray, Tabulated};

use crate::fractals::{function, knots, told, words};
use crate::number;

/// A surface and the numbers from which it was built.
struct Built {
    numbers: Vec<f64>,
    surface: Box<dyn Intersect>,
}

/// The last surface, whose tables serve all rays of an image.
static LAST: AtomicPtr<Built> = AtomicPtr::new(ptr::null_mut());

fn taken() -> Option<Box<Built>> {
    let last = LAST.swap(ptr::null_mut(), Ordering::AcqRel);
    // SAFETY: the pointer came from a box, and the thread that swaps it out owns it.
    (!last.is_null()).then(|| unsafe { Box::from_raw(last) })
}

fn put_back(built: Box<Built>) {
    let other = LAST.swap(Box::into_raw(built), Ordering::AcqRel);
    // SAFETY: as above.
    drop((!other.is_null()).then(|| unsafe { Box::from_raw(other) }));
}

/// Builds a surface that is not a product, on the grid of the knots. Heights follow the knots along
/// diagonals, forward and backward, and slopes are the differences of neighbors. The factor is
/// three quarters of the function's mean factor times the fraction of the narrowest cell, with
/// which slopes always converge quickly.
fn folded([x, y, factors]: [&[f64]; 3]) -> Result<FoldedSurface, String> {
    let last = x.len().saturating_sub(1);
    let at = |list: &[f64], k: usize| number(list, k);
    let height = |i: usize, j: usize| at(y, (i + j).min(2 * last - i - j));
    let (mut heights, mut slopes) = (Vec::new(), Vec::new());
    for (i, j) in (0..=last).flat_map(|i| (0..=last).map(move |j| (i, j))) {
        let [[left, right], [near, far]] = [i, j].map(|k| [k.saturating_sub(1), (k + 1).min(last)]);
        heights.push(height(i, j));
        slopes.push([
            (height(right, j) - height(left, j)) / (at(x, right) - at(x, left)),
            (height(i, far) - height(i, near)) / (at(x, far) - at(x, near)),
        ]);
    }
    let narrowest = x.windows(2).map(|ends| at(ends, 1) - at(ends, 0)).fold(f64::INFINITY, f64::min);
    let mean = factors.iter().sum::<f64>() / last as f64;
    let factor = 0.75 * mean * narrowest / (at(x, last) - at(x, 0));
    FoldedSurface::new(x, x, factor, &heights, &slopes).map_err(told)
}

/// Calls `answer` with a surface and the numbers after it. The encoding is 0 or 1 for the product
/// of a function or of its integral, 2 for the folded surface, and the function.
fn with_surface<T>(numbers: &[f64], answer: impl FnOnce(&dyn Intersect, &[f64]) -> T) -> Result<T, String> {
    let (lists, rest) = knots(numbers.get(1..).unwrap_or_default());
    let own = numbers.get(..numbers.len() - rest.len()).unwrap_or_default();
    let built = match taken().filter(|built| built.numbers == own) {
        Some(built) => built,
        None => {
            let kind = number(own, 0);
            let surface: Box<dyn Intersect> = if kind > 1.0 {
                // Dragging changes a surface faster than finer tables can be built.
                Box::new(Tabulated::with_levels(folded(lists)?.narrowed(), 5))
            } else {
                let f = function(kind, lists)?;
                Box::new(HeightField::new(f.clone(), f).tabulated())
            };
            Box::new(Built { numbers: own.to_vec(), surface })
        }
    };
    let answered = answer(&*built.surface, rest);
    put_back(built);
    Ok(answered)
}

/// Returns the ends of the domain and of the heights.
pub(crate) fn fractal_ground(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    with_surface(numbers, |surface, _| {
        let ([x, y], z) = (surface.domain(), surface.range());
        words(&[x.lo, x.hi, y.lo, y.hi, z.lo, z.hi])
    })
}

fn vector(numbers: &[f64], at: usize) -> DVec3 {
    DVec3::new(number(numbers, at), number(numbers, at + 1), number(numbers, at + 2))
}

/// Returns the first intersection of a ray with the surface, or nothing. Arguments: surface, height
/// factor, origin and direction of the ray, tolerance.
pub(crate) fn fractal_hit(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    with_surface(numbers, |surface, rest| {
        let heights = number(rest, 0);
        let [origin, direction] = [1, 4].map(|at| vector(rest, at) / DVec3::new(1.0, 1.0, heights));
        let hit = surface.intersect_within(&Ray { origin, direction }, ALL, number(rest, 7));
        hit.map_or_else(Vec::new, |hit| words(&[hit.x, hit.y, heights * hit.height]))
    })
}

const ALL: Interval = Interval { lo: 0.0, hi: f64::INFINITY };

/// Traces rays through pixels, with column and row in a word of bulk each. Returns 5 words per
/// pixel: flags, normal, and the height above the focus in units of the viewer's distance.
///
/// The flags are 0 for no hit, otherwise 1, plus 2 if the hit is not certain to be the first, plus
/// 4 in shadow. The arguments are the surface, the height factor, the focus, the viewer relative to
/// it, the axes to the right, up and forward, the lamp's direction, whether it casts shadows, and
/// pixels along a side.
pub(crate) fn fractal_rays(numbers: &[f64], pixels: &[u32]) -> Result<Vec<u32>, String> {
    with_surface(numbers, |surface, rest| {
        let heights = number(rest, 0);
        let [focus, eye, right, up, forward, lamp] = [1, 4, 7, 10, 13, 16].map(|at| vector(rest, at));
        let (casts_shadows, side) = (number(rest, 19) > 0.0, number(rest, 20));
        let unit = DVec3::new(1.0, 1.0, heights);
        let (origin, pixel) = ((focus + eye) / unit, 2.0 * right.length() / side);
        let tolerance = 0.25 * pixel * eye.length();
        let mut answer = Vec::with_capacity(5 * pixels.len());
        for &at in pixels {
            let place = |k: u32| (2.0 * f64::from(k) + 1.0) / side - 1.0;
            let direction = forward + right * place(at & 0xffff) - up * place(at >> 16);
            let seen = surface.intersect_within(&Ray { origin, direction: direction / unit }, ALL, tolerance);
            let Some(hit) = seen else {
                answer.extend([0; 5]);
                continue;
            };
            // Without a slope, use the mean slope over the pixel.
            let reach = 0.75 * pixel * hit.t;
            let across = |step: DVec2| {
                let [up, down] = [step, -step]
                    .map(|step| surface.evaluate(hit.x + step.x, hit.y + step.y, 0.01 * reach).value);
                (up - down) / (2.0 * reach)
            };
            let slope = hit
                .gradient
                .unwrap_or_else(|| DVec2::new(across(DVec2::X * reach), across(DVec2::Y * reach)));
            let upward = (-heights * slope).extend(1.0).normalize();
            let normal = if upward.dot(direction) > 0.0 { -upward } else { upward };
            let mut shows = 1 + 2 * u32::from(!hit.certain);
            if casts_shadows && normal.dot(lamp) > 0.0 {
                let above = DVec3::new(hit.x, hit.y, heights * hit.height) + 2.0 * reach * normal;
                let ray = Ray { origin: above / unit, direction: lamp / unit };
                shows += 4 * u32::from(surface.occluded(&ray, ALL));
            }
            answer.push(shows);
            answer.extend(normal.as_vec3().to_array().map(f32::to_bits));
            answer.push((((heights * hit.height - focus.z) / eye.length()) as f32).to_bits());
        }
        answer
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fractals::tests::{F, doubles};

    #[test]
    fn rays_hit_surfaces_at_their_height() {
        for surface in [0.0, 1.0, 2.0].map(|kind| [&[kind], &F[..]].concat()) {
            let kind = surface[0];
            let ground = doubles(&fractal_ground(&surface, &[]).unwrap());
            let [x, y] = [0.6 * ground[1], 0.3 * ground[3]];
            let down = [&surface[..], &[0.5, x, y, 9.0, 0.0, 0.0, -1.0, 1e-9]].concat();
            let hit = doubles(&fractal_hit(&down, &[]).unwrap());
            assert!(hit[0] == x && hit[1] == y && hit[2] <= 0.5 * ground[5] + 1e-9, "{kind}: {hit:?}");
            let focus = [hit[0], hit[1], hit[2], 0.0, 0.0, 9.0];
            let axes = [1e-3, 0.0, 0.0, 0.0, 1e-3, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 1.0, 1.0];
            let rays = [&surface[..], &[0.5], &focus, &axes].concat();
            let seen = fractal_rays(&rays, &[0]).unwrap();
            assert!(seen[0] & 1 == 1 && f32::from_bits(seen[3]) > 0.0, "{kind}: {seen:?}");
            // Hits have a tolerance of a quarter of a pixel.
            assert!(f32::from_bits(seen[4]).abs() < 5e-4, "{kind}: {seen:?}");
        }
    }

    /// Returns the height of a folded surface at a point.
    fn height(function: &[f64], [x, y]: [f64; 2]) -> f64 {
        let down = [&[2.0], function, &[1.0, x, y, 99.0, 0.0, 0.0, -1.0, 0.0]].concat();
        doubles(&fractal_hit(&down, &[]).unwrap())[2]
    }

    #[test]
    fn folded_surface_has_diagonal_knots_and_is_not_a_product() {
        let function = [4.0, 0.0, 1.0, 2.5, 3.0, 0.5, 2.0, -1.0, 1.0, 0.5, -0.25, 0.75];
        let ([x, y], at) = ([&function[1..5], &function[5..9]], |i: usize, j: usize| {
            height(&function, [function[1 + i], function[1 + j]])
        });
        for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (i, j))) {
            let knot = y[(i + j).min(6 - i - j)];
            assert!((at(i, j) - knot).abs() < 1e-12, "({i}, {j}): {} for {knot}", at(i, j));
        }
        // A product would give zero here.
        assert!((at(0, 0) * at(1, 1) - at(0, 1) * at(1, 0)).abs() > 0.5);
        // From the first neighbor's height to the second's. Slopes change by about ten times the
        // distance, which is 3e-10 of the domain, to the power ln 4/ln 6.
        let step = 1e-9;
        let slope = (height(&function, [x[1] + step, x[1]]) - at(1, 1)) / step;
        assert!((slope - (y[3] - y[1]) / (x[2] - x[0])).abs() < 1e-4, "{slope}");
    }

    #[test]
    fn factors_near_one_keep_folded_surfaces_smooth() {
        let steep = [3.0, 0.0, 0.01, 2.0, 0.0, 1.0, 0.0, 0.999, 0.999];
        assert!(height(&steep, [0.005, 1.0]).is_finite());
        let unordered = [3.0, 0.0, 2.0, 1.0, 0.0, 1.0, 0.0, 0.5, 0.5];
        let error = fractal_ground(&[&[2.0], &unordered[..]].concat(), &[]).unwrap_err();
        assert!(error.starts_with("`x[2]` must be finite and greater than"), "{error}");
        assert!(fractal_ground(&[2.0], &[]).is_err());
    }
}
