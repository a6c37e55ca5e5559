//! A list of all parts.

use crate::{fif, ndf, noise, part::Part, shading};

/// Returns all public parts, module by module.
///
/// ```
/// let names: Vec<&str> = asperity_wgsl::parts().map(|part| part.name()).collect();
/// assert!(names.contains(&"noise/kinds/perlin") && names.contains(&"shading/material/carpet/carpet"));
/// ```
pub fn parts() -> impl Iterator<Item = &'static Part> {
    PARTS.iter().copied()
}

static PARTS: &[&Part] = &[
    &noise::CELLULAR,
    &noise::CURL,
    &noise::FBM_2D.value,
    &noise::FBM_2D.value_catmull_rom,
    &noise::FBM_2D.perlin_classic,
    &noise::FBM_2D.perlin,
    &noise::FBM_2D.value_gradient,
    &noise::FBM_2D.simplex,
    &noise::FBM_2D.simplex_classic,
    &noise::FBM_2D.gaussian,
    &noise::FBM_2D.sparse_convolution,
    &noise::FBM_2D.custom,
    &noise::FBM_3D.value,
    &noise::FBM_3D.value_catmull_rom,
    &noise::FBM_3D.perlin_classic,
    &noise::FBM_3D.perlin,
    &noise::FBM_3D.value_gradient,
    &noise::FBM_3D.simplex,
    &noise::FBM_3D.simplex_classic,
    &noise::FBM_3D.gaussian,
    &noise::FBM_3D.sparse_convolution,
    &noise::FBM_3D.custom,
    &noise::FBM_4D.value,
    &noise::FBM_4D.perlin,
    &noise::FBM_4D.simplex,
    &noise::FBM_4D.simplex_classic,
    &noise::FBM_4D.custom,
    &noise::GAUSSIAN,
    &noise::GAUSSIAN_SLOPES_3D,
    &noise::MIP_MAPPED,
    &noise::PERLIN,
    &noise::PERLIN_CLASSIC,
    &noise::SIMPLEX,
    &noise::SPARSE_CONVOLUTION,
    &noise::VALUE,
    &noise::VALUE_CATMULL_ROM,
    &noise::VALUE_GRADIENT,
    &noise::WARP,
    &noise::WHITE,
    &ndf::ASHIKHMIN_SHIRLEY,
    &ndf::BECKMANN,
    &ndf::BLINN_PHONG,
    &ndf::CONDITIONAL_TABLE,
    &ndf::GGX,
    &ndf::NORMAL_TABLE,
    &ndf::NORMAL_TABLE_FILTERED,
    &ndf::PACKED_MAP,
    &ndf::STUDENT_T,
    &ndf::WARD,
    &shading::LEVEL_OF_DETAIL,
    &shading::SPECULAR_ANTIALIASING,
    &shading::reflectance::CHARLIE_SHEEN,
    &shading::reflectance::COAT,
    &shading::reflectance::CONDUCTOR,
    &shading::reflectance::COOK_TORRANCE_BECKMANN,
    &shading::reflectance::COOK_TORRANCE_GGX,
    &shading::reflectance::DIELECTRIC,
    &shading::reflectance::ENERGY,
    &shading::reflectance::ENERGY_PRESERVING,
    &shading::reflectance::GGX_ALBEDO,
    &shading::reflectance::GLASS_ALBEDO,
    &shading::reflectance::LAMBERT,
    &shading::reflectance::OPEN_PBR,
    &shading::reflectance::OREN_NAYAR,
    &shading::reflectance::PHONG,
    &shading::reflectance::ROUGH_DIELECTRIC,
    &shading::reflectance::SCHLICK,
    &shading::reflectance::STANDARD_MATERIAL,
    &shading::reflectance::TORRANCE_SPARROW,
    &shading::reflectance::WARD,
    &shading::reflectance::ZELTNER_FUZZ,
    &shading::normal_map::SLOPE_PYRAMID,
    &shading::texture::BEVEL,
    &shading::texture::BRICK,
    &shading::texture::GAS,
    &shading::texture::MARBLE,
    &shading::texture::STAR_WALLPAPER,
    &shading::material::BEVELED_TILES,
    &shading::material::BRICK_WALL,
    &shading::material::BUMP_MAPPED,
    &shading::material::CARPET,
    &shading::material::COUNTED_FLAKES,
    &shading::material::GLINT_FIELD,
    &shading::material::METALLIC_PAINT,
    &shading::material::NORMAL_MAPPED,
    &shading::material::PERTURBED_POINT,
    &shading::material::POLISHED_MARBLE,
    &shading::material::SCRATCHES,
    &shading::material::SURFACE_POINT,
    &shading::material::TEMPERED_GLASS,
    &shading::material::VARIATIONS,
    &shading::material::WALLPAPER,
    &fif::FOLDED_SURFACE,
    &fif::HEIGHT_FIELD,
    &fif::INTERSECT,
    &fif::TABLE,
];

#[cfg(test)]
mod tests {
    extern crate std;

    use std::{fs, path::Path, vec::Vec};

    use super::*;

    /// The files below a folder.
    fn files(folder: &Path) -> Vec<std::path::PathBuf> {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        entries.flat_map(|path| if path.is_dir() { files(&path) } else { [path].into() }).collect()
    }

    #[test]
    fn every_file_is_in_a_part_of_the_list() {
        let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src/wgsl"));
        let listed: Vec<&Part> = parts().collect();
        let sources: Vec<&str> = crate::ordered(&listed).iter().map(|part| part.source()).collect();
        let templates =
            |file: &std::path::PathBuf| file.extension().is_some_and(|extension| extension == "template");
        for file in files(folder).into_iter().filter(|file| !templates(file)) {
            let text = fs::read_to_string(&file).unwrap();
            let listed = sources.iter().any(|source| source.contains(&*text));
            assert!(listed, "{} is in no part of the list", file.display());
        }
    }
}
