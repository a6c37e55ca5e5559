// Cellular noise, `asperity_noise::Cellular`: a function of the distances to feature points, one at
// a random place in each cell.
//
// The basis is CELLULAR_FIRST, the distance to the nearest feature point, CELLULAR_SECOND, to the
// second nearest, CELLULAR_BETWEEN, their difference, or CELLULAR_NUMBER, a number in (-1, 1) of
// the nearest. The jitter in [0, 1] is the side of the box in the middle of a cell that contains
// its feature point.

const CELLULAR_FIRST: u32 = 0u;
const CELLULAR_SECOND: u32 = 1u;
const CELLULAR_BETWEEN: u32 = 2u;
const CELLULAR_NUMBER: u32 = 3u;

const CELLULAR_EUCLIDEAN: u32 = 0u;
const CELLULAR_MANHATTAN: u32 = 1u;
const CELLULAR_CHEBYSHEV: u32 = 2u;

// Cells are skipped only if their border is farther than the result by more than rounding.
const CELLULAR_MARGIN: f32 = 0.000004;
const CELLULAR_NOWHERE: f32 = 3.0e38;

// A measure of a distance with one more offset: the square of the Euclidean distance, otherwise the
// distance itself.
fn cellular_joined(metric: u32, measure: f32, way: f32) -> f32 {
    if metric == CELLULAR_EUCLIDEAN {
        return measure + way * way;
    }
    if metric == CELLULAR_MANHATTAN {
        return measure + abs(way);
    }
    return max(measure, abs(way));
}

fn cellular_distance(metric: u32, measure: f32) -> f32 {
    if metric == CELLULAR_EUCLIDEAN {
        return sqrt(measure);
    }
    return measure;
}

// The gradient of a distance; 0 where the distance is 0. If axes tie for the largest offset, the
// first is used.
fn cellular_slopes_2d(metric: u32, way: vec2<f32>, distance: f32) -> vec2<f32> {
    if metric == CELLULAR_EUCLIDEAN {
        if distance > 0.0 {
            return way / distance;
        }
        return vec2<f32>(0.0);
    }
    if metric == CELLULAR_MANHATTAN {
        return sign(way);
    }
    if abs(way.x) < distance {
        return vec2<f32>(0.0, sign(way.y));
    }
    return vec2<f32>(sign(way.x), 0.0);
}

fn cellular_slopes_3d(metric: u32, way: vec3<f32>, distance: f32) -> vec3<f32> {
    if metric == CELLULAR_EUCLIDEAN {
        if distance > 0.0 {
            return way / distance;
        }
        return vec3<f32>(0.0);
    }
    if metric == CELLULAR_MANHATTAN {
        return sign(way);
    }
    if abs(way.x) < distance {
        if abs(way.y) < distance {
            return vec3<f32>(0.0, 0.0, sign(way.z));
        }
        return vec3<f32>(0.0, sign(way.y), 0.0);
    }
    return vec3<f32>(sign(way.x), 0.0, 0.0);
}

// The step of a turn of the search along an axis: 0, one to the nearer side, one to the other side,
// two to the nearer side.
fn cellular_step(turn: u32, towards: f32) -> f32 {
    let cells = f32((turn + 1u) / 2u);
    return towards * select(-cells, cells, (turn & 1u) == 1u);
}

// The minimum offset to a feature point of that cell.
fn cellular_gap(turn: u32, off_center: f32, half: f32) -> f32 {
    let cells = f32((turn + 1u) / 2u);
    return max((cells - half) + select(off_center, -off_center, (turn & 1u) == 1u), 0.0);
}

// The place of a feature point from 16 bits.
fn cellular_place(bits: u32, jitter: f32) -> f32 {
    return (0.5 - 0.5 * jitter) + (f32(bits) + 0.5) * (jitter * 1.5258789e-5);
}

// The turns of the search along an axis.
fn cellular_turns(metric: u32, dimension: u32) -> u32 {
    if metric == CELLULAR_CHEBYSHEV {
        return 3u;
    }
    return select(5u, 2u * dimension + 1u, metric == CELLULAR_MANHATTAN);
}

// The value from the measures of the nearest two feature points and the word of the nearest, and
// the weights of both slopes in its gradient.
struct CellularValue {
    value: f32,
    distances: vec2<f32>,
    slopes: vec2<f32>,
}

fn cellular_value(basis: u32, metric: u32, measures: vec2<f32>, word: u32) -> CellularValue {
    let first = cellular_distance(metric, measures.x);
    let second = cellular_distance(metric, measures.y);
    let distances = vec2<f32>(first, second);
    if basis == CELLULAR_FIRST {
        return CellularValue(first, distances, vec2<f32>(1.0, 0.0));
    }
    if basis == CELLULAR_SECOND {
        return CellularValue(second, distances, vec2<f32>(0.0, 1.0));
    }
    if basis == CELLULAR_BETWEEN {
        return CellularValue(second - first, distances, vec2<f32>(-1.0, 1.0));
    }
    return CellularValue(variate_uniform(integer_hash_further(word, 2u)), distances, vec2<f32>(0.0));
}

// The noise at a position in [0, 1]^2 of a cell.
fn cellular_in_cell_2d(
    cell: vec2<i32>,
    t: vec2<f32>,
    basis: u32,
    metric: u32,
    jitter: f32,
    key: u32,
) -> Sample2d {
    let turns = cellular_turns(metric, 2u);
    let takes_second = basis == CELLULAR_SECOND || basis == CELLULAR_BETWEEN;
    let towards = select(vec2<f32>(1.0), vec2<f32>(-1.0), t < vec2<f32>(0.5));
    let off_center = abs(t - 0.5);
    let half = 0.5 * jitter + CELLULAR_MARGIN;
    var measures = vec2<f32>(CELLULAR_NOWHERE);
    var ranks = vec2<f32>(CELLULAR_NOWHERE);
    var first = vec2<f32>(0.0);
    var second = vec2<f32>(0.0);
    var nearest = 0u;
    for (var j = 0u; j < turns; j++) {
        let gap = cellular_joined(metric, 0.0, cellular_gap(j, off_center.y, half));
        if select(measures.x, measures.y, takes_second) < gap {
            break;
        }
        let y = cellular_step(j, towards.y);
        let y_term = integer_hash_term(1u, cell.y + i32(y));
        for (var i = 0u; i < turns; i++) {
            let gaps = cellular_joined(metric, gap, cellular_gap(i, off_center.x, half));
            if select(measures.x, measures.y, takes_second) < gaps {
                break;
            }
            let x = cellular_step(i, towards.x);
            let word = integer_hash_word(integer_hash_term(0u, cell.x + i32(x)) ^ y_term, key);
            let place = vec2<f32>(cellular_place(word >> 16u, jitter), cellular_place(word & 0xffffu, jitter));
            let way = t - (vec2<f32>(x, y) + place);
            let measure = cellular_joined(metric, cellular_joined(metric, 0.0, way.y), way.x);
            let rank = x * 9.0 + y;
            if measure < measures.x || (measure == measures.x && rank < ranks.x) {
                measures = vec2<f32>(measure, measures.x);
                ranks = vec2<f32>(rank, ranks.x);
                second = first;
                first = way;
                nearest = word;
            } else if measure < measures.y || (measure == measures.y && rank < ranks.y) {
                measures.y = measure;
                ranks.y = rank;
                second = way;
            }
        }
    }
    let found = cellular_value(basis, metric, measures, nearest);
    var gradient = vec2<f32>(0.0);
    if found.slopes.x != 0.0 {
        gradient = found.slopes.x * cellular_slopes_2d(metric, first, found.distances.x);
    }
    if found.slopes.y != 0.0 {
        gradient = cellular_slopes_2d(metric, second, found.distances.y) + gradient;
    }
    return Sample2d(found.value, gradient);
}

// The noise at a position in [0, 1]^3 of a cell.
fn cellular_in_cell_3d(
    cell: vec3<i32>,
    t: vec3<f32>,
    basis: u32,
    metric: u32,
    jitter: f32,
    key: u32,
) -> Sample3d {
    let turns = cellular_turns(metric, 3u);
    let takes_second = basis == CELLULAR_SECOND || basis == CELLULAR_BETWEEN;
    let towards = select(vec3<f32>(1.0), vec3<f32>(-1.0), t < vec3<f32>(0.5));
    let off_center = abs(t - 0.5);
    let half = 0.5 * jitter + CELLULAR_MARGIN;
    var measures = vec2<f32>(CELLULAR_NOWHERE);
    var ranks = vec2<f32>(CELLULAR_NOWHERE);
    var first = vec3<f32>(0.0);
    var second = vec3<f32>(0.0);
    var nearest = 0u;
    for (var k = 0u; k < turns; k++) {
        let gap_z = cellular_joined(metric, 0.0, cellular_gap(k, off_center.z, half));
        if select(measures.x, measures.y, takes_second) < gap_z {
            break;
        }
        let z = cellular_step(k, towards.z);
        let z_term = integer_hash_term(2u, cell.z + i32(z));
        for (var j = 0u; j < turns; j++) {
            let gap = cellular_joined(metric, gap_z, cellular_gap(j, off_center.y, half));
            if select(measures.x, measures.y, takes_second) < gap {
                break;
            }
            let y = cellular_step(j, towards.y);
            let terms = z_term ^ integer_hash_term(1u, cell.y + i32(y));
            for (var i = 0u; i < turns; i++) {
                let gaps = cellular_joined(metric, gap, cellular_gap(i, off_center.x, half));
                if select(measures.x, measures.y, takes_second) < gaps {
                    break;
                }
                let x = cellular_step(i, towards.x);
                let word = integer_hash_word(integer_hash_term(0u, cell.x + i32(x)) ^ terms, key);
                let further = integer_hash_further(word, 1u);
                let place = vec3<f32>(
                    cellular_place(word >> 16u, jitter),
                    cellular_place(word & 0xffffu, jitter),
                    cellular_place(further >> 16u, jitter),
                );
                let way = t - (vec3<f32>(x, y, z) + place);
                let across = cellular_joined(metric, cellular_joined(metric, 0.0, way.y), way.z);
                let measure = cellular_joined(metric, across, way.x);
                let rank = (x * 81.0 + y) + z * 9.0;
                if measure < measures.x || (measure == measures.x && rank < ranks.x) {
                    measures = vec2<f32>(measure, measures.x);
                    ranks = vec2<f32>(rank, ranks.x);
                    second = first;
                    first = way;
                    nearest = word;
                } else if measure < measures.y || (measure == measures.y && rank < ranks.y) {
                    measures.y = measure;
                    ranks.y = rank;
                    second = way;
                }
            }
        }
    }
    let found = cellular_value(basis, metric, measures, nearest);
    var gradient = vec3<f32>(0.0);
    if found.slopes.x != 0.0 {
        gradient = found.slopes.x * cellular_slopes_3d(metric, first, found.distances.x);
    }
    if found.slopes.y != 0.0 {
        gradient = cellular_slopes_3d(metric, second, found.distances.y) + gradient;
    }
    return Sample3d(found.value, gradient);
}

// The noise at any point; 0 if a coordinate is not finite.
fn cellular_noise_2d(p: vec2<f32>, basis: u32, metric: u32, jitter: f32, key: u32) -> Sample2d {
    let at = cell_place_2d(p);
    return sample_known_2d(cellular_in_cell_2d(at.cell, at.place, basis, metric, jitter, key), at.known);
}

fn cellular_noise_3d(p: vec3<f32>, basis: u32, metric: u32, jitter: f32, key: u32) -> Sample3d {
    let at = cell_place_3d(p);
    return sample_known_3d(cellular_in_cell_3d(at.cell, at.place, basis, metric, jitter, key), at.known);
}
