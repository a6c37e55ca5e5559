//! Bumps from two channels of noise and from the height of one, with the same distribution.

use asperity_ndf_sampling::Ggx;
use asperity_render::materials::field::NoiseKind;
use asperity_render::scenes::{RenderRequest, Set};

use crate::figure::{Context, Drawn};
use crate::figures::kautz::objects::{ggx, object};
use asperity::failure::Result;

/// Subjects, with magnification and cells of the first octave per unit of length.
const SUBJECTS: [(Set, &str, [f32; 2]); 3] = [
    (Set::Teapot, "teapot", [2.5, 27.0]),
    (Set::Sphere, "sphere", [4.0, 55.0]),
    (Set::Plane, "plane", [1.0, 8.0]),
];

const KINDS: [(&str, &str, NoiseKind); 2] =
    [("channels", "two channels", NoiseKind::Channels), ("height", "one height", NoiseKind::Gaussian)];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    const ALPHA: [f32; 2] = [0.16, 0.4];
    let ndf = Ggx::new(ALPHA[0], ALPHA[1])?;
    let mut panels = Vec::new();
    for (set, name, [zoom, frequency]) in SUBJECTS {
        let shape = RenderRequest::shape(set);
        let mut request = RenderRequest::new(set, &ndf, context.sampling([16, 12], 2));
        (request.zoom, request.bumps.frequency) = (zoom, frequency);
        for (stem, bumps, kind) in KINDS {
            request.bumps.kind = kind;
            let (stem, label) = (format!("{name}-{stem}"), format!("{name}, {bumps}"));
            let alt = format!("The {name} with bumps from {bumps}.");
            panels.push(object(context, &request, &shape, [&stem, &label, &alt])?);
        }
    }
    let frequencies = SUBJECTS.map(|(_, name, [_, frequency])| format!("{name} {frequency}")).join(", ");
    Ok(Drawn::new(2, panels)
        .fact("density", ggx(ALPHA))
        .fact("rule", "Exact")
        .fact("cells of the first octave per unit", frequencies))
}
