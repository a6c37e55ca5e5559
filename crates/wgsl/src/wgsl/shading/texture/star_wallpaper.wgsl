// Wallpaper with a star in some of its cells: `asperity_shading::texture::StarWallpaper`.

// The depth of a point inside the star around the origin, near its edge the distance to the nearest
// edge.
fn star_wallpaper_inside(stars: StarWallpaper, p: vec2<f32>) -> f32 {
    let turn = (math_angle(p.x, p.y) + 3.1415927) / stars.angle;
    let fraction = turn - floor(turn);
    let around = elementary_cos_sin_turns(min(fraction, 1.0 - fraction) / stars.points);
    let tip = vec2<f32>(stars.r_max, 0.0);
    let edge = stars.r_min * stars.half_angle - tip;
    let apart = sqrt(dot(p, p)) * around - tip;
    return (edge.x * apart.y - edge.y * apart.x) / sqrt(dot(edge, edge));
}

// The fraction of a box of this width that the star covers.
fn star_wallpaper_ramped(stars: StarWallpaper, p: vec2<f32>, footprint: f32) -> f32 {
    let quarter = 0.25 * footprint;
    if quarter == 0.0 {
        return select(0.0, 1.0, star_wallpaper_inside(stars, p) >= 0.0);
    }
    var sum = 0.0;
    for (var k = 0u; k < 4u; k++) {
        let offset = vec2<f32>(select(quarter, -quarter, k < 2u), select(quarter, -quarter, (k & 1u) == 0u));
        sum += clamp(0.5 + star_wallpaper_inside(stars, p + offset) / (2.0 * quarter), 0.0, 1.0);
    }
    return 0.25 * sum;
}

// The fraction of stars within a pixel of this width, in [0, 1]: `StarWallpaper::coverage`.
fn star_wallpaper_coverage(stars: StarWallpaper, uv: vec2<f32>, footprint: f32) -> f32 {
    if !direction_is_finite(vec3<f32>(uv, 0.0)) {
        return 0.0;
    }
    let far = frequency_clamp_filtered_fraction(footprint, 0.75 / stars.r_max);
    if far >= 1.0 {
        return stars.mean;
    }
    let corner = floor(uv * stars.cells);
    var bare = 1.0;
    for (var k = 0u; k < 9u; k++) {
        // Column by column, along the rows.
        let cell = corner + vec2<f32>(f32(k / 3u) - 0.5, f32(k % 3u) - 0.5);
        if 0.5 + 0.5 * white_noise_2d(cell, stars.presence).value < stars.chance {
            let offset = 0.6 * vec2<f32>(
                white_noise_2d(cell, stars.across).value, white_noise_2d(cell, stars.along).value,
            );
            let p = uv - (cell + offset) / stars.cells;
            // Out of reach of every ramp.
            let reach = stars.r_max + footprint;
            if dot(p, p) < reach * reach {
                bare *= 1.0 - star_wallpaper_ramped(stars, p, footprint);
            }
        }
    }
    let near = 1.0 - bare;
    return near + far * (stars.mean - near);
}
