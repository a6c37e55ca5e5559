//! The order of rooms: for every crate its folders and files, earliest first; an import runs to earlier rooms only.

/// A crate's sources and the order of its rooms.
pub(super) struct House {
    pub(super) name: &'static str,
    /// The folder of its sources, from the workspace's root.
    pub(super) sources: &'static str,
    /// Rooms, earliest first: each the folders or the files that it is, without `.rs`. A longer name wins over a shorter.
    pub(super) rooms: &'static str,
    /// The most names that its root may export; none where it is a program.
    pub(super) face: Option<usize>,
}

/// Every crate whose rooms are ordered.
pub(super) const HOUSES: &[House] = &[
    House {
        name: "core",
        sources: "crates/core/src",
        rooms: "math macros → batch_error interval split_mix → lanes → check",
        face: Some(5),
    },
    House {
        name: "noise",
        sources: "crates/noise/src",
        rooms: "error point sample → lanes → lattice → row → statistics → contract → kinds/cell kinds/simplex → \
                kinds/cellular → kinds → sums → transforms → ebert_1994 → check",
        face: Some(60),
    },
    House {
        name: "ndf-sampling",
        sources: "crates/ndf-sampling/src",
        rooms: "numeric → error storage coordinates ndf microfacet radial frame serde → closed_form → density → \
                map → map/packed → masked → noise_distribution → normal_table → normal_map → level_of_detail → \
                check → rand",
        face: Some(65),
    },
    House {
        name: "fif",
        sources: "crates/fif/src",
        rooms: "numeric → system → evaluate → cochran_2000 → table → calculus → analysis → recurrent → fit → surface → \
                ray → approx",
        face: Some(45),
    },
    House {
        name: "shading",
        sources: "crates/shading/src",
        rooms: "math direction image parameter → pixel → bump → level_of_detail → reflectance → environment → \
                normal_map → texture → material → approx → check",
        face: Some(60),
    },
    House {
        name: "shaders",
        sources: "crates/wgsl/src",
        rooms: "part → compose → imports → noise → ndf → shading → fif",
        face: Some(60),
    },
    House {
        name: "render",
        sources: "tools/render/src",
        rooms: "failure input_file interpolation sampling → image → geometry → light → materials → scene integrator → \
                scenes → shaded",
        face: None,
    },
    House {
        name: "wgsl",
        sources: "tests/interpreter/src",
        rooms: "value arithmetic layout → operators binding → shader → machine → expression",
        face: None,
    },
    House {
        name: "asperity",
        sources: "tools/asperity/src",
        rooms: "failure output progress html quality → input → cli → tables job → render → bake check",
        face: None,
    },
    House {
        name: "gallery",
        sources: "tools/gallery/src",
        rooms: "cli captions power_spectrum → figure page → panels plot → figures → draw",
        face: None,
    },
    House {
        name: "tables",
        sources: "tools/tables/src",
        rooms: "noise_means → noise_cdf → noise_cellular noise_levels noise_pictures → shipped documented",
        face: None,
    },
    House {
        name: "platforms",
        sources: "tools/platforms/src",
        rooms: "failure report cli → toolchain → bits firmware no_std web",
        face: None,
    },
    House {
        name: "xtask",
        sources: "xtask/src",
        rooms: "failure report cli → cargo metadata drivers → shaders → check",
        face: None,
    },
];

impl House {
    /// The rooms, each the names of its folders and files.
    pub(super) fn rooms(&self) -> impl Iterator<Item = &'static str> {
        self.rooms.split(" → ")
    }

    /// The room of a file: the one with the longest name that is the file or a folder around it.
    pub(super) fn room(&self, file: &str) -> Option<usize> {
        let around = |name: &&str| file == *name || file.starts_with(&format!("{name}/"));
        let named =
            self.rooms().enumerate().flat_map(|(at, room)| room.split(' ').map(move |name| (at, name)));
        named.filter(|(_, name)| around(name)).max_by_key(|(_, name)| name.len()).map(|(at, _)| at)
    }
}
