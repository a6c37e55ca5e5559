// Shapes of octaves, functions of |n| with creases: asperity_noise::Shape of Signed, Turbulence,
// Plasma, Billow and Ridged.

const OCTAVES_SIGNED: u32 = 0u;
const OCTAVES_TURBULENCE: u32 = 1u;
const OCTAVES_PLASMA: u32 = 2u;
const OCTAVES_BILLOW: u32 = 3u;
const OCTAVES_RIDGED: u32 = 4u;

// A shape at n, `Shape::value`.
fn octaves_shape_value(shape: u32, n: f32) -> f32 {
    let size = abs(n);
    switch shape {
        case OCTAVES_TURBULENCE: {
            return size;
        }
        case OCTAVES_PLASMA: {
            return 1.0 - size;
        }
        case OCTAVES_BILLOW: {
            return (size + size) - 1.0;
        }
        case OCTAVES_RIDGED: {
            return (1.0 - size) * (1.0 - size);
        }
        default: {
            return n;
        }
    }
}

// The slope of a shape at n, on a crease the mean of the slopes of both sides, `Shape::slope`.
fn octaves_shape_slope(shape: u32, n: f32) -> f32 {
    let size = abs(n);
    var slope = 1.0;
    switch shape {
        case OCTAVES_TURBULENCE: {
            slope = 1.0;
        }
        case OCTAVES_PLASMA: {
            slope = -1.0;
        }
        case OCTAVES_BILLOW: {
            slope = 2.0;
        }
        case OCTAVES_RIDGED: {
            slope = (size - 1.0) + (size - 1.0);
        }
        default: {
            return 1.0;
        }
    }
    return select(select(0.0, slope, n > 0.0), -slope, n < 0.0);
}
