//! Textures.

use asperity_shading::glam::Vec2;
use asperity_shading::texture::{Bevel, BevelParameters, BrickSample, Edge};
use asperity_shading::{Brick, PixelEllipse};
use asperity_wgsl::shading::texture::{BEVEL, BRICK};

use super::{equal, floats, inputs, number, vec2, words};
use crate::case::{Bound, Case, OUTPUTS, packed};

pub(super) fn cases() -> Vec<Case> {
    vec![brick(), bevel()]
}

fn brick() -> Case {
    Case {
        name: "shading/texture/brick".into(),
        parts: vec![&BRICK],
        body: "\
    let wall = Brick(a.xy, a.zw);
    let near = brick_sample(wall, b.xy);
    let far = brick_filtered(wall, b.xy, b.zw);
    outcome.a = bits(vec4<f32>(near.brick, near.height, near.slope));
    outcome.b = bits(vec4<f32>(far.brick, far.height, far.slope));
    outcome.c = vec4<u32>(bitcast<vec2<u32>>(near.cell), bitcast<vec2<u32>>(far.cell));
    outcome.d = bits(vec4<f32>(brick_mean(wall), 0.0, 0.0, 0.0));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let wall = wall(i);
            let uv = [0, 1].map(|k| number(i, k, [-3.0, 3.0]));
            let widths = [2, 3].map(|k| match i % 4 {
                0 => 0.0,
                1 => number(i, k, [0.0, 1e-3]),
                _ => number(i, k, [-8.0, 3.0]).exp(),
            });
            let mut words = inputs(i, &[0.0, 0.0, 0.0, 0.0, uv[0], uv[1], widths[0], widths[1]]);
            words[..4].copy_from_slice(&packed(&wall.gpu()));
            words[8] = i;
            words
        }),
        reference: Box::new(|inputs| {
            let (wall, uv, widths) = (wall(inputs[8]), vec2(inputs, 4), vec2(inputs, 6));
            let near = wall.sample(uv);
            let far = wall.filtered(uv, PixelEllipse::aligned(widths));
            let of = |sample: &BrickSample| [sample.brick, sample.height, sample.slope.x, sample.slope.y];
            let mut outputs = words(&[of(&near), of(&far)].concat());
            let cells = [near.cell, far.cell].concat();
            outputs[8..12].copy_from_slice(&cells.iter().map(|c| c.cast_unsigned()).collect::<Vec<_>>());
            outputs[12] = wall.mean().to_bits();
            outputs
        }),
        outputs: vec![
            equal("wall", 0..2, Bound::Absolute(2e-3)),
            // For flanks of width 0.006, whose slopes are steep.
            equal("slope", 2..4, Bound::Absolute(0.5)),
            equal("filtered wall", 4..6, Bound::Absolute(2e-3)),
            equal("mean slope", 6..8, Bound::Absolute(0.5)),
            // Far from the origin a quotient off by its last bit is another cell.
            equal("cells", 8..12, Bound::Relative(1e-4)),
            equal("mean", 12..13, Bound::Relative(5e-7)),
        ],
    }
}

/// Returns the wall of the i-th input.
pub(super) fn wall(i: u32) -> Brick {
    match i % 3 {
        0 => Brick::default(),
        1 => Brick::new(number(i, 4, [0.1, 2.0]), number(i, 5, [0.1, 2.0]), 0.0).expect("positive"),
        _ => Brick::new(number(i, 4, [0.1, 2.0]), number(i, 5, [0.1, 2.0]), number(i, 6, [0.01, 0.3]))
            .expect("positive"),
    }
}

fn bevel() -> Case {
    Case {
        name: "shading/texture/bevel".into(),
        parts: vec![&BEVEL],
        body: "\
    let bevel = Bevel(a.x, a.y, a.z, a.w);
    let edge = bevel_tile_edge(b.xy);
    let facets = bevel_facets(bevel, b.z, b.w);
    outcome.a = bits(vec4<f32>(bevel_profile(bevel, b.z), select(vec2<f32>(0.0), edge.away, edge.distance > 0.01)));
    outcome.b = bits(vec4<f32>(facets.slopes * facets.flank, facets.flank, facets.flat));
    outcome.c = bits(vec4<f32>(edge.distance, 0.0, 0.0, 0.0));"
            .into(),
        resources: vec![],
        input: Box::new(|i| {
            let at = [0, 1].map(|k| if (i + k) % 16 == 5 { 0.0 } else { number(i, k, [0.0, 1.0]) });
            let low = number(i, 2, [0.0, 0.3]);
            let high = if i % 8 == 0 { low } else { low + number(i, 3, [0.0, 0.3]) };
            let mut words = inputs(i, &[0.0, 0.0, 0.0, 0.0, at[0], at[1], low, high]);
            // A position in the tile.
            words[4..6].copy_from_slice(&at.map(f32::to_bits));
            words[..4].copy_from_slice(&packed(&ridge(i).gpu()));
            words[8] = i;
            words
        }),
        reference: Box::new(|inputs| {
            let (bevel, at, [low, high]) = (ridge(inputs[8]), vec2(inputs, 4), floats(inputs, 6));
            let tile = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
            let edge = Edge::nearest(&tile, at).expect("a tile has edges");
            // Closer to the edge, the rounding of the position rotates the direction.
            let away = if edge.distance > 0.01 { edge.away } else { Vec2::ZERO };
            let [height, slope] = bevel.profile(low);
            let mut seen = vec![];
            bevel.facets(low, high, |share, slope| seen.push((share, slope)));
            let (flank, flat) = match seen[..] {
                [(_, slope)] if !(high - low > 0.0 && (high - low).is_finite()) => ([(0.5, slope); 2], 0.0),
                [a, b, (flat, _)] => ([a, b], flat),
                _ => ([(0.0, 0.0); 2], seen[0].0),
            };
            let flank_words = flank.map(|(share, slope)| share * slope);
            let mut outputs = [0; OUTPUTS];
            let floats = [height, slope, away.x, away.y, flank_words[0], flank_words[1]];
            for (word, x) in outputs.iter_mut().zip(floats.into_iter().chain([flank[0].0, flat, edge.distance])) {
                *word = x.to_bits();
            }
            outputs
        }),
        outputs: vec![
            equal("profile", 0..2, Bound::Absolute(1e-5)),
            equal("away from the edge", 2..4, Bound::Absolute(2e-5)),
            equal("facets", 4..8, Bound::Absolute(1e-4)),
            equal("distance", 8..9, Bound::Absolute(1e-6)),
        ],
    }
}

/// Returns the ridge of the i-th input.
fn ridge(i: u32) -> Bevel {
    let plateau = if i.is_multiple_of(4) { 0.0 } else { number(i, 4, [0.0, 0.1]) };
    let slopes = [6, 7].map(|k| number(i, k, [-2.0, 2.0]));
    let ridge = plateau + number(i, 5, [0.02, 0.3]);
    Bevel::new(BevelParameters { plateau, ridge, top: slopes[0], bottom: slopes[1] }).expect("a ridge")
}
