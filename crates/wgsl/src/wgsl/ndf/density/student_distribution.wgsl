// Student's t distribution in 32 bits: density, tail, mean excess, quantile, and the slopes visible
// from a view. `density/student_distribution.rs` of asperity-ndf-sampling uses 64 bits.

struct StudentDistribution {
    // Degrees of freedom, more than 1.
    freedom: f32,
    // The density at 0.
    peak: f32,
}

// Squares overflow from here on.
const STUDENT_DISTRIBUTION_FARTHEST: f32 = 1e18;

// Gamma(x + 1/2)/Gamma(x) for x > 0, by Tricomi and Erdelyi's series beyond x = 5.
fn student_distribution_gamma_ratio(x: f32) -> f32 {
    var above = 1.0;
    var below = 1.0;
    var y = x;
    for (var k = 0; k < 5; k++) {
        if y >= 5.0 {
            break;
        }
        above *= y;
        below *= y + 0.5;
        y += 1.0;
    }
    let t = 1.0 / (8.0 * y);
    let series = 1.0 - t * (1.0 - 0.5 * t * (1.0 + 5.0 * t * (1.0 - 1.05 * t * (1.0 + 19.0 * t))));
    return above / below * sqrt(y) * series;
}

// The distribution with this number of degrees of freedom, more than 1.
fn student_distribution(freedom: f32) -> StudentDistribution {
    return StudentDistribution(freedom, student_distribution_gamma_ratio(0.5 * freedom) / sqrt(3.1415927 * freedom));
}

// The density at z, for |z| < 1e18.
fn student_distribution_pdf(t: StudentDistribution, z: f32) -> f32 {
    return t.peak * elementary_exp(-0.5 * (t.freedom + 1.0) * elementary_ln_1p(z * z / t.freedom));
}

// The integral of t times the density beyond z, even in z, given the density at z.
fn student_distribution_beyond(t: StudentDistribution, z: f32, density: f32) -> f32 {
    return (t.freedom + z * z) / (t.freedom - 1.0) * density;
}

// Whether |z| is below the threshold between the series at 0 and the continued fraction.
fn student_distribution_is_central(t: StudentDistribution, z: f32) -> bool {
    return z * z < 2.0 * t.freedom / (t.freedom + 2.0);
}

// The probability between 0 and z, by a series of positive terms, some fifteen at the threshold.
fn student_distribution_center(t: StudentDistribution, z: f32, density: f32) -> f32 {
    let y = z * z / (t.freedom + z * z);
    var term = 1.0;
    var sum = 1.0;
    for (var k = 0; k < 40; k++) {
        term *= (0.5 * (t.freedom + 1.0) + f32(k)) / (1.5 + f32(k)) * y;
        sum += term;
        if term < 3e-8 * sum {
            break;
        }
    }
    return z * density * sum;
}

// k of 1/(1 + k), the tail times nu z/((nu + z^2) density), by Gauss's continued fraction and
// Steed's algorithm.
fn student_distribution_fraction(t: StudentDistribution, z: f32) -> f32 {
    let c = 0.5 * t.freedom;
    let ratio = t.freedom / (z * z);
    var d = 1.0;
    var change = ratio * 0.5 / (c + 1.0);
    var k_sum = change;
    for (var n = 2; n < 80; n++) {
        let k = f32(n / 2);
        let is_odd = (n & 1) == 1;
        let m = select(k, 0.5 + k, is_odd);
        let above = select(c - 0.5 + k, c + k, is_odd);
        let a = ratio * m / (c + f32(n) - 1.0) * (above / (c + f32(n)));
        d = 1.0 / (1.0 + a * d);
        change *= d - 1.0;
        k_sum += change;
        if abs(change) < 3e-8 * k_sum {
            break;
        }
    }
    return k_sum;
}

// The probability beyond z, given the density at z.
fn student_distribution_tail(t: StudentDistribution, z: f32, density: f32) -> f32 {
    let y = abs(z);
    var upper = 0.0;
    if student_distribution_is_central(t, y) {
        upper = 0.5 - student_distribution_center(t, y, density);
    } else if y < STUDENT_DISTRIBUTION_FARTHEST {
        upper = density * ((t.freedom + y * y) / (t.freedom * y)) / (1.0 + student_distribution_fraction(t, y));
    }
    return select(1.0 - upper, upper, z > 0.0);
}

// The mean excess E[max(0, X - z)] for z >= 0: the mean beyond z minus z times the tail. Beyond the
// threshold it avoids the difference.
fn student_distribution_excess(t: StudentDistribution, z: f32) -> f32 {
    if !(z < STUDENT_DISTRIBUTION_FARTHEST) {
        return 0.0;
    }
    let density = student_distribution_pdf(t, z);
    let beyond = student_distribution_beyond(t, z, density);
    if student_distribution_is_central(t, z) {
        return beyond - z * (0.5 - student_distribution_center(t, z, density));
    }
    let k = student_distribution_fraction(t, z);
    return beyond * (1.0 + (t.freedom - 1.0) * k / (1.0 + k)) / t.freedom;
}

// exp(x) - 1, for x at most 80.
fn student_distribution_exp_less_one(x: f32) -> f32 {
    let y = min(abs(x), 80.0);
    let share = y * elementary_one_minus_exp_ratio(y, elementary_exp(-0.5 * y));
    return select(-share, share * elementary_exp(y), x > 0.0);
}

// An approximate quantile, by Wallace's transform of the Gaussian quantile.
fn student_distribution_guess(t: StudentDistribution, u: f32) -> f32 {
    let nu = t.freedom;
    let z = inverse_gaussian_cdf(u) * (8.0 * nu + 3.0) / (8.0 * nu + 1.0);
    let x = min(sqrt(nu * student_distribution_exp_less_one(z * z / nu)), 1e15);
    return select(x, -x, z < 0.0);
}

// A number between low and high, by their logarithms if they differ by orders of magnitude.
fn student_distribution_middle(low: f32, high: f32) -> f32 {
    let bent_low = select(elementary_ln_1p(max(low, 0.0)), -elementary_ln_1p(max(-low, 0.0)), low < 0.0);
    let bent_high = select(elementary_ln_1p(max(high, 0.0)), -elementary_ln_1p(max(-high, 0.0)), high < 0.0);
    let m = 0.5 * (bent_low + bent_high);
    let middle = student_distribution_exp_less_one(abs(m));
    return select(middle, -middle, m < 0.0);
}

// The u-quantile of the slopes visible from a view, whose density is proportional to (b + x) times
// the density of the distribution for x >= -b. If `is_seen` is false, the u-quantile of the
// distribution itself. The error in u is below 1e-6.
//
// Newton steps in arsinh(x/sqrt(nu)), for the root of u on the left, where the edge is a square,
// and for the logarithm on the right.
fn student_distribution_solve(t: StudentDistribution, is_seen: bool, b: f32, u: f32) -> f32 {
    let wanted = max(u, 2.3283064e-10);
    let guess = student_distribution_guess(t, wanted);
    var x = guess;
    var low = -STUDENT_DISTRIBUTION_FARTHEST;
    var high = STUDENT_DISTRIBUTION_FARTHEST;
    var total = 1.0;
    var edge = 0.0;
    if is_seen {
        let at_edge = student_distribution_pdf(t, b);
        let beyond = student_distribution_beyond(t, b, at_edge);
        let tail = student_distribution_tail(t, b, at_edge);
        total = b * (1.0 - tail) + beyond;
        edge = b * tail - beyond;
        low = -b;
        let y = b + guess;
        if y > 0.0 {
            // Correct for b to infinity to second order in 1/b.
            x = guess + 2.0 / (sqrt(y * y + 4.0) + y);
        } else {
            x = min(sqrt(2.0 * wanted * total / max(at_edge, 1e-30)), b + 1.0) - b;
        }
    }
    let is_left = wanted < 0.5;
    for (var k = 0; k < 24; k++) {
        let density = student_distribution_pdf(t, x);
        // The probability on the smaller side, and the density there.
        var share = student_distribution_tail(t, select(x, -x, is_left), density);
        var slope = density;
        if is_seen {
            let beyond = student_distribution_beyond(t, x, density);
            share = select(b * share + beyond, b * share - beyond - edge, is_left) / total;
            slope = (b + x) * density / total;
        }
        share = max(share, 1e-12);
        let stretch = sqrt(t.freedom + x * x);
        let per_slope = 1.0 / max(slope * stretch, 1e-30);
        var change = 0.0;
        var is_low = false;
        if is_left {
            change = 2.0 * (sqrt(wanted * share) - share) * per_slope;
            is_low = share < wanted;
        } else {
            change = elementary_ln(share / (1.0 - wanted)) * share * per_slope;
            is_low = share > 1.0 - wanted;
        }
        if is_low {
            low = x;
        } else {
            high = x;
        }
        let grown = student_distribution_exp_less_one(clamp(change, -30.0, 30.0));
        let half_sum = 0.5 * grown * grown / (1.0 + grown);
        let half_difference = 0.5 * (grown + grown / (1.0 + grown));
        var next = x + x * half_sum + stretch * half_difference;
        if !(next >= low && next <= high) {
            next = student_distribution_middle(low, high);
        }
        let moved = abs(next - x);
        x = next;
        if moved < 3e-7 * (1.0 + abs(x)) {
            break;
        }
    }
    return x;
}
