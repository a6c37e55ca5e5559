//! The examples of the README, the guide and the crate pages, as documentation tests.

macro_rules! pages {
    ($($name:ident $page:literal)+) => {
        $(#[doc = include_str!(concat!("../../", $page))] pub mod $name {})+
    };
}

pages! {
    readme "README.md"
    guide "docs/guide/README.md"
    command_line "docs/guide/command-line.md"
    determinism "docs/guide/determinism.md"
    embedded "docs/guide/embedded.md"
    engine_textures "docs/guide/engine-textures.md"
    exact_zoom "docs/guide/exact-zoom.md"
    fractal_functions "docs/guide/fractal-functions.md"
    microfacets "docs/guide/microfacets.md"
    noise "docs/guide/noise.md"
    painted_density "docs/guide/painted-density.md"
    renderer "docs/guide/renderer.md"
    shaders "docs/guide/shaders.md"
    core_crate "crates/core/README.md"
    fif_crate "crates/fif/README.md"
    ndf_crate "crates/ndf-sampling/README.md"
    noise_crate "crates/noise/README.md"
    shading_crate "crates/shading/README.md"
    wgsl_crate "crates/wgsl/README.md"
}
