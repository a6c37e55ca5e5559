//! The bidirectional scattering distribution function of a point of a surface.

use asperity_ndf_sampling::Frame;
use glam::{Vec2, Vec3};

use crate::bump::{Facet, flip_to_visible};
use crate::math::clamp_to;
use crate::reflectance::brdf::{Brdf, are_above, finite, have_sides};
use crate::reflectance::coat::{Coat, Delta};
use crate::reflectance::lobe::{Lobe, LobePart};

/// The maximum number of facets; further ones are merged with the nearest.
const FACETS: usize = 32;
/// The maximum number of lobes; further ones are ignored.
const LOBES: usize = 16;
/// The maximum number of layers.
const LAYERS: usize = 4;

/// The BSDF at a surface point, with the light that it scatters and emits towards the eye.
///
/// Layers are added up. Each has a few [`Lobe`]s around the normals of a few [`Facet`]s, which
/// represent bumps that the pixel does not resolve. A smooth [`Coat`] may cover them.
///
/// ```text
/// f(ωi, ωo) cos θ_i = T(ωi) T(ωo) Σ_layers Σ_facets share Σ_lobes f_r(ωi′, ωo′) max(0, ωi·m)
/// ```
///
/// Lobes that transmit, such as rough glass, use |ωi·m| in place of the cosine, for directions on
/// the same side of facet and surface.
///
/// Here ω′ is in the frame of the facet m, and T = 1 − F of the coat. Directions are unit vectors
/// in the frame of the surface without bumps,
/// [`SurfacePoint::frame`](crate::material::SurfacePoint::frame), and point away from it. As a
/// [`Brdf`] it has the value, samples and density of the layers. Reflection and transmission by a
/// smooth coat are in [`deltas`](Self::deltas), and emission is in [`emitted`](Self::emitted).
///
/// - **Energy:** at most 1 if the lobes of every layer have a total albedo of at most 1 (materials
///   add layers only in place of one another).
/// - **Reciprocal** if every lobe is and no facet is tilted; bump mapping is not reciprocal in
///   general (Veach 1997, §5.3).
/// - **For one view:** facets that are not visible from `wo` of [`new`](Self::new) are rotated by
///   [`flip_to_visible`].
/// - **Storage:** inline, without allocation; 32 facets, 16 lobes, 4 layers.
///
/// ```
/// use asperity_shading::bump::slope_facets;
/// use asperity_shading::reflectance::{Bsdf, Lobe};
/// use asperity_shading::{Brdf, Lambert, glam::Vec3};
///
/// // Chalk with fine bumps is darker under a lamp straight above, and brighter under one at the side.
/// let chalk = Lambert::new(Vec3::splat(0.8))?;
/// let lobe = Lobe::from(&chalk as &dyn Brdf);
/// let bumpy = Bsdf::new(Vec3::Z).with(slope_facets(Vec3::Z, Vec3::Z, 0.1), [lobe]);
/// let low = Vec3::new(0.96, 0.0, 0.28);
/// assert!(bumpy.value(Vec3::Z, Vec3::Z).x < chalk.value(Vec3::Z, Vec3::Z).x);
/// assert!(bumpy.value(low, Vec3::Z).x > chalk.value(low, Vec3::Z).x);
/// # Ok::<(), asperity_shading::ParameterError>(())
/// ```
#[doc(alias = "bsdf")]
#[doc(alias = "bidirectional scattering")]
#[doc(alias = "btdf")]
#[derive(Clone, Copy)]
pub struct Bsdf<'a> {
    wo: Vec3,
    facets: [(f32, Frame); FACETS],
    lobes: [Option<Lobe<'a>>; LOBES],
    layers: [Layer; LAYERS],
    layer_count: usize,
    coat: Option<Coat>,
    emitted: Vec3,
    /// Whether any lobe transmits.
    transmits: bool,
}

/// All bits are 0.
const NO_FRAME: Frame = Frame { tangent: Vec3::ZERO, bitangent: Vec3::ZERO, normal: Vec3::ZERO };

/// Lobes around facets, by their indices.
#[derive(Clone, Copy, Default)]
struct Layer {
    facets: [usize; 2],
    lobes: [usize; 2],
    /// Whether it is the layer of the coat itself, which is not covered.
    in_coat: bool,
}

impl<'a> Bsdf<'a> {
    /// Creates an empty BSDF seen from the unit direction `wo`.
    #[must_use]
    pub fn new(wo: Vec3) -> Self {
        Self {
            wo,
            // Values that are cheap to write, because most entries stay empty.
            facets: [(0.0, NO_FRAME); FACETS],
            lobes: [const { None }; LOBES],
            layers: [Layer::default(); LAYERS],
            layer_count: 0,
            coat: None,
            emitted: Vec3::ZERO,
            transmits: false,
        }
    }

    /// Adds a layer: each lobe is evaluated in each facet's frame.
    #[inline]
    #[must_use]
    pub fn with(
        mut self,
        facets: impl IntoIterator<Item = Facet>,
        lobes: impl IntoIterator<Item = Lobe<'a>>,
    ) -> Self {
        self.add_layer(facets, lobes);
        self
    }

    /// Adds a coat over all layers; a rough coat uses a layer itself.
    #[inline]
    #[must_use]
    pub fn with_coat(mut self, coat: Coat) -> Self {
        self.add_coat(coat);
        self
    }

    /// Adds emission. Non-positive and non-finite components are ignored.
    #[inline]
    #[must_use]
    pub fn with_emitted(mut self, radiance: Vec3) -> Self {
        self.add_emitted(radiance);
        self
    }

    /// [`with_emitted`](Self::with_emitted) in place.
    pub(crate) fn add_emitted(&mut self, radiance: Vec3) {
        self.emitted += radiance.map(finite);
    }

    /// [`with`](Self::with) in place, because the value is too large to be moved between calls.
    #[inline]
    pub(crate) fn add_layer(
        &mut self,
        facets: impl IntoIterator<Item = Facet>,
        lobes: impl IntoIterator<Item = Lobe<'a>>,
    ) {
        self.add_visited(lobes, false, |add| facets.into_iter().for_each(add));
    }

    /// Adds a layer of facets that are visited one by one.
    #[inline]
    pub(crate) fn with_visited(
        mut self,
        lobes: impl IntoIterator<Item = Lobe<'a>>,
        facets: impl FnOnce(&mut dyn FnMut(Facet)),
    ) -> Self {
        self.add_visited(lobes, false, facets);
        self
    }

    /// [`with_coat`](Self::with_coat) in place.
    pub(crate) fn add_coat(&mut self, coat: Coat) {
        self.coat = Some(coat);
        if let Some(lobe) = coat.lobe() {
            self.add_visited([lobe], true, |add| coat.facets().for_each(add));
        }
    }

    fn add_visited(
        &mut self,
        lobes: impl IntoIterator<Item = Lobe<'a>>,
        in_coat: bool,
        facets: impl FnOnce(&mut dyn FnMut(Facet)),
    ) {
        let last = self.layers().last().copied().unwrap_or_default();
        let ([_, first], [_, first_lobe]) = (last.facets, last.lobes);
        let (mut end, mut end_lobe) = (first, first_lobe);
        facets(&mut |facet: Facet| {
            if facet.share > 0.0 && facet.share.is_finite() {
                let normal = flip_to_visible(Vec3::Z, facet.normal, self.wo);
                end += add(&mut self.facets[first..], end - first, facet.share, normal);
            }
        });
        for lobe in lobes {
            if let Some(place) = self.lobes.get_mut(end_lobe) {
                *place = Some(lobe);
                end_lobe += 1;
                self.transmits |= lobe.transmits();
            }
        }
        if let Some(layer) = self.layers.get_mut(self.layer_count) {
            *layer = Layer { facets: [first, end], lobes: [first_lobe, end_lobe], in_coat };
            self.layer_count += 1;
        }
    }

    /// Delta lobes of a smooth coat, of reflection and transmission into `wo`; weights are 0
    /// without a coat.
    ///
    /// `u` is a uniform point of the unit square that selects one of the facets of the coat. The
    /// mean over it is the contribution of the coat. A path tracer follows both directions, or one
    /// of them by its weight.
    ///
    /// `wo` may have any length. If it is along the surface, zero, infinite or NaN, both weights
    /// are 0.
    ///
    /// ```
    /// use asperity_shading::reflectance::{Bsdf, Coat};
    /// use asperity_shading::{Dielectric, glam::{Vec2, Vec3}};
    ///
    /// let wo = Vec3::new(0.6, 0.0, 0.8);
    /// let pane = Bsdf::new(wo).with_coat(Coat::pane(Dielectric::new(1.5)?, Vec3::ONE));
    /// let [mirrored, transmitted] = pane.deltas(wo, Vec2::splat(0.5));
    /// assert_eq!((mirrored.wi, transmitted.wi), (Vec3::new(-0.6, 0.0, 0.8), -wo));
    /// assert!((mirrored.weight + transmitted.weight - Vec3::ONE).length() < 1e-6);
    /// # Ok::<(), asperity_shading::ParameterError>(())
    /// ```
    #[must_use]
    pub fn deltas(&self, wo: Vec3, u: Vec2) -> [Delta; 2] {
        self.coat.map_or([Delta::default(); 2], |coat| coat.deltas(wo, u))
    }

    /// The radiance emitted into `wo` of [`new`](Self::new) regardless of the light, e.g. rim
    /// light.
    #[must_use]
    pub const fn emitted(&self) -> Vec3 {
        self.emitted
    }

    /// `f cos θ_i`: the radiance into `wo` per unit of irradiance from `wi`.
    ///
    /// The irradiance is on a surface that faces the light.
    #[must_use]
    pub fn scattered(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        if !(are_above(wi, wo) || self.transmits && have_sides(wi, wo)) {
            return Vec3::ZERO;
        }
        let through = self.coat.map_or(1.0, |coat| coat.through(wi) * coat.through(wo));
        let mut sum = Vec3::ZERO;
        for layer in self.layers() {
            let mut light = Vec3::ZERO;
            for (share, frame) in self.facets_of(layer) {
                let (i, o) = (frame.to_local(wi), frame.to_local(wo));
                if on_the_sides_of([i, o], [wi, wo]) {
                    let lobes = self.lobes_of(layer);
                    light += lobes.map(|lobe| lobe.value(i, o)).sum::<Vec3>() * (share * i.z.abs());
                }
            }
            sum += if layer.in_coat { light } else { light * through };
        }
        sum.map(finite)
    }

    /// The facets of each layer with their fractions and each of their lobes.
    ///
    /// The lobe is `None` if it has no colors. A smooth coat is one of them.
    pub(crate) fn parts(&self) -> impl Iterator<Item = (f32, Vec3, Option<LobePart>)> {
        let layers = self.layers().iter().flat_map(move |layer| {
            self.lobes_of(layer).flat_map(move |lobe| {
                self.facets_of(layer).iter().map(move |(share, frame)| (*share, frame.normal, lobe.part()))
            })
        });
        let smooth = self.coat.filter(|coat| !coat.is_rough());
        layers.chain(
            smooth.into_iter().flat_map(|coat| {
                coat.facets().map(move |facet| (facet.share, facet.normal, coat.smooth_part()))
            }),
        )
    }

    fn layers(&self) -> &[Layer] {
        &self.layers[..self.layer_count]
    }

    fn facets_of(&self, layer: &Layer) -> &[(f32, Frame)] {
        &self.facets[layer.facets[0]..layer.facets[1]]
    }

    fn lobes_of(&self, layer: &Layer) -> impl Iterator<Item = &Lobe<'a>> {
        self.lobes[layer.lobes[0]..layer.lobes[1]].iter().flatten()
    }

    /// The relative probability of each lobe around each facet.
    fn chances(&self, wo: Vec3) -> impl Iterator<Item = (f32, &Frame, &Lobe<'a>)> {
        self.layers().iter().flat_map(move |layer| {
            self.lobes_of(layer).flat_map(move |lobe| {
                let strength = lobe.strength(wo);
                self.facets_of(layer).iter().map(move |(share, frame)| (strength * share, frame, lobe))
            })
        })
    }
}

/// Whether a facet sees both directions from the same side as the surface.
fn on_the_sides_of(local: [Vec3; 2], [wi, wo]: [Vec3; 2]) -> bool {
    local[0].z * wi.z > 0.0 && local[1].z * wo.z > 0.0
}

impl Lobe<'_> {
    /// Whether the lobe around a facet is defined for these directions.
    ///
    /// They are in the frames of the facet and of the surface.
    fn counts(&self, local: [Vec3; 2], [wi, wo]: [Vec3; 2]) -> bool {
        if self.transmits() { on_the_sides_of(local, [wi, wo]) } else { are_above(wi, wo) }
    }
}

/// Adds a facet after the first `count`, or merges it with the nearest if full; returns the number
/// added.
fn add(facets: &mut [(f32, Frame)], count: usize, share: f32, normal: Vec3) -> usize {
    if let Some(place) = facets.get_mut(count) {
        let flat = normal == Vec3::Z;
        let frame = if flat { Frame::IDENTITY } else { Frame::from_normal_tangent(normal, Vec3::X) };
        *place = (share, frame);
        return 1;
    }
    let nearness = |facet: &(f32, Frame)| facet.1.normal.dot(normal);
    if let Some(nearest) = facets.iter_mut().max_by(|a, b| nearness(a).total_cmp(&nearness(b))) {
        let both = (nearest.1.normal * nearest.0 + normal * share).normalize_or(normal);
        *nearest = (nearest.0 + share, Frame::from_normal_tangent(both, Vec3::X));
    }
    0
}

impl Brdf for Bsdf<'_> {
    fn value(&self, wi: Vec3, wo: Vec3) -> Vec3 {
        let cosine = wi.z.abs().max(f32::MIN_POSITIVE);
        self.scattered(wi, wo).map(|f| finite(f / cosine))
    }

    /// Samples one of the lobes, selected by its approximate contribution.
    fn sample(&self, wo: Vec3, u: Vec2) -> Vec3 {
        let total: f32 = self.chances(wo).map(|(chance, ..)| chance).sum();
        let mut place = clamp_to(u.x, 1.0) * total;
        let mut last = None;
        for (chance, frame, lobe) in self.chances(wo).filter(|(chance, ..)| *chance > 0.0) {
            last = Some((frame, lobe, (place / chance).min(0.999_999_94)));
            if place < chance {
                break;
            }
            place -= chance;
        }
        match last {
            Some((frame, lobe, x)) => {
                let o = frame.to_local(wo);
                let i = lobe.sample(o, Vec2::new(x, u.y));
                let wi = frame.to_world(i);
                // Directions behind the facet contribute nothing. They must not become directions
                // above the surface, or below it where another lobe transmits.
                match self.transmits {
                    false if i.z > 0.0 && o.z > 0.0 => wi,
                    false => Vec3::new(wi.x, wi.y, -wi.z.abs()),
                    true if lobe.counts([i, o], [wi, wo]) => wi,
                    true => Vec3::ZERO,
                }
            }
            None => Vec3::ZERO,
        }
    }

    fn density(&self, wi: Vec3, wo: Vec3) -> f32 {
        if !(are_above(wi, wo) || self.transmits && have_sides(wi, wo)) {
            return 0.0;
        }
        let (mut sum, mut total) = (0.0, 0.0);
        for (chance, frame, lobe) in self.chances(wo) {
            total += chance;
            let local = [frame.to_local(wi), frame.to_local(wo)];
            if lobe.counts(local, [wi, wo]) {
                sum += chance * lobe.density(local[0], local[1]);
            }
        }
        if total > 0.0 { finite(sum / total) } else { 0.0 }
    }

    fn transmits(&self) -> bool {
        self.transmits
    }
}
