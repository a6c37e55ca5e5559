//! Every part of the shaders by the path of its constant in Rust, and the values that fill what parts are bound to.

use asperity_shaders::{Part, fif, ndf, noise, shading};

macro_rules! parts {
    ($($path:path,)*) => {
        /// Paths from the crate's root, and the parts.
        pub(super) static PARTS: &[(&str, &Part)] = &[$((stringify!($path), &$path),)*];
    };
}

parts![
    noise::SAMPLE,
    noise::INTEGER_HASH,
    noise::CELL,
    noise::FADE,
    noise::EDGES,
    noise::VARIATES,
    noise::GAUSSIAN_VARIATES,
    noise::COLUMNS,
    noise::CORNERS,
    noise::WHITE,
    noise::VALUE,
    noise::VALUE_CATMULL_ROM,
    noise::PERLIN_1985,
    noise::PERLIN_2002,
    noise::VALUE_GRADIENT,
    noise::GAUSSIAN,
    noise::SIMPLEX,
    noise::SPARSE,
    noise::CELLULAR,
    noise::sums::SHAPE,
    noise::sums::FREQUENCY_CLAMP,
    noise::sums::SPECTRUM,
    noise::sums::OCTAVE,
    noise::sums::UNIFORM_2D,
    noise::sums::UNIFORM_3D,
    noise::sums::UNIFORM_4D,
    noise::sums::GAUSSIAN_OCTAVES_2D,
    noise::sums::GAUSSIAN_OCTAVES_3D,
    noise::sums::MIP_MAPPED,
    noise::sums::octaves_2d::TOTAL,
    noise::sums::octaves_2d::RIDGED_MULTIFRACTAL,
    noise::sums::octaves_2d::VALUE,
    noise::sums::octaves_2d::VALUE_CATMULL_ROM,
    noise::sums::octaves_2d::PERLIN_1985,
    noise::sums::octaves_2d::PERLIN_2002,
    noise::sums::octaves_2d::VALUE_GRADIENT,
    noise::sums::octaves_2d::SIMPLEX,
    noise::sums::octaves_2d::SIMPLEX_WIDE,
    noise::sums::octaves_2d::SPARSE,
    noise::sums::octaves_2d::GAUSSIAN,
    noise::sums::octaves_3d::TOTAL,
    noise::sums::octaves_3d::RIDGED_MULTIFRACTAL,
    noise::sums::octaves_3d::VALUE,
    noise::sums::octaves_3d::VALUE_CATMULL_ROM,
    noise::sums::octaves_3d::PERLIN_1985,
    noise::sums::octaves_3d::PERLIN_2002,
    noise::sums::octaves_3d::VALUE_GRADIENT,
    noise::sums::octaves_3d::SIMPLEX,
    noise::sums::octaves_3d::SIMPLEX_WIDE,
    noise::sums::octaves_3d::SPARSE,
    noise::sums::octaves_3d::GAUSSIAN,
    noise::sums::octaves_4d::TOTAL,
    noise::sums::octaves_4d::RIDGED_MULTIFRACTAL,
    noise::sums::octaves_4d::VALUE,
    noise::sums::octaves_4d::PERLIN_2002,
    noise::sums::octaves_4d::SIMPLEX,
    noise::sums::octaves_4d::SIMPLEX_WIDE,
    noise::transforms::WARP,
    noise::transforms::CURL,
    ndf::ELEMENTARY,
    ndf::NORMAL_DISTRIBUTION,
    ndf::MICROFACET,
    ndf::FRAME,
    ndf::ROUGHNESS,
    ndf::GGX,
    ndf::BECKMANN,
    ndf::VISIBLE_SLOPES,
    ndf::STUDENT_DISTRIBUTION,
    ndf::STUDENT_T,
    ndf::BLINN_PHONG,
    ndf::WARD,
    ndf::ASHIKHMIN_SHIRLEY,
    ndf::GAUSSIAN_SPLIT,
    ndf::OFFSET_BECKMANN,
    ndf::PACKED_MAP,
    ndf::CONDITIONAL_TABLE,
    ndf::NORMAL_TABLE_LAYOUT,
    ndf::NORMAL_TABLE,
    ndf::NORMAL_TABLE_FILTERED,
    shading::MATH,
    shading::DIRECTION,
    shading::FREQUENCY_CLAMP,
    shading::pixel::FOOTPRINT,
    shading::pixel::PIXEL_ELLIPSE,
    shading::LEVEL_OF_DETAIL,
    shading::bump::SURFACE_GRADIENT,
    shading::bump::SLOPE_FACETS,
    shading::normal_map::SLOPE_MOMENTS,
    shading::normal_map::SLOPE_PYRAMID,
    shading::reflectance::BRDF,
    shading::reflectance::SCHLICK,
    shading::reflectance::DIELECTRIC,
    shading::reflectance::CONDUCTOR,
    shading::reflectance::LAMBERT,
    shading::reflectance::ROUGH,
    shading::reflectance::OREN_NAYAR,
    shading::reflectance::ENERGY_PRESERVING,
    shading::reflectance::COOK_TORRANCE_BECKMANN,
    shading::reflectance::COOK_TORRANCE_GGX,
    shading::reflectance::TORRANCE_SPARROW,
    shading::reflectance::PHONG,
    shading::reflectance::WARD,
    shading::reflectance::FACET,
    shading::reflectance::COAT,
    shading::reflectance::ROUGH_DIELECTRIC,
    shading::texture::BRICK,
    shading::texture::BRICK_FACETS,
    shading::texture::BEVEL,
    shading::texture::STAR_WALLPAPER,
    shading::texture::MARBLE,
    shading::texture::GAS,
    shading::texture::GAS_MARCH,
    shading::texture::PERTURBED,
    shading::material::SURFACE_POINT,
    shading::material::SEGMENTS,
    shading::material::LATTICE_KEY,
    shading::material::FBM,
    shading::material::GLOSSY,
    shading::material::TEXTURED_SLOPES,
    shading::material::PERTURBED_POINT,
    shading::material::BRICK_WALL,
    shading::material::BEVELLED_TILES,
    shading::material::WALLPAPER,
    shading::material::POLISHED_MARBLE,
    shading::material::SEAMS,
    shading::material::FIBRES,
    shading::material::CARPET,
    shading::material::BUMP_MAPPED,
    shading::material::NORMAL_MAPPED,
    shading::material::COATED_FLAKES,
    shading::material::FLAKE_PATCH,
    shading::material::METALLIC_PAINT,
    shading::material::GLINT_FIELD,
    shading::material::COUNTED_FLAKES,
    shading::material::SCRATCHES,
    shading::material::BLEMISHES,
    shading::material::DENTS,
    shading::material::VARIATIONS,
    shading::material::TEMPERED_GLASS,
    fif::TABLE,
    fif::JET,
    fif::NORMAL,
    fif::NUMBER,
    fif::HEIGHT_FIELD,
    fif::FOLDED,
    fif::FIRST_HIT,
];

macro_rules! fills {
    ($($binding:literal: $path:path => $text:literal,)*) => {
        /// All that fills a binding, by its name, in Rust; every item is there.
        pub(super) fn fill(binding: &str) -> Option<&'static str> {
            match binding {
                $($binding => {
                    let _ = $path;
                    Some($text)
                })*
                _ => None,
            }
        }
    };
}

fills! {
    "gaussian_level": noise::gaussian_levels => "noise::gaussian_levels()",
    "octaves_uniform_2d": noise::sums::OctavesUniform::<2>::uniform => "OctavesUniform::<2>::uniform(&[OctavesUniform::new(&sum)])",
    "octaves_uniform_3d": noise::sums::OctavesUniform::<3>::uniform => "OctavesUniform::<3>::uniform(&[OctavesUniform::new(&sum)])",
    "octaves_uniform_4d": noise::sums::OctavesUniform::<4>::uniform => "OctavesUniform::<4>::uniform(&[OctavesUniform::new(&sum)])",
    "mip_mapped_noise": noise::sums::MipMapped::texel => "MipMapped::texel of every level, rg16float",
    "mip_mapped_sampler": noise::sums::MIP_MAPPED => "linear between texels and levels, repeating",
    "packed_map_grid": ndf::PackedMapUniform::words => "PackedMapUniform::new(&map).words()",
    "packed_map_word": ndf::PackedMapUniform::WIDTH => "bits of NdfMap::array()",
    "conditional_table_grid": ndf::ConditionalTableUniform::words => "ConditionalTableUniform::new(&table).words()",
    "conditional_table_number": ndf::ConditionalTableUniform::WIDTH => "numbers of ConditionalTableRef, as its part says",
    "normal_table_grid": ndf::NormalTableUniform::words => "NormalTableUniform::new(&table).words()",
    "normal_table_number": ndf::NormalTableUniform::WIDTH => "table.entries().as_flattened()",
    "normal_table_texture": ndf::NormalTableUniform::words => "entries of NormalTableRef, two channels a texel, rg16float",
    "normal_table_sampler": ndf::NORMAL_TABLE_FILTERED => "linear between texels, not repeating",
    "tempered_glass_uniform": shading::material::TemperedGlassUniform::words => "TemperedGlassUniform::new(&glass, 0).words()",
    "counted_flakes_uniform": shading::material::CountedFlakesUniform::words => "CountedFlakesUniform::new(&paint, 0)?.words()",
    "brick_wall_uniform": shading::material::BrickWallUniform::words => "BrickWallUniform::new(&wall).words()",
    "bevelled_tiles_uniform": shading::material::BevelledTilesUniform::words => "BevelledTilesUniform::new(&tiles).words()",
    "starry_wallpaper_uniform": shading::material::WallpaperUniform::words => "WallpaperUniform::new(&wallpaper).words()",
    "polished_marble_uniform": shading::material::PolishedMarbleUniform::words => "PolishedMarbleUniform::new(&stone).words()",
    "carpet_uniform": shading::material::CarpetUniform::words => "CarpetUniform::new(&carpet, 0).words()",
    "metallic_paint_uniform": shading::material::MetallicPaintUniform::words => "MetallicPaintUniform::new(&paint, 0).words()",
    "scratches_uniform": shading::material::ScratchesUniform::words => "ScratchesUniform::new(&scratches).words()",
    "variations_uniform": shading::material::VariationsUniform::words => "VariationsUniform::new(&variations, 0).words()",
    "bump_mapped_uniform": shading::material::BumpMappedUniform::words => "BumpMappedUniform::ggx(&material, 0).words()",
    "normal_mapped_uniform": shading::material::NormalMappedUniform::words => "NormalMappedUniform::new(&material).words()",
    "slope_pyramid_number": shading::normal_map::slope_pyramid_numbers::<2> => "slope_pyramid_numbers(&map)",
    "fif_rows": fif::table_rows::<2> => "fif::table_rows(&table)",
    "fif_ranges": fif::RangesUniform::words => "fif::ranges(surface.x()), then those of y",
    "fif_nodes": fif::folded_nodes => "fif::folded_nodes(&surface)",
    "fif_surfaces": fif::FoldedUniform::words => "FoldedUniform::new(&surface, first).words() of each surface",
    "fif_functions": fif::TableUniform::words => "TableUniform::new(&table, first)?.words() of each function",
    "field": fif::TableUniform::words => "TableUniform::new(&table, first)?.words() of x, then of y",
    "field_ranges": fif::RangesUniform::words => "RangesUniform::new(surface.x(), &table, first)?.words() of x, then of y",
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use asperity_shader_tests::cases;
    use asperity_shaders::ordered;

    use super::*;

    #[test]
    fn every_part_is_listed_once_and_what_fills_its_bindings_is_said() {
        let listed: BTreeSet<&str> = PARTS.iter().map(|(_, part)| part.name()).collect();
        assert_eq!(listed.len(), PARTS.len());
        let cases = cases::all();
        for case in &cases {
            for part in ordered(&case.parts) {
                // Cases have parts of their own.
                let own = part.source().is_empty() || part.name().starts_with("case/");
                assert!(own || listed.contains(part.name()), "`{}` is not listed", part.name());
            }
        }
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../crates/shaders/src/wgsl");
        let files = walk(folder.as_ref());
        // Octaves are filled into templates.
        let from_files = listed.iter().filter(|name| !name.starts_with("noise/sums/octaves_")).count();
        assert_eq!(files, from_files, "files of WGSL and parts that are listed");
        for binding in PARTS.iter().flat_map(|(_, part)| part.bindings()) {
            assert!(fill(binding.name()).is_some(), "nothing fills `{}`", binding.name());
        }
    }

    fn walk(folder: &std::path::Path) -> usize {
        let entries =
            std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
        let count = |path: std::path::PathBuf| match path.extension() {
            None => walk(&path),
            Some(extension) => usize::from(extension == "wgsl"),
        };
        entries.map(count).sum()
    }
}
