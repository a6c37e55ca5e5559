// Short oriented segments in the cells of a plane, drawn from hashes, for scratches and fibers.
// `material/segment.rs` of asperity-shading.

// A point among the cells.
struct SegmentsPlace {
    place: vec2<f32>,
    base: vec2<f32>,
    // The square of the maximum distance of midpoints, in cells; negative if cells cannot be
    // resolved.
    farthest: f32,
}

// A segment near a point.
struct SegmentsNear {
    there: bool,
    // The position along it, -1 and 1 at its ends, and the distance to its left.
    along: f32,
    across: f32,
    direction: vec2<f32>,
    // Two random numbers in [0, 1) of the segment.
    random: vec2<f32>,
}

// The cells around a point, for segments whose midpoints are closer than half their length along
// and `aside` across.
fn segments_place(segments: Segments, at: vec2<f32>, aside: f32) -> SegmentsPlace {
    let place = at / segments.cell;
    if !direction_is_finite(vec3<f32>(place, 0.0)) || !(max(abs(place.x), abs(place.y)) < 8388608.0) {
        return SegmentsPlace(vec2<f32>(0.0), vec2<f32>(0.0), -1.0);
    }
    let reach = vec2<f32>(0.5 * segments.length, aside) / segments.cell;
    // Slightly more, for rounding.
    let farthest = min((reach.x * reach.x + reach.y * reach.y) * 1.0001, 1.0);
    return SegmentsPlace(place, floor(place), farthest);
}

// The corner of cell i of nine from the base.
fn segments_corner(place: SegmentsPlace, i: u32) -> vec2<f32> {
    return place.base + (vec2<f32>(f32(i % 3u), f32(i / 3u)) - 1.0);
}

// Whether cell i of nine may have midpoints within the distance.
fn segments_reaches(place: SegmentsPlace, i: u32) -> bool {
    let within = place.place - place.base;
    let column = i % 3u;
    let row = i / 3u;
    let x = select(select(1.0 - within.x, 0.0, column == 1u), within.x, column == 0u);
    let y = select(select(1.0 - within.y, 0.0, row == 1u), within.y, row == 0u);
    return x * x + y * y <= place.farthest;
}

// (cos t, sin t) for |t| at most pi/2, by their series. 1e-7.
fn segments_cos_sin(t: f32) -> vec2<f32> {
    let square = t * t;
    var cosine = 1.0 - square * 0.007575758;
    cosine = 1.0 - square * 0.011111111 * cosine;
    cosine = 1.0 - square * 0.017857144 * cosine;
    cosine = 1.0 - square * 0.033333335 * cosine;
    cosine = 1.0 - square * 0.083333336 * cosine;
    cosine = 1.0 - square * 0.5 * cosine;
    var sine = 1.0 - square * 0.009090909;
    sine = 1.0 - square * 0.013888889 * sine;
    sine = 1.0 - square * 0.023809524 * sine;
    sine = 1.0 - square * 0.05 * sine;
    sine = 1.0 - square * 0.16666667 * sine;
    return vec2<f32>(cosine, t * sine);
}

// Segment k of 8 of cell i of nine, relative to the point.
fn segments_near(segments: Segments, place: SegmentsPlace, i: u32, k: u32) -> SegmentsNear {
    let nowhere = SegmentsNear(false, 0.0, 0.0, vec2<f32>(0.0), vec2<f32>(0.0));
    // Segment k exists with probability cover - k.
    if !(segments.cover > f32(k)) {
        return nowhere;
    }
    let corner = segments_corner(place, i);
    let plane = integer_hash_term(0u, i32(corner.x)) ^ integer_hash_term(1u, i32(corner.y));
    let middle = integer_hash_word(plane ^ integer_hash_term(2u, i32(3u * k + 1u)), segments.key);
    let point = place.place - corner;
    let x = point.x - f32(middle >> 16u) * 0.0000152587890625;
    let y = point.y - f32(middle & 0xffffu) * 0.0000152587890625;
    if !(x * x + y * y <= place.farthest) {
        return nowhere;
    }
    let first = f32(k & 4u);
    let left = segments.cover - first;
    if segments.cover != floor(segments.cover) && left < 4.0 {
        let chance = integer_hash_word(plane ^ integer_hash_term(2u, i32(3u * k)), segments.key);
        if !(f32(chance >> 8u) / 16777216.0 < left - f32(k & 3u)) {
            return nowhere;
        }
    }
    let own = integer_hash_word(plane ^ integer_hash_term(2u, i32(3u * k + 2u)), segments.key);
    let turns = 2.0 * segments.spread * 1.5707964;
    let turn = segments_cos_sin((f32(own >> 20u) * 0.000244140625 - 0.5) * turns);
    let d = segments.direction;
    let direction = vec2<f32>(d.x * turn.x - d.y * turn.y, d.y * turn.x + d.x * turn.y);
    let to_along = segments.cell / (0.5 * segments.length);
    return SegmentsNear(
        true,
        (x * direction.x + y * direction.y) * to_along,
        (direction.x * y - direction.y * x) * segments.cell,
        direction,
        vec2<f32>(f32((own >> 10u) & 1023u) / 1024.0, f32(own & 1023u) / 1024.0),
    );
}
