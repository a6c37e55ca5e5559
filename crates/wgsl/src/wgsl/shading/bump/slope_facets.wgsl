// Unresolved slopes of a pixel as a few facets: `bump::slope_facets` of asperity-shading.

struct SlopeFacet {
    // The fraction of the pixel, in [0, 1].
    weight: f32,
    // The unit normal.
    normal: vec3<f32>,
}

// Slopes around a bumped normal.
struct SlopeFacets {
    n: vec3<f32>,
    bumped: vec3<f32>,
    // The slope of the bumped normal.
    slope: vec3<f32>,
    // Deviations of the slope along two axes.
    u: vec3<f32>,
    v: vec3<f32>,
    // Whether there are facets in addition to the bumped normal.
    rough: bool,
}

// Slopes around the normal `bumped` of a surface with normal n, with the deviations u and v.
fn slope_facets(n: vec3<f32>, bumped: vec3<f32>, u: vec3<f32>, v: vec3<f32>) -> SlopeFacets {
    let cosine = dot(bumped, n);
    let deviates = u.x != 0.0 || u.y != 0.0 || u.z != 0.0 || v.x != 0.0 || v.y != 0.0 || v.z != 0.0;
    let rough = deviates && direction_is_finite(u) && direction_is_finite(v) && cosine > 0.0 && direction_is_finite(bumped);
    let slope = n - bumped / select(1.0, cosine, rough);
    return SlopeFacets(n, bumped, slope, u, v, rough);
}

// Corner k of a regular hexagon: (cos, sin) of k/6 turns.
fn slope_facets_corner(k: u32) -> vec2<f32> {
    let x = select(select(0.5, -0.5, k == 2u || k == 4u), select(1.0, -1.0, k == 3u), k % 3u == 0u);
    let y = select(0.8660254, 0.0, k % 3u == 0u);
    return vec2<f32>(x, select(y, -y, k > 3u));
}

fn slope_facets_side(facets: SlopeFacets, corner: vec2<f32>, radius: f32) -> vec3<f32> {
    let slope = facets.slope + (facets.u * corner.x + facets.v * corner.y) * radius;
    return surface_gradient_normal(facets.n, slope);
}

// Facet k of `facets_along`, of seven: the middle facet with this weight, and six around it. For
// smooth slopes the first is all.
fn slope_facets_along(facets: SlopeFacets, middle: f32, k: u32) -> SlopeFacet {
    if !facets.rough {
        return SlopeFacet(select(0.0, 1.0, k == 0u), facets.bumped);
    }
    let rest = 1.0 - middle;
    if k == 0u {
        return SlopeFacet(1.0 - rest, facets.bumped);
    }
    let normal = slope_facets_side(facets, slope_facets_corner(k - 1u), sqrt(2.0 / rest));
    return SlopeFacet(rest / 6.0, normal);
}

// Facet k of `slope_facets`, of thirteen: the middle facet and two rings of six. For smooth slopes
// the first is all.
fn slope_facets_gaussian(facets: SlopeFacets, k: u32) -> SlopeFacet {
    if !facets.rough {
        return SlopeFacet(select(0.0, 1.0, k == 0u), facets.bumped);
    }
    if k == 0u {
        return SlopeFacet(0.3333333, facets.bumped);
    }
    if k < 7u {
        return SlopeFacet(0.103668086, slope_facets_side(facets, slope_facets_corner(k - 1u), 1.5924505));
    }
    return SlopeFacet(0.0074430336, slope_facets_side(facets, slope_facets_corner(k - 7u).yx, 3.076378));
}
