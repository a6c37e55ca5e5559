// Fibers, threads that remain threads in close-ups: `asperity_shading::material::Fibers`.

// A factor of color, and the slope in texture coordinates.
struct FibersSample {
    factor: f32,
    slope: vec2<f32>,
}

// The top fiber at a point.
fn fibers_top(fibers: Fibers, uv: vec2<f32>) -> FibersSample {
    var top = FibersSample(1.0 + fibers.contrast * (0.1 - 1.0), vec2<f32>(0.0));
    var highest = -1.0;
    let half_width = fibers.half_width;
    let place = segments_place(fibers.segments, uv, fibers.bend + half_width);
    for (var i = 0u; i < 9u; i++) {
        if !segments_reaches(place, i) {
            continue;
        }
        for (var k = 0u; k < 8u; k++) {
            let near = segments_near(fibers.segments, place, i, k);
            let bend = (2.0 * near.random.y - 1.0) * fibers.bend;
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
                let by_along = -2.0 * bend * t / (0.5 * fibers.segments.length);
                let by_end = -8.0 * half_width * fourth * squared * t / (0.5 * fibers.segments.length);
                let brightness = (0.5 + 0.5 * near.random.x) * (0.35 + 0.65 * rise);
                top = FibersSample(
                    1.0 + fibers.contrast * (brightness - 1.0),
                    (direction_left_2d(near.direction) + near.direction * by_along) * (-2.0 * s)
                        + near.direction * by_end,
                );
            }
        }
    }
    return top;
}

// The fraction of fibers that a pixel of this width in texture coordinates resolves.
fn fibers_kept(fibers: Fibers, footprint: f32) -> f32 {
    return footprint_kept(footprint, 0.25 / fibers.half_width);
}

// Factor and slope filtered over a pixel: `Fibers::sample`.
fn fibers_sample(fibers: Fibers, uv: vec2<f32>, footprint: f32) -> FibersSample {
    let kept = fibers_kept(fibers, footprint);
    if !(kept > 0.0) || segments_place(fibers.segments, uv, 0.0).farthest < 0.0 {
        return FibersSample(1.0, vec2<f32>(0.0));
    }
    let near = fibers_top(fibers, uv);
    return FibersSample(1.0 + kept * (near.factor / fibers.mean - 1.0), near.slope * kept);
}
