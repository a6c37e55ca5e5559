//! The layers of every crate: folders and files in order. A file imports only from its own and
//! earlier layers.

/// A crate's sources and the order of its layers.
pub(super) struct Crate {
    pub(super) name: &'static str,
    /// The folder of its sources, from the workspace's root.
    pub(super) sources: &'static str,
    /// Folders and files without `.rs`, earliest layer first. The longest matching name decides.
    pub(super) layers: &'static str,
    /// The maximum number of names that its root exports, `None` for programs.
    pub(super) max_exports: Option<usize>,
}

/// Every crate whose layers are ordered.
pub(super) const CRATES: &[Crate] = &[
    Crate {
        name: "core",
        sources: "crates/core/src",
        layers: "math macros → batch_error gpu interval short split_mix → lanes → check",
        max_exports: Some(5),
    },
    Crate {
        name: "noise",
        sources: "crates/noise/src",
        layers: "error point sample → lanes → lattice → row → statistics → contract → kinds/cell kinds/simplex → \
                kinds/cellular → kinds → sums → transforms → ebert_1994 gpu → check",
        max_exports: Some(60),
    },
    Crate {
        name: "ndf-sampling",
        sources: "crates/ndf-sampling/src",
        layers: "numeric → error storage coordinates ndf microfacet radial frame serde → closed_form → density → \
                map → map/packed → masked → noise_distribution → normal_table → normal_map → level_of_detail → \
                gpu → check → rand",
        max_exports: Some(65),
    },
    Crate {
        name: "fif",
        sources: "crates/fif/src",
        layers: "numeric → system → evaluate → cochran_2000 → table → calculus → analysis → recurrent → fit → surface → \
                ray → gpu → approx",
        max_exports: Some(45),
    },
    Crate {
        name: "shading",
        sources: "crates/shading/src",
        layers: "math direction error low_discrepancy → image parameter → pixel → bump → level_of_detail → reflectance → \
                environment → normal_map → texture → material → gpu → approx → check",
        max_exports: Some(60),
    },
    Crate {
        name: "wgsl",
        sources: "crates/wgsl/src",
        layers: "part → compose → imports → noise → ndf → shading → fif → parts",
        max_exports: Some(60),
    },
    Crate {
        name: "render",
        sources: "tools/render/src",
        layers: "failure input_file interpolation sampling → image → geometry → light → materials → scene integrator → \
                scenes → shaded",
        max_exports: None,
    },
    Crate {
        name: "interpreter",
        sources: "tests/interpreter/src",
        layers: "value arithmetic layout → operators binding → shader → machine → expression",
        max_exports: None,
    },
    Crate {
        name: "asperity",
        sources: "tools/asperity/src",
        layers: "failure invocation ktx2_layout output progress html quality → input → cli → fields tables job → render → bake check filter fractal manual noise shader → program",
        max_exports: None,
    },
    Crate {
        name: "gallery",
        sources: "tools/gallery/src",
        layers: "cli captions power_spectrum → figure page → panels plot → figures → draw",
        max_exports: None,
    },
    Crate {
        name: "tables",
        sources: "tools/tables/src",
        layers: "spline visible_normals → albedos glass_albedos noise_means → noise_cdf → noise_cellular noise_levels noise_pictures → shipped documented",
        max_exports: None,
    },
    Crate {
        name: "platforms",
        sources: "tools/platforms/src",
        layers: "failure report cli → toolchain → bits firmware no_std web",
        max_exports: None,
    },
    Crate {
        name: "xtask",
        sources: "xtask/src",
        layers: "failure report cli → cargo metadata drivers → shaders → check",
        max_exports: None,
    },
];

impl Crate {
    /// The layers, each the names of its folders and files.
    pub(super) fn layers(&self) -> impl Iterator<Item = &'static str> {
        self.layers.split(" → ")
    }

    /// The layer of a file, by the longest name that is the file or a folder that contains it.
    pub(super) fn layer(&self, file: &str) -> Option<usize> {
        let around = |name: &&str| file == *name || file.starts_with(&format!("{name}/"));
        let named =
            self.layers().enumerate().flat_map(|(at, layer)| layer.split(' ').map(move |name| (at, name)));
        named.filter(|(_, name)| around(name)).max_by_key(|(_, name)| name.len()).map(|(at, _)| at)
    }
}
