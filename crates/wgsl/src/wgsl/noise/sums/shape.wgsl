// Shapes of octaves, functions of |n| with creases: asperity_noise::Shape of Signed, Turbulence,
// Plasma, Billow and Ridged.

const FBM_SIGNED: u32 = 0u;
const FBM_TURBULENCE: u32 = 1u;
const FBM_PLASMA: u32 = 2u;
const FBM_BILLOW: u32 = 3u;
const FBM_RIDGED: u32 = 4u;

// A shape at n, `Shape::value`.
fn fbm_shape_value(shape: u32, n: f32) -> f32 {
    let size = abs(n);
    switch shape {
        case FBM_TURBULENCE: {
            return size;
        }
        case FBM_PLASMA: {
            return 1.0 - size;
        }
        case FBM_BILLOW: {
            return (size + size) - 1.0;
        }
        case FBM_RIDGED: {
            return (1.0 - size) * (1.0 - size);
        }
        default: {
            return n;
        }
    }
}

// The slope of a shape at n, on a crease the mean of the slopes of both sides, `Shape::slope`.
fn fbm_shape_slope(shape: u32, n: f32) -> f32 {
    let size = abs(n);
    var slope = 1.0;
    switch shape {
        case FBM_TURBULENCE: {
            slope = 1.0;
        }
        case FBM_PLASMA: {
            slope = -1.0;
        }
        case FBM_BILLOW: {
            slope = 2.0;
        }
        case FBM_RIDGED: {
            slope = (size - 1.0) + (size - 1.0);
        }
        default: {
            return 1.0;
        }
    }
    return select(select(0.0, slope, n > 0.0), -slope, n < 0.0);
}
