//! Two isotropic densities on the teapot.

use std::sync::Arc;

use asperity_ndf_sampling::{Beckmann, Ggx};
use asperity_render::geometry::shape::Shape;
use asperity_render::image::tone::hex;
use asperity_render::materials::SharedNdf;
use asperity_render::scenes::{RenderRequest, Set};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};
use crate::gallery::panels::{common_parameters, density_panel, object_panel};

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let shape = RenderRequest::shape(Set::Teapot);
    let (narrow, wide) = (Beckmann::isotropic(0.22)?, Ggx::isotropic(0.36)?);
    let silver = Look { ndf: &narrow, name: "Beckmann 0.22", stem: "beckmann", tint: 0xe6_e8ec };
    let bronze = Look { ndf: &wide, name: "GGX 0.36", stem: "ggx", tint: 0xe0_a36a };
    let mut panels = Vec::new();
    for look in [&silver, &bronze] {
        panels.push(look.density(context)?);
        panels.push(look.teapot(context, &shape)?);
    }
    let mut parameters = common_parameters(&silver.request(context));
    parameters.insert(0, ("densities".into(), format!("{}; {}", silver.name, bronze.name)));
    Ok(Drawn::new(6, panels).facts(parameters))
}

struct Look<'a> {
    ndf: &'a SharedNdf,
    name: &'static str,
    stem: &'static str,
    tint: u32,
}

impl Look<'_> {
    fn density(&self, context: &Context<'_>) -> Result<Panel, Failure> {
        let mut panel = density_panel(context, self.ndf, self.name)?;
        panel.stem = format!("density-{}", self.stem);
        Ok(panel)
    }

    /// Twice as large as a square panel.
    fn request(&self, context: &Context<'_>) -> RenderRequest<'_> {
        let mut request = RenderRequest::new(Set::Teapot, self.ndf, context.sampling([24, 18], 2));
        request.zoom = 1.2;
        request.bumps.frequency = 9.0;
        request.tint = hex(self.tint);
        request
    }

    fn teapot(&self, context: &Context<'_>, shape: &Arc<Shape>) -> Result<Panel, Failure> {
        let alt = format!("The teapot with bumps and highlights of the density {}.", self.name);
        let words = [&format!("teapot-{}", self.stem) as &str, self.name, &alt];
        let mut panel = object_panel(context, &self.request(context), shape, words)?;
        panel.span = 2;
        Ok(panel)
    }
}
