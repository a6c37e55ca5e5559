//! The order of rooms: for every crate its folders and files, earliest first; an import runs to earlier rooms only.

/// A crate's sources and the order of its rooms.
pub(super) struct House {
    pub(super) name: &'static str,
    /// The folder of its sources, from the workspace's root.
    pub(super) sources: &'static str,
    /// One room each, earliest first: the folder or the files that it is, without `.rs`. A longer name wins over a shorter.
    pub(super) rooms: &'static [&'static str],
    /// The most names that its root may export; none where it is a program.
    pub(super) face: Option<usize>,
    /// Whether what breaks the order fails the check.
    pub(super) held: bool,
}

/// Every crate whose rooms are ordered.
pub(super) const HOUSES: &[House] = &[
    House {
        name: "noise",
        sources: "crates/noise/src",
        rooms: &[
            "math",
            "point sample",
            "lanes",
            "lattice",
            "row",
            "statistics",
            "contract",
            "kinds/cell kinds/simplex",
            "kinds",
            "sums",
            "transforms",
            "printed",
        ],
        face: Some(60),
        held: true,
    },
    House {
        name: "ndf-sampling",
        sources: "crates/ndf-sampling/src",
        rooms: &[
            "math",
            "numeric",
            "range_error batch_error ndf microfacet radial frame approx",
            "simd",
            "density",
            "map",
            "map/packed",
            "noise_distribution",
            "normal_table",
            "normal_map",
            "level_of_detail",
        ],
        face: Some(65),
        held: true,
    },
    House {
        name: "fif",
        sources: "crates/fif/src",
        rooms: &[
            "math",
            "numeric",
            "system",
            "evaluate",
            "paper",
            "table",
            "calculus",
            "analysis",
            "recurrent",
            "fit",
            "surface",
            "ray",
            "approx",
        ],
        face: Some(45),
        held: true,
    },
    House {
        name: "shading",
        sources: "crates/shading/src",
        rooms: &[
            "math direction parameter",
            "pixel",
            "bump",
            "level_of_detail",
            "reflectance",
            "environment",
            "normal_map",
            "texture",
            "material",
        ],
        face: Some(60),
        held: true,
    },
    House {
        name: "render",
        sources: "xtask/render/src",
        rooms: &[
            "failure interpolation sampling",
            "image",
            "geometry",
            "light",
            "materials",
            "scene integrator",
            "scenes",
            "shaded",
        ],
        face: None,
        held: true,
    },
    House {
        name: "xtask",
        sources: "xtask/src",
        rooms: &[
            "failure cli progress output",
            "input",
            "gallery",
            "gallery/figures",
            "tables",
            "check bench",
        ],
        face: None,
        held: true,
    },
];
