//! Options that have no effect on the image.

use asperity_render::image::Format;
use asperity_render::scenes::Set;

use crate::cli::render::{Background, Material, Render};
use crate::failure::Result;
use crate::input::images::Images;

/// Returns an error for options without effect.
///
/// Without a material, those of the mesh file are used.
pub(super) fn refuse_idle(
    wanted: &Render,
    material: Option<Material>,
    lamps: bool,
    format: Format,
) -> Result<()> {
    let bumps = material == Some(Material::Bumps);
    let file = material.is_none();
    if lamps && !matches!(wanted.scene, Set::Teapot | Set::Sphere | Set::Plane) {
        return Err(
            "`--light lamps` supports only the scenes teapot, sphere and plane; use `--light studio`".into(),
        );
    }
    if lamps && !bumps {
        return Err("`--light lamps` supports only `--material bumps`; use `--light studio`".into());
    }
    let (exr, mesh) = (format == Format::Exr, wanted.mesh.is_some());
    let image = wanted.ndf.as_ref().is_some_and(|ndf| ndf != "painted" && !ndf.contains(':'));
    let Images { measure, reconstruction, tangent_space, blue } = wanted.images;
    let given = [
        ("--ndf", wanted.ndf.is_some(), bumps, "it applies to bumps"),
        ("--normal-map", wanted.normal_map.is_some(), bumps, "it applies to bumps"),
        ("--rule", wanted.rule.is_some(), bumps, "it applies to bumps"),
        ("--octaves", wanted.octaves.is_some(), bumps, "it applies to bumps"),
        ("--frequency", wanted.frequency.is_some(), bumps, "it applies to bumps"),
        ("--gain", wanted.gain.is_some(), bumps, "it applies to bumps"),
        ("--bump-noise", wanted.bump_noise.is_some(), bumps, "it applies to bumps"),
        ("--measure", measure.is_some(), bumps && image, "it applies to an image given by --ndf"),
        (
            "--reconstruction",
            reconstruction.is_some(),
            bumps && image,
            "it applies to an image given by --ndf",
        ),
        ("--tint", wanted.tint.is_some(), !file, "the file defines its colors"),
        ("--roughness", wanted.roughness.is_some(), !file, "the file defines its roughness"),
        ("--set", !wanted.set.is_empty() && file, false, "the file defines its parameters"),
        ("--set", !wanted.set.is_empty(), !bumps, "bumps have separate options"),
        ("--scale", wanted.scale.is_some(), !file, "the file defines its textures"),
        ("--scale", wanted.scale.is_some(), material != Some(Material::Chrome), "chrome has no pattern"),
    ];
    let of_any_material = [
        (
            "--tangent-space",
            tangent_space.is_some(),
            wanted.normal_map.is_some(),
            "it applies to --normal-map",
        ),
        ("--blue", blue.is_some(), wanted.normal_map.is_some(), "it applies to --normal-map"),
        ("--tone", wanted.tone.is_some(), !exr, "OpenEXR files store linear radiance"),
        ("--exposure", wanted.exposure.is_some(), !exr || lamps, "OpenEXR files store linear radiance"),
        (
            "--background",
            wanted.background == Some(Background::Light),
            !lamps,
            "lamps are invisible; use a color, or `--light studio`",
        ),
        ("--no-ground", wanted.no_ground, !lamps, "lamps have no ground"),
        // clap ignores `requires = "mesh"` with --scene, which conflicts with --mesh.
        ("--up", wanted.up.is_some(), mesh, "it applies to --mesh"),
        ("--crease", wanted.crease.is_some(), mesh, "it applies to --mesh"),
        ("--camera", wanted.camera.is_some(), mesh, "it applies to --mesh"),
        ("--target", wanted.target.is_some(), mesh, "it applies to --mesh"),
        ("--fov", wanted.fov.is_some(), mesh, "it applies to --mesh"),
        ("--no-ground", wanted.no_ground, mesh, "it applies to --mesh"),
    ];
    let idle = |options: &[(&'static str, bool, bool, &'static str)]| {
        options.iter().find(|(_, given, used, _)| *given && !*used).map(|&(option, .., why)| (option, why))
    };
    if let Some((option, why)) = idle(&given) {
        return Err(match material {
            None => format!(
                "{option} has no effect with the materials of the mesh: {why}; choose another with --material"
            ),
            Some(material) => {
                let name = format!("{material:?}").to_lowercase();
                format!("{option} has no effect with --material {name}: {why}; see `--help-material {name}`")
            }
        }
        .into());
    }
    idle(&of_any_material)
        .map_or(Ok(()), |(option, why)| Err(format!("{option} has no effect: {why}").into()))
}

#[cfg(test)]
mod tests {

    use asperity_render::image::content::Content;
    use asperity_render::image::read::ImageFile;
    use asperity_render::integrator::pixels::Watch;
    use clap::Parser;

    use super::*;
    use crate::cli::{Cli, Command};
    use crate::render::picture::Picture;

    /// Returns the file written by a command line.
    fn bytes(line: &str) -> Result<Vec<u8>> {
        let cli = Cli::try_parse_from(["asperity", "render"].into_iter().chain(line.split_whitespace()))?;
        let Command::Render(wanted) = cli.command else { return Err("not a render command".into()) };
        let (picture, mut bytes) = (Picture::new(&wanted)?, Vec::new());
        picture.refined(Watch::unseen(), &mut |image, _, _| {
            bytes = picture.developed(image).encode(picture.format)?;
            Ok(())
        })?;
        Ok(bytes)
    }

    /// A glTF of one triangle with this base color.
    fn triangle(color: [f32; 4]) -> String {
        let json = serde_json::json!({
            "asset": { "version": "2.0" }, "scenes": [{ "nodes": [0] }], "nodes": [{ "mesh": 0 }],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }],
            "materials": [{ "pbrMetallicRoughness": { "baseColorFactor": color }, "doubleSided": true }],
            "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }],
            "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
            "buffers": [{ "byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" }],
        });
        json.to_string()
    }

    #[test]
    fn materials_of_a_mesh_are_used_unless_another_is_chosen() {
        let folder = tempfile::tempdir().unwrap();
        let [red, blue] = [[1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 1.0, 1.0]].map(|color| {
            let file = folder.path().join(format!("{}.gltf", color[0]));
            std::fs::write(&file, triangle(color)).unwrap();
            file.display().to_string()
        });
        let line = |mesh: &str, options: &str| format!("--mesh {mesh} --size 16 --spp 4 {options}");
        assert!(bytes(&line(&red, "")).unwrap() != bytes(&line(&blue, "")).unwrap());
        for options in ["--material plastic", "--material bumps --ndf ggx:0.5"] {
            assert!(
                bytes(&line(&red, options)).unwrap() == bytes(&line(&blue, options)).unwrap(),
                "{options}"
            );
        }
        for option in [
            "--tint 3060c0",
            "--roughness 0.6",
            "--scale 30",
            "--set coat=1",
            "--ndf ggx:0.5",
            "--light lamps",
        ] {
            let said = bytes(&line(&red, option)).expect_err(option).to_string();
            assert!(said.contains("--material") && said.lines().count() == 1, "{said}");
        }
    }

    #[test]
    fn options_of_no_material_do_not_suggest_another() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.gltf");
        std::fs::write(&file, triangle([1.0; 4])).unwrap();
        for (options, expected) in [
            ("--blue z", "--blue has no effect: it applies to --normal-map"),
            ("--tangent-space directx", "--tangent-space has no effect: it applies to --normal-map"),
            ("--out a.exr --tone plain", "--tone has no effect: OpenEXR files store linear radiance"),
        ] {
            let line = format!("--mesh {} --size 16 --spp 1 {options}", file.display());
            assert_eq!(bytes(&line).expect_err(options).to_string(), expected);
        }
    }

    #[test]
    fn camera_is_in_coordinates_of_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("a.gltf");
        std::fs::write(&file, triangle([1.0; 4])).unwrap();
        let line = |options: &str| {
            format!("--mesh {} --size 16 --spp 16 --no-ground --background 000000 {options}", file.display())
        };
        let lit = |options: &str| {
            let png = bytes(&line(options)).unwrap_or_else(|error| panic!("{options}: {error}"));
            let image = ImageFile::decode(&png, Content::Colors).unwrap();
            let gray = image.gray();
            let half = |right: bool| -> f32 {
                gray.iter().enumerate().filter(|(i, _)| (i % 16 >= 8) == right).map(|(_, x)| x).sum()
            };
            [half(false), half(true)]
        };
        // The triangle (0, 0, 0), (1, 0, 0), (0, 1, 0), y up, fills the lower left half of its box.
        let front = "--camera 0.5,0.5,9 --target 0.5,0.5,0 --fov 6.35";
        let [left, right] = lit(front);
        assert!(left > 2.0 * right && right > 0.0, "{left} {right}");
        // From behind it is mirrored, and a quarter of the field of view shows its inside only.
        let [left, right] = lit("--camera 0.5,0.5,-9 --target 0.5,0.5,0 --fov 6.35");
        assert!(right > 2.0 * left && left > 0.0, "{left} {right}");
        let [left, right] = lit("--camera 0.2,0.2,9 --target 0.2,0.2,0 --fov 1");
        assert!((left / right - 1.0).abs() < 0.1 && left > 10.0, "{left} {right}");
        // The default target is the center of the bounding box.
        assert!(
            bytes(&line("--camera 0.5,0.5,9")).unwrap()
                == bytes(&line("--camera 0.5,0.5,9 --target 0.5,0.5,0")).unwrap()
        );
        let ground = line("").replace("--no-ground", "");
        assert!(bytes(&ground).unwrap() != bytes(&line("")).unwrap());
        let same = bytes(&line("--camera 1,2,3 --target 1,2,3")).unwrap_err().to_string();
        assert_eq!(same, "`--camera` and `--target` must differ, got 1,2,3");
        let lamps = format!("{} --material bumps", line("").replace("--background 000000", ""));
        assert_eq!(bytes(&lamps).unwrap_err().to_string(), "--no-ground has no effect: lamps have no ground");
    }

    #[test]
    fn options_change_the_image_or_are_an_error() {
        let bumps_alone = [
            "--ndf ggx:0.5",
            "--rule fractal",
            "--octaves 2",
            "--frequency 3",
            "--gain 0.5",
            "--bump-noise simplex",
        ];
        let all = [
            "--tint 3060c0",
            "--roughness 0.6",
            "--scale 30",
            "--seed 7",
            "--zoom 2",
            "--size 20",
            "--spp 2",
            "--noise 1",
            "--exposure 3",
            "--tone plain",
            "--background 204060",
            "--background light",
            "--light day",
            "--scene teapot",
            "--out a.jpg",
        ];
        // These need an image or a normal map, which this test does not pass.
        let idle = ["--measure normals", "--reconstruction bilinear", "--tangent-space directx"];
        for (material, set) in [
            ("bumps", "gain=0.5"),
            ("carpet", "seams_pattern=grid"),
            ("paint", "coat_roughness=0.3"),
            ("flakes", "flakes.counted.bin=0.5"),
            ("glass", "index=1.2"),
            ("frosted", "index=1.2"),
            ("plastic", "dent_strength=0.9"),
            ("scratched", "specular=0.9,0.1,0.1"),
            ("chrome", "color=#204060"),
            ("brick", "mortar_color=#ffffff"),
            ("marble", "veins=9"),
            ("wallpaper", "points=3"),
        ] {
            // From a distance bumps are too fine to be visible.
            let frequency = if material == "bumps" { "--frequency 1" } else { "" };
            let own = [
                "--scene sphere",
                "--light studio",
                "--background 808080",
                "--size 16",
                "--spp 4",
                frequency,
            ];
            let line = |but: &str| {
                let kept: Vec<_> = own.iter().copied().filter(|own| !own.starts_with(but)).collect();
                format!("{} --material {material}", kept.join(" "))
            };
            let plain = bytes(&line("none")).unwrap();
            let set = format!("--set {set}");
            for option in all.iter().chain(&bumps_alone).chain(&idle).copied().chain([set.as_str()]) {
                let word = option.split(' ').next().unwrap();
                // An option must not be given twice.
                let got = bytes(&format!("{} {option}", line(word)));
                let refused = match material {
                    "bumps" => idle.contains(&option) || word == "--set",
                    "chrome" if word == "--scale" => true,
                    _ => idle.contains(&option) || bumps_alone.contains(&option),
                };
                match got {
                    Ok(got) => assert!(!refused && got != plain, "{material} {option}: the same picture"),
                    Err(error) => {
                        let said = error.to_string();
                        assert!(refused && said.lines().count() == 1, "{material} {option}: {said}");
                    }
                }
            }
        }
        for line in [
            "--out a.exr --tone plain --material paint",
            "--out a.exr --exposure 2 --material paint",
            "--background light",
            "--scene sphere --up z",
            "--scene sphere --crease 5",
            "--scene sphere --camera 0,0,3",
            "--scene sphere --target 0,0,1",
            "--scene sphere --fov 60",
            "--scene sphere --no-ground",
            "--set coat=1 --material paint",
            "--set coat_index=9 --material paint",
            "--set coat_index=1.2 --set coat_index=1.3 --material paint",
            "--set seams_pattern=dots --material carpet",
            "--mesh render/tests/data/cube.glb --crease 20",
        ] {
            assert!(bytes(line).is_err(), "{line}");
        }
        assert_eq!(
            bytes("--set coat_roughness=abc --material paint").unwrap_err().to_string(),
            "`coat_roughness` must be a number, got `abc`"
        );
    }
}
