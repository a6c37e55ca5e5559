// Normal maps at every zoom as grouped slopes: `asperity_shading::normal_map::SlopePyramidRef`, one
// group at a time.
//
// The table `slope_pyramid_number` has two numbers for the center of each group, two for the slope
// of each texel, and six for each group of each texel of every level: weight, mean, covariance.

// A part of the slopes within a pixel: its weight and its moments.
struct SlopeLobe {
    weight: f32,
    moments: SlopeMoments,
}

// A running mixture of lobes, with the weights of all its parts.
struct SlopePyramidMixture {
    lobe: SlopeLobe,
    all: f32,
}

fn slope_pyramid_nothing() -> SlopePyramidMixture {
    return SlopePyramidMixture(SlopeLobe(0.0, SlopeMoments(vec2<f32>(0.0), vec3<f32>(0.0))), 0.0);
}

// The mixture with another part of this weight, which is ignored unless it is positive.
fn slope_pyramid_with(mixture: SlopePyramidMixture, share: f32, part: SlopeLobe) -> SlopePyramidMixture {
    var mixed = mixture;
    if share > 0.0 {
        mixed.all += share;
        let weight = share * part.weight;
        if weight > 0.0 {
            mixed.lobe.weight += weight;
            mixed.lobe.moments = slope_moments_joined(mixed.lobe.moments, part.moments, weight / mixed.lobe.weight);
        }
    }
    return mixed;
}

fn slope_pyramid_mixed(mixture: SlopePyramidMixture) -> SlopeLobe {
    return SlopeLobe(mixture.lobe.weight / select(1.0, mixture.all, mixture.all > 0.0), mixture.lobe.moments);
}

// The texels around a point along one axis, and the weight of the second.
struct SlopePyramidAxis {
    first: u32,
    second: u32,
    place: f32,
}

// A NaN coordinate is taken as 0.
fn slope_pyramid_axis(u: f32, size: u32) -> SlopePyramidAxis {
    var turn = 0.0;
    if math_is_finite(u) {
        turn = u - floor(u);
    }
    let place = select(0.0, turn * f32(size), turn > 0.0) - 0.5;
    let first = floor(place);
    // The last texel precedes the first.
    let i = u32(i32(first) + i32(size)) % size;
    return SlopePyramidAxis(i, select(0u, i + 1u, i + 1u < size), place - first);
}

// The four texels around a point and their weights.
struct SlopePyramidCorners {
    texels: vec4<u32>,
    weights: vec4<f32>,
}

fn slope_pyramid_corners(uv: vec2<f32>, width: u32, height: u32) -> SlopePyramidCorners {
    let u = slope_pyramid_axis(uv.x, width);
    let v = slope_pyramid_axis(uv.y, height);
    let low = v.first * width;
    let high = v.second * width;
    let x = u.place;
    let y = v.place;
    return SlopePyramidCorners(
        vec4<u32>(low + u.first, low + u.second, high + u.first, high + u.second),
        vec4<f32>((1.0 - x) * (1.0 - y), x * (1.0 - y), (1.0 - x) * y, x * y),
    );
}

fn slope_pyramid_pair(at: u32) -> vec2<f32> {
    return vec2<f32>(slope_pyramid_number(at), slope_pyramid_number(at + 1u));
}

// The slope at a point, bilinear between the centers of the texels.
fn slope_pyramid_slope(map: SlopePyramid, uv: vec2<f32>) -> vec2<f32> {
    let corners = slope_pyramid_corners(uv, map.width, map.height);
    var slope = vec2<f32>(0.0);
    for (var k = 0u; k < 4u; k++) {
        slope += corners.weights[k] * slope_pyramid_pair(2u * (map.groups + corners.texels[k]));
    }
    return slope;
}

// The group of a slope: the group with the nearest center.
fn slope_pyramid_group(map: SlopePyramid, slope: vec2<f32>) -> u32 {
    var best = 0u;
    var least = MATH_LARGEST;
    for (var k = 0u; k < map.groups; k++) {
        let apart = slope - slope_pyramid_pair(2u * k);
        let distance = dot(apart, apart);
        if distance < least {
            best = k;
            least = distance;
        }
    }
    return best;
}

// A group in one level, bilinear between the centers of its texels. Levels beyond the last are the
// last.
fn slope_pyramid_level(map: SlopePyramid, uv: vec2<f32>, level: u32, group: u32) -> SlopeLobe {
    var width = map.width;
    var height = map.height;
    var start = 2u * (map.groups + width * height);
    for (var k = 0u; k < min(level, map.last_level); k++) {
        start += 6u * map.groups * (width * height);
        width = max(width >> 1u, 1u);
        height = max(height >> 1u, 1u);
    }
    let corners = slope_pyramid_corners(uv, width, height);
    var mixture = slope_pyramid_nothing();
    for (var k = 0u; k < 4u; k++) {
        let at = start + 6u * (map.groups * corners.texels[k] + group);
        let covariance = vec3<f32>(slope_pyramid_number(at + 3u), slope_pyramid_pair(at + 4u));
        let lobe = SlopeLobe(slope_pyramid_number(at), SlopeMoments(slope_pyramid_pair(at + 1u), covariance));
        mixture = slope_pyramid_with(mixture, corners.weights[k], lobe);
    }
    return slope_pyramid_mixed(mixture);
}

// A group within a round pixel of this width around a point, in the unit of texture coordinates:
// `SlopePyramidRef::sample`.
fn slope_pyramid_sample(map: SlopePyramid, uv: vec2<f32>, width: f32, group: u32) -> SlopeLobe {
    if !(width < 1.0) {
        return slope_pyramid_mixed(slope_pyramid_with(
            slope_pyramid_nothing(),
            1.0,
            slope_pyramid_level(map, uv, map.last_level, group),
        ));
    }
    let texels = width * f32(max(map.width, map.height));
    var mixture = slope_pyramid_nothing();
    if texels < 1.0 {
        let share = texels * texels;
        let slope = slope_pyramid_slope(map, uv);
        let own = select(0.0, 1.0, slope_pyramid_group(map, slope) == group);
        mixture = slope_pyramid_with(mixture, 1.0 - share, SlopeLobe(own, SlopeMoments(slope, vec3<f32>(0.0))));
        return slope_pyramid_mixed(slope_pyramid_with(mixture, share, slope_pyramid_level(map, uv, 0u, group)));
    }
    let level = min(log2(texels), f32(map.last_level));
    let first = floor(level);
    let share = level - first;
    mixture = slope_pyramid_with(mixture, 1.0 - share, slope_pyramid_level(map, uv, u32(first), group));
    if share > 0.0 {
        mixture = slope_pyramid_with(mixture, share, slope_pyramid_level(map, uv, u32(first) + 1u, group));
    }
    return slope_pyramid_mixed(mixture);
}

// A group within a long pixel around a point, by up to `most` round footprints:
// `SlopePyramidRef::sample_along`.
fn slope_pyramid_sample_along(map: SlopePyramid, uv: vec2<f32>, pixel: PixelEllipse, most: u32, group: u32) -> SlopeLobe {
    let count = pixel_ellipse_tap_count(pixel, most);
    var mixture = slope_pyramid_nothing();
    for (var k = 0u; k < count; k++) {
        let tap = pixel_ellipse_tap(pixel, count, k);
        mixture = slope_pyramid_with(mixture, 1.0, slope_pyramid_sample(map, uv + tap.xy, tap.w, group));
    }
    return slope_pyramid_mixed(mixture);
}
