//! The table of code size, constants and stack of the firmware's functions, and its image as PNG.

use std::fmt::Write;

use super::program::{Cost, Drawn};
use crate::failure::Result;

/// A function measured separately.
pub(super) struct Function {
    /// The feature of the probe, which is also its name.
    pub(super) feature: &'static str,
    crate_name: &'static str,
    what: &'static str,
}

/// The measured functions, in crate order.
pub(super) const FUNCTIONS: [Function; 13] = [
    Function { feature: "perlin", crate_name: "noise", what: "`Perlin2002`, 3-D, value and gradient" },
    Function { feature: "simplex", crate_name: "noise", what: "`Simplex`, 3-D, value and gradient" },
    Function { feature: "cellular", crate_name: "noise", what: "`Cellular`, F₁, 3-D, value and gradient" },
    Function { feature: "gaussian", crate_name: "noise", what: "`Gaussian`, 3-D, value and gradient" },
    Function {
        feature: "gaussian-octaves",
        crate_name: "noise",
        what: "`GaussianOctaves`, 4.5 octaves, 3-D",
    },
    Function { feature: "ggx-normal", crate_name: "ndf-sampling", what: "`Ggx::from_gaussian`" },
    Function { feature: "ggx-density", crate_name: "ndf-sampling", what: "`Ggx::density`" },
    Function {
        feature: "packed-normal",
        crate_name: "ndf-sampling",
        what: "`PackedMapRef::from_gaussian`, table of 16 × 12 in flash",
    },
    Function {
        feature: "exact-radiance",
        crate_name: "shading",
        what: "`BumpField` and `LevelOfDetail::Exact`, GGX",
    },
    Function { feature: "oren-nayar", crate_name: "shading", what: "`OrenNayar`, full form" },
    Function {
        feature: "fif-value",
        crate_name: "fif",
        what: "`FixedFif::<5, 2>`, made and evaluated within 1e-6",
    },
    Function {
        feature: "height-field-normal",
        crate_name: "fif",
        what: "`HeightField` of two integrals, made, its normal",
    },
    Function {
        feature: "height-field-hit",
        crate_name: "fif",
        what: "`HeightField` of two, made, a ray's first hit",
    },
];

/// Returns the table. `floor` is the cost of the program without any function; `costs` are in the
/// order of [`FUNCTIONS`].
pub(super) fn markdown(drawn: &Drawn, floor: &Cost, costs: &[Cost]) -> String {
    let Drawn { hash, stack, program, .. } = drawn;
    let mut text = format!(
        "picture {hash}; .text {}, .rodata {}, .data and .bss {}, stack {stack} bytes\n\n\
         | crate | function | code | constants | stack |\n|---|---|--:|--:|--:|\n",
        program.code, program.constants, program.statics
    );
    for (Function { crate_name, what, .. }, cost) in FUNCTIONS.iter().zip(costs) {
        let less = |of: fn(&Cost) -> u64| of(cost).saturating_sub(of(floor));
        let _ = writeln!(
            text,
            "| {crate_name} | {what} | {} | {} | {} |",
            less(|c| c.program.code),
            less(|c| c.program.constants),
            less(|c| c.stack),
        );
    }
    text
}

/// Converts a portable gray map to PNG.
pub(super) fn png(map: &[u8]) -> Result<Vec<u8>> {
    let header = map.iter().position(|&byte| byte == b'\n').ok_or("the image has no header")?;
    let words = std::str::from_utf8(&map[..header])?.split(' ').collect::<Vec<_>>();
    let ["P5", width, height, "255"] = words[..] else {
        return Err("the image is not a portable gray map".into());
    };
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width.parse()?, height.parse()?);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header()?.write_image_data(&map[header + 1..])?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gray_map_becomes_png() {
        let bytes = png(b"P5 2 1 255\n\x00\xff").unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut pixels = [7; 2];
        reader.next_frame(&mut pixels).unwrap();
        assert_eq!((reader.info().size(), pixels), ((2, 1), [0, 255]));
        assert!(png(b"P6 2 1 255\n\x00\xff").is_err() && png(b"P5 2 2 255\n\x00\xff").is_err());
    }
}
