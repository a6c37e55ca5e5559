// The background.

@fragment
fn behind_pixel(screen: Screen) -> @location(0) vec4<f32> {
    let ray = materials_view.forward + screen.at.x * materials_view.right + screen.at.y * materials_view.up;
    return materials_color(materials_behind(frame_direction(ray)));
}
