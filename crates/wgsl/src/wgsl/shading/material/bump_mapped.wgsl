// A bump map of a normal distribution: `asperity_shading::BumpMapped` of GGX or Beckmann, and
// building blocks for other distributions.

// Gaussian coordinates of the bump map as resolved by a pixel of this width, their variance
// fraction and the first octave's weight: `BumpField::coordinates`.
fn bump_mapped_coordinates(bumps: BumpMapped, p: vec3<f32>, frame: Frame, width: f32) -> vec4<f32> {
    let octaves = bump_mapped_octaves(bumps, width);
    let seen = gaussian_slopes_3d(p * bumps.frequency, frame.tangent, frame.bitangent, octaves, bumps.sum);
    return vec4<f32>(-seen.z, seen.resolved_variance, seen.fade);
}

fn bump_mapped_octaves(bumps: BumpMapped, width: f32) -> f32 {
    return frequency_clamp_octaves(width, FrequencyClamp(bumps.frequency, bumps.log_lacunarity, bumps.max_octaves));
}

// The height of the bumps as resolved by a pixel of this width, per unit of slope, with its gradient:
// `BumpField::height`.
fn bump_mapped_height(bumps: BumpMapped, p: vec3<f32>, width: f32) -> Sample3d {
    let octaves = bump_mapped_octaves(bumps, width);
    let spectrum = fbm_spectrum_3d(bumps.sum);
    let share = sqrt(fbm_resolved_variance(octaves, fbm_divisor(octaves, 0.0, spectrum).squares, spectrum));
    let height = gaussian_height_3d(p * bumps.frequency, octaves, bumps.sum);
    return Sample3d(share * height.value / bumps.frequency, share * height.gradient);
}

// The reflected distribution under the rule, in 1/sr, for h.z > 0.
fn bump_mapped_radiance(bumps: BumpMapped, h: vec3<f32>, seen: vec4<f32>) -> f32 {
    if bumps.rule == 0u {
        if bumps.ndf == 0u {
            return level_of_detail_exact_ggx(bumps.alpha, h, seen.xy, seen.z);
        }
        return level_of_detail_exact_beckmann(bumps.alpha, h, seen.xy, seen.z);
    }
    if bumps.ndf == 0u {
        return level_of_detail_fractal_ggx(bumps.alpha, h, seen.xy, seen.w);
    }
    return level_of_detail_fractal_beckmann(bumps.alpha, h, seen.xy, seen.w);
}

// Reflectance times cosine, `Bsdf::eval_cos` of a point; wo and wi are in its frame,
// `surface_point_frame`. For another distribution it is
// `color * facet_shown(radiance, h, wi, wo) * wi.z`, with the radiance of its rule.
fn bump_mapped_eval_cos(bumps: BumpMapped, point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    if !direction_are_above(wi, wo) {
        return vec3<f32>(0.0);
    }
    let h = direction_half(wi, wo);
    if !(h.z > 0.0) {
        return vec3<f32>(0.0);
    }
    let seen = bump_mapped_coordinates(bumps, point.position, surface_point_frame(point), point.pixel.widths.x);
    let shown = facet_shown(bump_mapped_radiance(bumps, h, seen), h, wi, wo);
    return brdf_finite_channels(bumps.color * shown * wi.z);
}

// The material in the uniform.
fn bump_mapped(point: SurfacePoint, wo: vec3<f32>, wi: vec3<f32>) -> vec3<f32> {
    return bump_mapped_eval_cos(bump_mapped_uniform, point, wo, wi);
}
