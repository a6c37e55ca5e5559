//! The teapot with an anisotropic density at three distances, and with normals that do not follow it.

use asperity_ndf_sampling::{BlinnPhong, Ggx, NormalTable};
use asperity_render::materials::Facets;
use asperity_render::scenes::{RenderRequest, Set};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn};
use crate::gallery::panels::{common_parameters, density_panel, object_panel};

const ALPHA: [f32; 2] = [0.14, 0.56];
const ZOOMS: [(f32, &str); 3] = [(1.0, "far"), (3.0, "three times closer"), (9.0, "nine times closer")];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let ndf = Ggx::new(ALPHA[0], ALPHA[1])?;
    let shape = RenderRequest::shape(Set::Teapot);
    let mut request = RenderRequest::new(Set::Teapot, &ndf, context.sampling([12, 12], 2));
    // So fine that the view of the whole pot resolves next to nothing.
    request.bumps.frequency = 27.0;
    let mut panels = vec![density_panel(context, &ndf, "GGX 0.14, 0.56")?];
    for (zoom, label) in ZOOMS {
        request.zoom = zoom;
        let alt = format!("The teapot, {label}: a highlight along its profile that breaks up into bumps.");
        panels.push(object_panel(context, &request, &shape, [&format!("zoom-{zoom}"), label, &alt])?);
    }
    let mut parameters = common_parameters(&request);
    parameters.insert(0, ("density".into(), format!("GGX, α = {}, {}", ALPHA[0], ALPHA[1])));
    let uniform = NormalTable::standard(&BlinnPhong::new(0.0)?);
    request.facets = Facets::Table(&uniform);
    request.zoom = ZOOMS[1].0;
    let alt = "The same view with bumps from uniform normals: a grainy surface without a highlight.";
    let words = ["uniform", "three times closer, normals spread evenly", alt];
    panels.push(object_panel(context, &request, &shape, words)?);
    Ok(Drawn::new(5, panels).facts(parameters))
}
