// Ridges along the edges of a figure: `asperity_shading::texture::Bevel`.

// The nearest point of an edge: its distance, and the unit direction away from it.
struct BevelEdge {
    distance: f32,
    away: vec2<f32>,
}

// Height and slope at a distance from the edge: `Bevel::profile`.
fn bevel_profile(bevel: Bevel, distance: f32) -> vec2<f32> {
    let x = (distance - bevel.plateau) / bevel.flank;
    if x <= 0.0 {
        return vec2<f32>(0.5 * (bevel.top + bevel.bottom) * bevel.flank, 0.0);
    }
    if x < 1.0 {
        let slope = bevel.top + (bevel.bottom - bevel.top) * x;
        return vec2<f32>(0.5 * (1.0 - x) * (slope + bevel.bottom) * bevel.flank, -slope);
    }
    return vec2<f32>(0.0);
}

// The edge from one corner to another, relative to p.
fn bevel_edge(begin: vec2<f32>, end: vec2<f32>, p: vec2<f32>) -> BevelEdge {
    let along = end - begin;
    let offset = p - begin;
    let square = dot(along, along);
    var t = 0.0;
    if square > 0.0 {
        t = clamp(dot(offset, along) / square, 0.0, 1.0);
    }
    let apart = offset - t * along;
    let distance = sqrt(dot(apart, apart));
    let otherwise = direction_unit_or_2d(direction_left_2d(along), vec2<f32>(0.0, 1.0));
    if !(distance > 0.0) {
        return BevelEdge(distance, otherwise);
    }
    // Normalized twice. A tiny distance has lost digits, because its square is subnormal.
    return BevelEdge(distance, direction_unit_or_2d(apart / distance, otherwise));
}

// The nearer of two edges, the first if both are equally near.
fn bevel_nearer(a: BevelEdge, b: BevelEdge) -> BevelEdge {
    if b.distance < a.distance {
        return b;
    }
    return a;
}

// The nearest edge of the unit square, for p within it: `Edge::nearest`.
fn bevel_tile_edge(p: vec2<f32>) -> BevelEdge {
    let left = bevel_edge(vec2<f32>(0.0, 1.0), vec2<f32>(0.0, 0.0), p);
    let below = bevel_edge(vec2<f32>(0.0, 0.0), vec2<f32>(1.0, 0.0), p);
    let right = bevel_edge(vec2<f32>(1.0, 0.0), vec2<f32>(1.0, 1.0), p);
    let above = bevel_edge(vec2<f32>(1.0, 1.0), vec2<f32>(0.0, 1.0), p);
    return bevel_nearer(bevel_nearer(bevel_nearer(left, below), right), above);
}

// Slopes within an interval of distances and their weights: two facets of the flank, and the rest,
// which is flat.
struct BevelFacets {
    slopes: vec2<f32>,
    // Weights of each facet of the flank, and of the flat part.
    flank: f32,
    flat: f32,
}

// `Bevel::facets`: a pixel from one distance to another shows the mean of a lighting model over
// them.
fn bevel_facets(bevel: Bevel, low: f32, high: f32) -> BevelFacets {
    let width = high - low;
    if !(width > 0.0 && width <= MATH_LARGEST) {
        // One facet; both have the same slope.
        let slope = bevel_profile(bevel, 0.5 * (low + high)).y;
        return BevelFacets(vec2<f32>(slope), 0.5, 0.0);
    }
    let begin = max(bevel.plateau, low);
    let flank = max(min(bevel.plateau + bevel.flank, high) - begin, 0.0);
    let flat = max(1.0 - flank / width, 0.0);
    if !(flank > 0.0) {
        return BevelFacets(vec2<f32>(0.0), 0.0, flat);
    }
    let slopes = vec2<f32>(
        bevel_profile(bevel, begin + 0.21132487 * flank).y, bevel_profile(bevel, begin + 0.7886751 * flank).y,
    );
    return BevelFacets(slopes, 0.5 * flank / width, flat);
}
