// Fibers, threads that remain threads in close-ups: `asperity_shading::material::Fibres`.

struct Fibres {
    segments: Segments,
    // Half the width of a fiber, its sideways bend, in texture coordinates; contrast; the mean of
    // its brightness.
    half_width: f32,
    bend: f32,
    contrast: f32,
    mean: f32,
}

// A factor of color, and the slope in texture coordinates.
struct FibresSample {
    factor: f32,
    slope: vec2<f32>,
}

// The top fiber at a point.
fn fibres_top(fibres: Fibres, uv: vec2<f32>) -> FibresSample {
    var top = FibresSample(1.0 + fibres.contrast * (0.1 - 1.0), vec2<f32>(0.0));
    var highest = -1.0;
    let half_width = fibres.half_width;
    let place = segments_place(fibres.segments, uv, fibres.bend + half_width);
    for (var i = 0u; i < 9u; i++) {
        if !segments_reaches(place, i) {
            continue;
        }
        for (var k = 0u; k < 8u; k++) {
            let near = segments_near(fibres.segments, place, i, k);
            let bend = (2.0 * near.random.y - 1.0) * fibres.bend;
            let t = near.along;
            let squared = t * t;
            let fourth = squared * squared;
            let s = (near.across - bend * t * t) / half_width;
            let crown = 1.0 - fourth * fourth - s * s;
            if !near.there || crown <= 0.0 {
                continue;
            }
            let rise = crown * 0.5 * (t + 1.0);
            // The order of roots and tips does not depend on the brightness.
            let spread = near.random.x * 618.034;
            let height = rise + (spread - floor(spread));
            if height > highest {
                highest = height;
                let by_along = -2.0 * bend * t / (0.5 * fibres.segments.length);
                let by_end = -8.0 * half_width * fourth * squared * t / (0.5 * fibres.segments.length);
                let brightness = (0.5 + 0.5 * near.random.x) * (0.35 + 0.65 * rise);
                top = FibresSample(
                    1.0 + fibres.contrast * (brightness - 1.0),
                    (direction_left_2d(near.direction) + near.direction * by_along) * (-2.0 * s)
                        + near.direction * by_end,
                );
            }
        }
    }
    return top;
}

// The fraction of fibers that a pixel of this width in texture coordinates resolves.
fn fibres_kept(fibres: Fibres, footprint: f32) -> f32 {
    return footprint_kept(footprint, 0.25 / fibres.half_width);
}

// Factor and slope filtered over a pixel: `Fibres::sample`.
fn fibres_sample(fibres: Fibres, uv: vec2<f32>, footprint: f32) -> FibresSample {
    let kept = fibres_kept(fibres, footprint);
    if !(kept > 0.0) || segments_place(fibres.segments, uv, 0.0).farthest < 0.0 {
        return FibresSample(1.0, vec2<f32>(0.0));
    }
    let near = fibres_top(fibres, uv);
    return FibresSample(1.0 + kept * (near.factor / fibres.mean - 1.0), near.slope * kept);
}
