// Slopes within a pixel of a wall of bricks, as weighted facets: `Brick::facets`.
//
//     let facets = brick_facets(wall, uv, widths);
//     for (var j = 0u; j < brick_facets_rows(facets); j++) {
//         let row = brick_facets_row(facets, j);
//         for (var k = 0u; k < brick_facets_columns(facets, row); k++) {
//             let facet = brick_facet(facets, row, k);
//         }
//     }
//
// Ignore facets of zero weight.

// A part of a pulse within an interval: its fraction, 1 on the plateau and 0 on a flank, its height
// and its slope.
struct BrickPart {
    share: f32,
    step: f32,
    round: f32,
    slope: f32,
}

// A part of the wall within a pixel: its fraction, brick 1 or mortar 0, and its slope in texture
// coordinates.
struct BrickFacet {
    share: f32,
    brick: f32,
    slope: vec2<f32>,
}

// The box around a pixel on a wall.
struct BrickFacets {
    wall: Brick,
    // Its middle in the cell, and its sides in cells.
    place: vec2<f32>,
    sides: vec2<f32>,
    // The row of the middle.
    row: i32,
    // Whether the coordinates are finite; otherwise everything is mortar.
    there: bool,
}

// A part of a row, with the slope `part.slope` across the row.
struct BrickRow {
    row: i32,
    part: BrickPart,
}

fn brick_no_part() -> BrickPart {
    return BrickPart(0.0, 0.0, 0.0, 0.0);
}

// One of two parts that represent a whole flank: three Gauss points, of which the outer two have
// the same slope.
fn brick_flank_part(m: f32, share: f32, sign: f32, k: u32) -> BrickPart {
    if !(share > 0.0 && m > 0.0) {
        return brick_no_part();
    }
    if k == 0u {
        return BrickPart(share * 0.5555556, 0.0, 0.5, 0.6 * (sign / m));
    }
    return BrickPart(share * 0.44444445, 0.0, 0.5, 1.5 * (sign / m));
}

// Part k of five of many whole pulses, with equal numbers of rising and falling flanks.
fn brick_whole_part(m: f32, length: f32, plateau: f32, k: u32) -> BrickPart {
    let flanks = max(length - plateau, 0.0);
    if k < 4u {
        return brick_flank_part(m, 0.5 * flanks, select(-1.0, 1.0, k < 2u), k & 1u);
    }
    return BrickPart(length - select(0.0, flanks, m > 0.0), 1.0, 1.0, 0.0);
}

// The part of flank j of four within an interval shorter than a pulse: both flanks of the pulse
// where it begins, and of the next.
fn brick_cut(m: f32, low: f32, high: f32, j: u32) -> vec2<f32> {
    let whole = floor(low) + f32(j >> 1u);
    let rises = (j & 1u) == 0u;
    return vec2<f32>(
        max(select(whole + 1.0 - m, whole, rises), low), min(select(whole + 1.0, whole + m, rises), high),
    );
}

// Part k of nine of the pulse over an interval. The fractions sum to 1.
fn brick_part(m: f32, low: f32, high: f32, k: u32) -> BrickPart {
    let width = high - low;
    if width < BRICK_LEAST {
        let middle = 0.5 * (low + high);
        let value = brick_pulse(m, middle - floor(middle));
        return BrickPart(select(0.0, 1.0, k == 0u), value.step, value.round, value.slope);
    }
    if width >= 1.0 {
        if k > 4u {
            return brick_no_part();
        }
        return brick_whole_part(m, 1.0, brick_pulse_over(m, 0.5 * (low + high), width).step, k);
    }
    if k == 8u {
        var flanks = 0.0;
        for (var j = 0u; j < 4u; j++) {
            let cut = brick_cut(m, low, high, j);
            flanks += select(0.0, (cut.y - cut.x) / width, cut.y > cut.x);
        }
        return BrickPart(max(1.0 - flanks, 0.0), 1.0, 1.0, 0.0);
    }
    let cut = brick_cut(m, low, high, k >> 1u);
    if !(cut.y > cut.x) {
        return brick_no_part();
    }
    let share = (cut.y - cut.x) / width;
    // Two Gauss points, which become the points of a whole flank over its last fifth.
    let whole = clamp(5.0 * (cut.y - cut.x) / m - 4.0, 0.0, 1.0);
    let x = cut.x + select(0.7886751, 0.21132487, (k & 1u) == 0u) * (cut.y - cut.x);
    let value = brick_pulse(m, x - floor(x));
    let of_whole = select(vec2<f32>(0.44444445, 1.5), vec2<f32>(0.5555556, 0.6), (k & 1u) == 0u);
    let sign = select(-1.0, 1.0, (k & 2u) == 0u);
    return BrickPart(
        share * (0.5 + whole * (of_whole.x - 0.5)),
        0.0,
        value.round + whole * (0.5 - value.round),
        value.slope + whole * (of_whole.y * sign / m - value.slope),
    );
}

// The number of parts over an interval of this width, including parts of zero weight.
fn brick_part_count(width: f32) -> u32 {
    if width < BRICK_LEAST {
        return 1u;
    }
    return select(9u, 5u, width >= 1.0);
}

// The facets of a wall within a box with these sides in texture coordinates.
fn brick_facets(wall: Brick, uv: vec2<f32>, widths: vec2<f32>) -> BrickFacets {
    let p = uv / wall.cell;
    if !direction_is_finite(vec3<f32>(p, 0.0)) {
        return BrickFacets(wall, vec2<f32>(0.0), vec2<f32>(0.0), 0, false);
    }
    let corner = floor(p);
    return BrickFacets(wall, p - corner, brick_box(wall, widths), brick_saturated(corner).y, true);
}

// The number of parts of rows within the box, including parts of zero weight.
fn brick_facets_rows(facets: BrickFacets) -> u32 {
    if !(facets.sides.y >= BRICK_LEAST) {
        return 1u;
    }
    return select(15u, 10u, facets.sides.y >= 2.0);
}

// The row `above` rows above the middle's row, at most one.
fn brick_facets_row_above(row: i32, above: i32) -> i32 {
    let last = (above > 0 && row == 2147483647) || (above < 0 && row < -2147483647);
    return select(row + above, row, last);
}

// Part j of the rows.
fn brick_facets_row(facets: BrickFacets, j: u32) -> BrickRow {
    let m = facets.wall.margin.y;
    let t = facets.place.y;
    let height = facets.sides.y;
    if !facets.there {
        return BrickRow(0, BrickPart(1.0, 0.0, 0.0, 0.0));
    }
    if height < BRICK_LEAST {
        return BrickRow(facets.row, brick_part(m, t, t, 0u));
    }
    if height >= 2.0 {
        // All even and odd rows.
        let parity = j / 5u;
        let rows = brick_rows_over(m, t, height, f32(parity));
        let part = brick_whole_part(m, rows.length, rows.step, j % 5u);
        return BrickRow(brick_facets_row_above(facets.row, i32(parity)), part);
    }
    let low = t - 0.5 * height;
    let high = t + 0.5 * height;
    let above = floor(low) + f32(j / 5u);
    let bottom = max(low, above);
    let top = min(high, above + 1.0);
    if !(top > bottom) {
        return BrickRow(facets.row, brick_no_part());
    }
    // Within one row there are the flanks of one pulse.
    let k = j % 5u;
    var part = brick_part(m, bottom, top, select(k, 8u, k == 4u && !(top - bottom >= 1.0)));
    part.share *= (top - bottom) / height;
    return BrickRow(brick_facets_row_above(facets.row, i32(above)), part);
}

// The interval of a row within the box.
fn brick_facets_interval(facets: BrickFacets, row: i32) -> vec2<f32> {
    let s = facets.place.x + brick_shift(row);
    return vec2<f32>(s - 0.5 * facets.sides.x, s + 0.5 * facets.sides.x);
}

// The number of facets of a part of the rows, including facets of zero weight.
fn brick_facets_columns(facets: BrickFacets, row: BrickRow) -> u32 {
    if row.part.share == 0.0 {
        return 0u;
    }
    let interval = brick_facets_interval(facets, row.row);
    return brick_part_count(interval.y - interval.x);
}

// Facet k of a part of the rows.
fn brick_facet(facets: BrickFacets, row: BrickRow, k: u32) -> BrickFacet {
    if !facets.there {
        return BrickFacet(1.0, 0.0, vec2<f32>(0.0));
    }
    let interval = brick_facets_interval(facets, row.row);
    let across = brick_part(facets.wall.margin.x, interval.x, interval.y, k);
    let slope = vec2<f32>(across.slope * row.part.round, across.round * row.part.slope);
    return BrickFacet(row.part.share * across.share, across.step * row.part.step, slope / facets.wall.cell);
}
