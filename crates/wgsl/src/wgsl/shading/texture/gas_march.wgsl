// Light along a ray through gas: `asperity_shading::texture::{march, Steam}`.
//
//     var march = gas_march_begin(near, far, stride, offset);
//     while gas_march_goes_on(march) {
//         let p = gas_march_point(march, origin, direction);
//         march = gas_march_added(march, extinction_at(p), light_at(p));
//     }

// The state of a ray.
struct GasMarch {
    // The rest of the interval, in units of the direction's length; steps, and the sampling
    // position in them, in [0, 1].
    near: f32,
    far: f32,
    step: f32,
    offset: f32,
    // The number of the next step from the origin, and the number of steps done.
    next: f32,
    count: u32,
    // The light added by the gas, and the fraction of background light that is transmitted.
    transmittance: f32,
    light: vec3<f32>,
}

// The volume over a cup in which gas is steam.
struct GasSteam {
    center: vec3<f32>,
    radius: f32,
    height: f32,
}

// The interval of a ray inside the volume, near and far, in units of the direction's length. If it
// misses, the largest float and its negative: `Steam::interval`.
fn gas_march_interval(steam: GasSteam, origin: vec3<f32>, direction: vec3<f32>) -> vec2<f32> {
    let everywhere = vec2<f32>(-MATH_LARGEST, MATH_LARGEST);
    let start = origin - steam.center;
    let p = start.xy;
    let d = direction.xy;
    let square = dot(d, d);
    let half_slope = dot(p, d);
    let beside = dot(p, p) - steam.radius * steam.radius;
    var circle = everywhere;
    if square > 0.0 {
        let under = half_slope * half_slope - square * beside;
        if !(under >= 0.0) {
            return -everywhere;
        }
        let root = sqrt(under);
        circle = vec2<f32>((-half_slope - root) / square, (-half_slope + root) / square);
    } else if !(beside < 0.0) {
        return -everywhere;
    }
    var upright = everywhere;
    if direction.z != 0.0 {
        let bottom = (0.0 - start.z) / direction.z;
        let top = (steam.height - start.z) / direction.z;
        // Compares bits. A NaN height leaves the whole ray.
        let bits = bitcast<vec2<u32>>(vec2<f32>(bottom, top)) & vec2<u32>(0x7fffffffu);
        if max(bits.x, bits.y) <= 0x7f800000u {
            upright = vec2<f32>(min(bottom, top), max(bottom, top));
        }
    } else if !(start.z >= 0.0 && start.z <= steam.height) {
        return -everywhere;
    }
    let near = max(circle.x, upright.x);
    let far = min(circle.y, upright.y);
    // Also compares bits. An interval with a NaN end is empty.
    if !(near <= far && direction_is_finite(vec3<f32>(near, far, 0.0))) {
        return -everywhere;
    }
    return vec2<f32>(near, far);
}

// A ray from near to far; clear if the interval is empty. At most 65536 steps, which are longer in
// a longer interval.
fn gas_march_begin(near: f32, far: f32, stride: f32, offset: f32) -> GasMarch {
    let length = far - near;
    if !(direction_is_length(length) && math_is_finite(near)) {
        return GasMarch(0.0, 0.0, 1.0, 0.0, 0.0, 0u, 1.0, vec3<f32>(0.0));
    }
    let least = length / 65536.0;
    let taken = select(least, min(stride, 1e30), stride > least);
    return GasMarch(near, far, taken, math_clamped(offset, 1.0), floor(near / taken), 0u, 1.0, vec3<f32>(0.0));
}

// Whether there is another step that light reaches.
fn gas_march_goes_on(march: GasMarch) -> bool {
    return march.count < 65538u && max(march.next * march.step, march.near) < march.far && march.transmittance >= 1e-6;
}

// The sampling point of the next step.
fn gas_march_point(march: GasMarch, origin: vec3<f32>, direction: vec3<f32>) -> vec3<f32> {
    return origin + direction * clamp((march.next + march.offset) * march.step, march.near, march.far);
}

// The ray after a step through gas of this extinction per unit of length, at least 0, and light.
fn gas_march_added(march: GasMarch, extinction: f32, light: vec3<f32>) -> GasMarch {
    var on = march;
    let begin = max(march.next * march.step, march.near);
    let end = min((march.next + 1.0) * march.step, march.far);
    let sigma = math_clamped(extinction, MATH_LARGEST);
    if sigma > 0.0 && end > begin {
        let through = elementary_exp(-min(sigma * (end - begin), 100.0));
        on.light += march.transmittance * (1.0 - through) * light;
        on.transmittance *= through;
    }
    on.next += 1.0;
    on.count += 1u;
    return on;
}

// The transmittance along a ray through steam with this extinction per unit of length and density,
// filtered over pixels of this width. Under uniform light the steam adds the light times 1
// minus this transmittance.
fn gas_march_transmittance(
    gas: Gas,
    steam: GasSteam,
    per_density: f32,
    footprint: f32,
    origin: vec3<f32>,
    direction: vec3<f32>,
    stride: f32,
    offset: f32,
) -> f32 {
    let interval = gas_march_interval(steam, origin, direction);
    // One more step at both ends, so that no step is cut at the ground, where the fraction is
    // discontinuous.
    var march = gas_march_begin(interval.x - stride, interval.y + stride, stride, offset);
    while gas_march_goes_on(march) {
        let p = gas_march_point(march, origin, direction);
        let share = gas_steam_share(steam.center, steam.radius, steam.height, p);
        var extinction = 0.0;
        if share > 0.0 {
            extinction = per_density * share * gas_density(gas, p, footprint);
        }
        march = gas_march_added(march, extinction, vec3<f32>(0.0));
    }
    return march.transmittance;
}
