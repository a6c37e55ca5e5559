// Steam over a cup: the transmitted background and the scattered light.

struct SteamView {
    // The center of its base, in meters; radius and height of its volume.
    center: vec3<f32>,
    radius: f32,
    height: f32,
    // Cells of the noise per meter, extinction per cell and density, scattering albedo.
    cells: f32,
    extinction: f32,
    albedo: f32,
}

@fragment
fn steam_pixel(corner: MaterialsCorner) -> @location(0) vec4<f32> {
    let hit = materials_hit(corner);
    // The environment is the distant background.
    var sum = vec3<f32>(0.0);
    let distance = hit.p - materials_view.eye;
    let far = sqrt(dot(distance, distance)) * materials_view.metres;
    if corner.uv.x > 6.5 {
        sum = materials_behind(hit.direction);
    } else {
        let seen = material_seen(hit.point, hit.frame, hit.wo);
        sum = material_ambience(seen, hit);
        for (var k = 0u; k < u32(materials_view.lamps); k++) {
            let wi = frame_to_local(hit.frame, light.lamps[k].direction);
            sum += material_lamp(seen, hit.wo, wi) * light.lamps[k].irradiance;
        }
    }
    let eye = ((materials_view.eye + materials_view.focus) * materials_view.metres - steam_view.center) * steam_view.cells;
    let steam = GasSteam(vec3<f32>(0.0), steam_view.radius * steam_view.cells, steam_view.height * steam_view.cells);
    let interval = gas_march_interval(steam, eye, hit.direction);
    let near = max(interval.x, 0.0);
    let end = min(interval.y, far * steam_view.cells);
    var march = gas_march_begin(near, end, 0.35, 0.5);
    while gas_march_goes_on(march) {
        let p = gas_march_point(march, eye, hit.direction);
        let share = gas_steam_share(steam.center, steam.radius, steam.height, p);
        var extinction = 0.0;
        if share > 0.0 {
            let width = march.next * march.step * materials_view.pixel_angle;
            // Rising steam is stretched.
            extinction = steam_view.extinction * share * gas_density(steam_gas, p * vec3<f32>(1.0, 1.0, 0.5), width);
        }
        march = gas_march_added(march, extinction, vec3<f32>(0.0));
    }
    // Droplets scatter forward: Henyey–Greenstein, g = 0.6.
    var scattered = light.harmonics[0].xyz * 0.2820948;
    for (var k = 0u; k < u32(materials_view.lamps); k++) {
        let spread = 1.36 - 1.2 * dot(light.lamps[k].direction, hit.direction);
        scattered += light.lamps[k].irradiance * (0.050929582 / (spread * sqrt(spread)));
    }
    return materials_color(sum * march.transmittance + scattered * (steam_view.albedo * (1.0 - march.transmittance)));
}
