// Gaussian slopes along a view: `visible_slope` of `density/gaussian_lanes.rs` of
// asperity-ndf-sampling.

// Mills' ratio to 1e-4 relative, for an intermediate step.
fn visible_slopes_rough_mills_ratio(x: f32) -> f32 {
    let t = 1.0 / (1.0 + x * 0.4);
    let square = t * t;
    let low = 0.39998974 + t * 0.40233887;
    let high = 0.3022581 + t * 0.36106316;
    return t * (low + square * (high - square * 0.21245462));
}

// The quantile of a standard Gaussian to 2e-3 relative, as a starting point.
fn visible_slopes_rough_inverse_cdf(u: f32) -> f32 {
    let t = sqrt(2.0 - elementary_ln(u * (1.0 - u) * 4.0));
    let low = 1.74507 - t * 2.14786;
    let high = (1.691288 - t * 0.3292875) + t * t * 0.02313582;
    return (low + t * t * high) * ((u + u) - 1.0);
}

// One step toward the u-quantile from x, given the Gaussian density and the tail beyond |x|.
fn visible_slopes_closer(b: f32, u: f32, per_total: f32, x: f32, density: f32, tail: f32) -> f32 {
    let height = max(b + x, 1e-20);
    let q = density * per_total;
    let p = height * q;
    let per_p = 1.0 / p;
    let growth = q * per_p - x;
    let tail_above = select(tail, 1.0 - tail, x < 0.0);
    let above = b * per_total * tail_above + q;
    let below = max(1.0 - above, 1e-12);
    let is_lower = u < 0.5;
    let newton = select(above - (1.0 - u), 2.0 * (sqrt(u * below) - below), is_lower) * per_p;
    let bend = select(growth, growth - 0.5 * p / below, is_lower);
    let change = newton / max(1.0 + 0.5 * newton * bend, 0.5);
    return x + max(change, height * -0.9);
}

// The u-quantile of the slope along the view, in standard deviations, where b >= 0, at most 1e6, is
// the cotangent of the view angle in these units.
//
// The fraction of slopes below the result is u within 8e-7, and within 2e-6 below u = 1e-5.
fn visible_slopes_quantile(b: f32, u: f32) -> f32 {
    let bounded = max(u, 2.3283064e-10);
    let at_edge = gaussian_pdf(b);
    let per_total = 1.0 / (b * (1.0 - at_edge * gaussian_mills_ratio(b)) + at_edge);
    let gaussian = visible_slopes_rough_inverse_cdf(bounded);
    let y = b + gaussian;
    let root = sqrt(y * y + 4.0);
    let ahead = select((root - y) * 0.5, 2.0 / (root + y), y > 0.0);
    var x = gaussian + ahead;
    var here = gaussian_pdf(x);
    x = visible_slopes_closer(b, bounded, per_total, x, here, here * visible_slopes_rough_mills_ratio(abs(x)));
    here = gaussian_pdf(x);
    return visible_slopes_closer(b, bounded, per_total, x, here, here * gaussian_mills_ratio(abs(x)));
}
