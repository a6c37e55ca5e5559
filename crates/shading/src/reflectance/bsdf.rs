//! The bidirectional scattering distribution function of a point of a surface.

use asperity_ndf_sampling::Frame;
use glam::{Vec2, Vec3};

use crate::bump::{Facet, flip_to_visible};
use crate::level_of_detail::ResolvedBumps;
use crate::math::clamp_to;
use crate::reflectance::brdf::{Brdf, BsdfSample, are_above, finite, have_sides};
use crate::reflectance::coat::Coat;
use crate::reflectance::facet_brdf::FacetBrdf;
use crate::reflectance::lobe::{Lobe, LobePart};
use crate::reflectance::standard::layers::Layers;

/// The maximum number of facets; further ones are merged with the nearest.
const FACETS: usize = 32;
/// The maximum number of lobes; further ones are ignored.
const LOBES: usize = 16;
/// The maximum number of layers.
const LAYERS: usize = 4;

/// The BSDF at a surface point, with the light that it scatters and emits towards the eye.
///
/// **Directions are unit vectors in world space that point away from the surface**, the space of
/// [`SurfacePoint`](crate::SurfacePoint) and its normal. `wo` points to the eye, `wi` to the light.
/// Facets and coats that build a BSDF have normals in its frame, [`SurfacePoint::frame`].
///
/// Layers are added up. Each has a few [`Lobe`]s around the normals of a few [`Facet`]s, which
/// represent bumps that the pixel does not resolve. A smooth or rough [`Coat`] may cover them.
///
/// ```text
/// f(ωo, ωi) cos θ_i = T(ωi) T(ωo) Σ_layers Σ_facets weight Σ_lobes f(ωo′, ωi′) max(0, ωi·m)
/// ```
///
/// Here ω′ is in the frame of the facet m, and T = 1 − F of the coat. Lobes that transmit, such as
/// rough glass, use |ωi·m| in place of the cosine, for directions on the same side of facet and
/// surface.
///
/// - **Methods:** [`eval`](Self::eval) and [`pdf`](Self::pdf) are those of the layers.
///   [`sample`](Self::sample) also returns reflection and transmission by a smooth coat, as
///   specular samples. [`emitted`](Self::emitted) is added regardless of the light.
/// - **Any input:** directions that are not finite or along the surface scatter nothing.
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
/// use asperity_shading::{Brdf, Frame, Lambert, glam::Vec3};
///
/// // Chalk with fine bumps is darker under a lamp straight above, and brighter under one at the side.
/// let chalk = Lambert::new(Vec3::splat(0.8))?;
/// let lobe = Lobe::from(&chalk as &dyn Brdf);
/// let bumpy = Bsdf::new(Frame::IDENTITY, Vec3::Z).with(slope_facets(Vec3::Z, Vec3::Z, 0.1), [lobe]);
/// let low = Vec3::new(0.96, 0.0, 0.28);
/// assert!(bumpy.eval(Vec3::Z, Vec3::Z).x < chalk.eval(Vec3::Z, Vec3::Z).x);
/// assert!(bumpy.eval(Vec3::Z, low).x > chalk.eval(Vec3::Z, low).x);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
///
/// [`SurfacePoint::frame`]: crate::SurfacePoint::frame
#[doc(alias = "bsdf")]
#[doc(alias = "bidirectional scattering")]
#[doc(alias = "btdf")]
#[derive(Clone, Copy)]
pub struct Bsdf<'a> {
    frame: Frame,
    /// In the frame.
    wo: Vec3,
    facets: [(f32, Frame); FACETS],
    lobes: [Option<Lobe<'a>>; LOBES],
    layers: [Layer; LAYERS],
    layer_count: usize,
    /// A standard material in place of layers, stored once because it is large.
    standard: Option<(Layers, ResolvedBumps)>,
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
    /// Creates an empty BSDF of a surface with this frame, seen from `wo` in world space.
    #[must_use]
    pub fn new(frame: Frame, wo: Vec3) -> Self {
        Self {
            frame,
            wo: frame.to_local(wo),
            // Values that are cheap to write, because most entries stay empty.
            facets: [(0.0, NO_FRAME); FACETS],
            lobes: [const { None }; LOBES],
            layers: [Layer::default(); LAYERS],
            layer_count: 0,
            standard: None,
            coat: None,
            emitted: Vec3::ZERO,
            transmits: false,
        }
    }

    /// The BSDF of a standard material.
    pub(super) fn of_layers(frame: Frame, wo: Vec3, layers: Layers, bumps: ResolvedBumps) -> Self {
        let bsdf = Self::new(frame, wo);
        let (emitted, transmits) = (layers.emitted(bsdf.wo), layers.transmits());
        Self { standard: Some((layers, bumps)), transmits, ..bsdf }.with_emitted(emitted)
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

    /// Sets the frame, and with it the space of directions.
    ///
    /// [`Frame::IDENTITY`] is the frame of the surface itself, where z is its normal, as for a
    /// [`Brdf`].
    #[must_use]
    pub fn with_frame(self, frame: Frame) -> Self {
        Self { frame, ..self }
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
            if facet.weight > 0.0 && facet.weight.is_finite() {
                let normal = flip_to_visible(Vec3::Z, facet.normal, self.wo);
                end += add(&mut self.facets[first..], end - first, facet.weight, normal);
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

    /// The radiance emitted into `wo` of [`new`](Self::new) regardless of the light, e.g. rim
    /// light.
    #[must_use]
    pub const fn emitted(&self) -> Vec3 {
        self.emitted
    }

    /// `f(ωo, ωi)` of the layers in sr⁻¹, linear RGB; without the cosine.
    #[must_use]
    pub fn eval(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        let cosine = wi.dot(self.frame.normal).abs().max(f32::MIN_POSITIVE);
        self.eval_cos(wo, wi).map(|f| finite(f / cosine))
    }

    /// `f(ωo, ωi) |cos θ_i|`: the radiance into `wo` per unit of irradiance from `wi`.
    ///
    /// The irradiance is on a surface that faces the light.
    #[must_use]
    pub fn eval_cos(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        self.local_eval_cos(self.frame.to_local(wo), self.frame.to_local(wi))
    }

    /// The density over solid angle of samples that are not specular, in sr⁻¹.
    #[must_use]
    pub fn pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.local_pdf(self.frame.to_local(wo), self.frame.to_local(wi))
    }

    /// Samples a direction of the light that leaves along `wo`.
    ///
    /// `uc` selects specular reflection, specular transmission or a lobe, in this order. `u`
    /// selects the direction. All are uniform in `[0, 1)`; others are clamped, and NaN counts
    /// as 0. Returns `None` if these numbers have no sample.
    ///
    /// ```
    /// use asperity_shading::reflectance::{Bsdf, Coat};
    /// use asperity_shading::{Dielectric, Frame, glam::{Vec2, Vec3}};
    ///
    /// let wo = Vec3::new(0.6, 0.0, 0.8);
    /// let pane = Coat::thin_dielectric(Dielectric::new(1.5)?, Vec3::ONE);
    /// let pane = Bsdf::new(Frame::IDENTITY, wo).with_coat(pane);
    /// let [first, last] = [0.0, 0.999].map(|uc| pane.sample(wo, uc, Vec2::splat(0.5)).unwrap());
    /// assert_eq!((first.wi, last.wi), (Vec3::new(-0.6, 0.0, 0.8), -wo));
    /// assert!(first.is_specular() && last.is_transmission());
    /// assert!((first.weight() - Vec3::ONE).length() < 1e-6);
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let sample = self.local_sample(self.frame.to_local(wo), uc, u)?;
        Some(BsdfSample { wi: self.frame.to_world(sample.wi), ..sample })
    }

    /// The specular samples for `u`, for a renderer that follows all of them.
    ///
    /// They are those of [`sample`](Self::sample) for `uc` below the sum of their `pdf`s. With the
    /// sum S, the mean of `(1 − S) weight` over `uc` in `[S, 1)` is the remaining light.
    ///
    /// ```
    /// use asperity_shading::reflectance::{Bsdf, Coat};
    /// use asperity_shading::{Dielectric, Frame, glam::{Vec2, Vec3}};
    ///
    /// let glass = Bsdf::new(Frame::IDENTITY, Vec3::Z).with_coat(Coat::dielectric(Dielectric::new(1.5)?));
    /// let [mirrored, refracted] = glass.specular_samples(Vec3::Z, Vec2::ZERO).map(Option::unwrap);
    /// assert!((mirrored.pdf + refracted.pdf - 1.0).abs() < 1e-6);
    /// assert!((mirrored.eval_cos.x - 0.04).abs() < 1e-6 && refracted.wi == Vec3::NEG_Z);
    /// # Ok::<(), asperity_shading::ShadingError>(())
    /// ```
    #[must_use]
    pub fn specular_samples(&self, wo: Vec3, u: Vec2) -> [Option<BsdfSample>; 2] {
        let wo = self.frame.to_local(wo);
        self.local_specular_samples(wo, u, self.total_chance(wo))
            .map(|sample| sample.map(|sample| BsdfSample { wi: self.frame.to_world(sample.wi), ..sample }))
    }

    fn local_specular_samples(&self, wo: Vec3, u: Vec2, total: f32) -> [Option<BsdfSample>; 2] {
        let Some(coat) = self.coat else { return [None; 2] };
        let chance = coat.strength(wo) / total;
        coat.samples(wo, u)
            .map(|sample| sample.map(|sample| BsdfSample { pdf: sample.pdf * chance, ..sample }))
    }

    fn local_eval_cos(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        if !(are_above(wi, wo) || self.transmits && have_sides(wi, wo)) {
            return Vec3::ZERO;
        }
        let through = self.through_coat(wo, wi);
        let mut sum = Vec3::ZERO;
        for layer in self.layers() {
            let mut light = Vec3::ZERO;
            for (weight, frame) in self.facets_of(layer) {
                let (i, o) = (frame.to_local(wi), frame.to_local(wo));
                if on_the_sides_of([i, o], [wi, wo]) {
                    let lobes = self.lobes_of(layer);
                    light += lobes.map(|lobe| lobe.eval(o, i)).sum::<Vec3>() * (weight * i.z.abs());
                }
            }
            sum += if layer.in_coat { light } else { light * through };
        }
        if let Some((layers, bumps)) = &self.standard {
            sum += layers.eval_resolved(wo, wi, *bumps) * (wi.z.abs() * through);
        }
        sum.map(finite)
    }

    /// Whether any lobe transmits, so that directions below the surface are valid.
    #[must_use]
    pub const fn transmits(&self) -> bool {
        self.transmits
    }

    /// The facets of each layer with their fractions and each of their lobes.
    ///
    /// The lobe is `None` if it has no colors. A smooth coat is one of them.
    pub(crate) fn parts(&self) -> impl Iterator<Item = (f32, Vec3, Option<LobePart>)> {
        let layers = self.layers().iter().flat_map(move |layer| {
            self.lobes_of(layer).flat_map(move |lobe| {
                self.facets_of(layer).iter().map(move |(weight, frame)| (*weight, frame.normal, lobe.part()))
            })
        });
        let smooth = self.coat.filter(|coat| !coat.is_rough());
        // A standard material has more parameters than a part.
        let standard = self.standard.map(|_| (1.0, Vec3::Z, None));
        layers.chain(standard).chain(smooth.into_iter().flat_map(|coat| {
            coat.facets().map(move |facet| (facet.weight, facet.normal, coat.smooth_part()))
        }))
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
                self.facets_of(layer).iter().map(move |(weight, frame)| (strength * weight, frame, lobe))
            })
        })
    }

    /// The relative probability of specular samples of the coat.
    fn specular_chance(&self, wo: Vec3) -> f32 {
        self.coat.map_or(0.0, |coat| coat.strength(wo))
    }

    /// The fraction of the light that passes the coat on both ways.
    fn through_coat(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.coat.map_or(1.0, |coat| coat.through(wi) * coat.through(wo))
    }

    /// The sum of the relative probabilities of specular samples and of lobes.
    fn total_chance(&self, wo: Vec3) -> f32 {
        let lobes = self.chances(wo).map(|(chance, ..)| chance).sum::<f32>();
        self.specular_chance(wo) + self.standard_chance() + lobes
    }

    /// The relative probability of the standard material.
    fn standard_chance(&self) -> f32 {
        if self.standard.is_some() { 1.0 } else { 0.0 }
    }

    fn local_sample(&self, wo: Vec3, uc: f32, u: Vec2) -> Option<BsdfSample> {
        let (total, specular) = (self.total_chance(wo), self.specular_chance(wo));
        let mut place = clamp_to(uc, 1.0) * total;
        if place < specular {
            let [mirrored, transmitted] = self.local_specular_samples(wo, u, total);
            return mirrored.filter(|sample| place < sample.pdf * total).or(transmitted).or(mirrored);
        }
        place -= specular;
        if let Some((layers, bumps)) = self.standard.as_ref().filter(|_| place < 1.0) {
            let sample = layers.sample_resolved(wo, place, u, *bumps)?;
            // Alone, with its own value and pdf.
            let alone = self.layer_count == 0 && self.coat.is_none();
            return if alone {
                Some(sample)
            } else {
                let wi = sample.wi;
                BsdfSample::with_pdf(wo, wi, self.local_pdf(wo, wi), || self.local_eval_cos(wo, wi))
            };
        }
        place -= self.standard_chance();
        let mut last = None;
        for (chance, frame, lobe) in self.chances(wo).filter(|(chance, ..)| *chance > 0.0) {
            last = Some((chance / total, frame, lobe, (place / chance).min(0.999_999_94)));
            if place < chance {
                break;
            }
            place -= chance;
        }
        let (chance, frame, lobe, uc) = last?;
        let o = frame.to_local(wo);
        let (i, specular) = lobe.draw(o, uc, u)?;
        let wi = frame.to_world(i);
        // Directions behind the facet contribute nothing. They must not become directions above the
        // surface, or below it where another lobe transmits.
        let counts =
            if lobe.transmits() { on_the_sides_of([i, o], [wi, wo]) } else { i.z > 0.0 && o.z > 0.0 };
        if !counts {
            return None;
        }
        if let Some(sample) = specular {
            let through = self.through_coat(wo, wi);
            return Some(BsdfSample {
                wi,
                eval_cos: sample.eval_cos * through,
                pdf: sample.pdf * chance,
                ..sample
            });
        }
        BsdfSample::with_pdf(wo, wi, self.local_pdf(wo, wi), || self.local_eval_cos(wo, wi))
    }

    fn local_pdf(&self, wo: Vec3, wi: Vec3) -> f32 {
        if !(are_above(wi, wo) || self.transmits && have_sides(wi, wo)) {
            return 0.0;
        }
        let (mut sum, mut total) = (0.0, self.specular_chance(wo) + self.standard_chance());
        if let Some((layers, bumps)) = &self.standard {
            sum += layers.pdf_resolved(wo, wi, *bumps);
        }
        for (chance, frame, lobe) in self.chances(wo) {
            total += chance;
            let local = [frame.to_local(wi), frame.to_local(wo)];
            if lobe.counts(local, [wi, wo]) {
                sum += chance * lobe.pdf(local[1], local[0]);
            }
        }
        if total > 0.0 { finite(sum / total) } else { 0.0 }
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
fn add(facets: &mut [(f32, Frame)], count: usize, weight: f32, normal: Vec3) -> usize {
    if let Some(place) = facets.get_mut(count) {
        let flat = normal == Vec3::Z;
        let frame = if flat { Frame::IDENTITY } else { Frame::from_normal_tangent(normal, Vec3::X) };
        *place = (weight, frame);
        return 1;
    }
    let nearness = |facet: &(f32, Frame)| facet.1.normal.dot(normal);
    if let Some(nearest) = facets.iter_mut().max_by(|a, b| nearness(a).total_cmp(&nearness(b))) {
        let both = (nearest.1.normal * nearest.0 + normal * weight).normalize_or(normal);
        *nearest = (nearest.0 + weight, Frame::from_normal_tangent(both, Vec3::X));
    }
    0
}
