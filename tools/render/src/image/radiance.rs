//! Radiance HDR files, in every orientation, with both run-length encodings.
//!
//! Ward 1991, "Real Pixels", Graphics Gems II.

/// Scanline widths of the newer run-length encoding, whose first bytes are 2 and 2.
const RUNS: std::ops::Range<usize> = 8..1 << 15;

/// Returns width, height and linear RGB from the top left, or an error message.
pub(super) fn decode(
    bytes: &[u8],
    check: impl FnOnce(usize, usize) -> bool,
) -> Result<([usize; 2], Vec<[f32; 3]>), &'static str> {
    let mut rest = bytes;
    let mut scale = [1.0; 3];
    loop {
        let line = line(&mut rest).ok_or("header is not terminated")?;
        // Headers of the files from which an image was made are indented.
        match line.split_once('=').map(|(name, value)| (name.trim_end(), value.trim())) {
            None if line.trim().is_empty() => break,
            Some(("FORMAT", format)) if !format.eq_ignore_ascii_case("32-bit_rle_rgbe") => {
                return Err("unsupported color format: only 32-bit_rle_rgbe is supported");
            }
            // Every program in the chain multiplied the image by its exposure. FreeImage writes 0
            // for an unknown exposure.
            Some(("EXPOSURE", value)) => multiply(&mut scale, [first_number(value); 3]),
            Some(("COLORCORR", value)) => {
                let mut words = value.split_whitespace().map(first_number);
                multiply(&mut scale, [(); 3].map(|()| words.next().flatten()));
            }
            _ => {}
        }
    }
    let line = line(&mut rest).ok_or("image size is missing")?;
    let words: Vec<&str> = line.split_whitespace().collect();
    let &[slow, rows, fast, columns] = &words[..] else { return Err("image size is not four words") };
    let (rows, columns) = rows.parse().ok().zip(columns.parse().ok()).ok_or("image size is not a number")?;
    let turned = match (slow.trim_start_matches(['+', '-']), fast.trim_start_matches(['+', '-'])) {
        ("Y", "X") => false,
        ("X", "Y") => true,
        _ => return Err("image size has axes other than X and Y"),
    };
    let [width, height] = if turned { [rows, columns] } else { [columns, rows] };
    if !check(width, height) {
        return Ok(([width, height], Vec::new()));
    }
    // The check precedes allocation: the bytes must be able to hold the pixels.
    let mut scanlines = Vec::new();
    for _ in 0..rows {
        scanlines.push(scanline(&mut rest, columns)?);
    }
    let mut pixels = vec![[0.0; 3]; width * height];
    for (row, texels) in scanlines.into_iter().enumerate() {
        for (column, texel) in texels.into_iter().enumerate() {
            let [mut x, mut y] = if turned { [row, column] } else { [column, row] };
            // X points right and Y up. The first row of an image is its top.
            if slow == "-X" || fast == "-X" {
                x = width - 1 - x;
            }
            if slow == "+Y" || fast == "+Y" {
                y = height - 1 - y;
            }
            pixels[y * width + x] = {
                let [r, g, b] = linear(texel);
                [r / scale[0], g / scale[1], b / scale[2]]
            };
        }
    }
    Ok(([width, height], pixels))
}

/// Multiplies by factors if all factors and products are positive and finite.
fn multiply(scale: &mut [f32; 3], by: [Option<f32>; 3]) {
    let products =
        [0, 1, 2].map(|k| by[k].filter(|factor| *factor > 0.0).map_or(0.0, |factor| scale[k] * factor));
    if products.iter().all(|product| *product > 0.0 && product.is_finite()) {
        *scale = products;
    }
}

/// Parses the number at the beginning of a text, like C.
fn first_number(text: &str) -> Option<f32> {
    let end = text.find(|c: char| !c.is_ascii_digit() && !"+-.eE".contains(c)).unwrap_or(text.len());
    text[..end].parse().ok()
}

/// Takes a line off the text and returns it.
fn line<'a>(rest: &mut &'a [u8]) -> Option<std::borrow::Cow<'a, str>> {
    let end = rest.iter().position(|&byte| byte == b'\n')?;
    let (line, behind) = (&rest[..end], &rest[end + 1..]);
    *rest = behind;
    Some(String::from_utf8_lossy(line))
}

/// Decodes a scanline: four runs of bytes, or texels with repetitions.
fn scanline(rest: &mut &[u8], width: usize) -> Result<Vec<[u8; 4]>, &'static str> {
    const SHORT: &str = "file ends within the pixel data";
    let mut texels = Vec::new();
    if let ([2, 2, high @ ..=127, low, behind @ ..], true) = (*rest, RUNS.contains(&width)) {
        if usize::from(*high) << 8 | usize::from(*low) != width {
            return Err("scanline width differs from the image width");
        }
        *rest = behind;
        texels.resize(width, [0; 4]);
        for channel in 0..4 {
            let mut at = 0;
            while at < width {
                let (&count, behind) = rest.split_first().ok_or(SHORT)?;
                let (run, taken) =
                    if count > 128 { (usize::from(count) - 128, 1) } else { (count.into(), count.into()) };
                let (values, behind) = behind.split_at_checked(taken).ok_or(SHORT)?;
                if run == 0 || at + run > width {
                    return Err("a run extends beyond its scanline");
                }
                for (k, texel) in texels[at..at + run].iter_mut().enumerate() {
                    texel[channel] = values[k % taken];
                }
                (at, *rest) = (at + run, behind);
            }
        }
        return Ok(texels);
    }
    let mut shift = 0;
    while texels.len() < width {
        let (&texel, behind) = rest.split_first_chunk::<4>().ok_or(SHORT)?;
        *rest = behind;
        if let [1, 1, 1, count] = texel {
            // Consecutive counts are digits of one number.
            let count = usize::from(count).checked_shl(shift).unwrap_or(width).min(width - texels.len());
            let last = *texels.last().ok_or("a scanline begins with a repetition")?;
            texels.extend(std::iter::repeat_n(last, count));
            shift = (shift + 8).min(24);
        } else {
            texels.push(texel);
            shift = 0;
        }
    }
    Ok(texels)
}

/// ```text
/// (m + ½) 2^(e − 136),   0 for e = 0
/// ```
fn linear([r, g, b, e]: [u8; 4]) -> [f32; 3] {
    let unit = if e == 0 { 0.0 } else { (f32::from(e) - 136.0).exp2() };
    [r, g, b].map(|m| (f32::from(m) + 0.5) * unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(size: &str, data: &[u8]) -> Vec<u8> {
        [format!("#?RADIANCE\n# made\nFORMAT=32-bit_rle_rgbe\n\n{size}\n").as_bytes(), data].concat()
    }

    fn read(size: &str, data: &[u8]) -> Result<([usize; 2], Vec<[f32; 3]>), &'static str> {
        decode(&file(size, data), |w, h| w * h < 1 << 20)
    }

    #[test]
    fn texel_is_mantissa_times_power_of_two() {
        let (_, pixels) = read("-Y 1 +X 3", &[128, 64, 0, 129, 9, 9, 9, 0, 255, 1, 2, 60]).unwrap();
        let unit = 2.0_f32.powi(60 - 136);
        assert_eq!(
            pixels,
            [[1.003_906_3, 0.503_906_25, 0.003_906_25], [0.0; 3], [255.5, 1.5, 2.5].map(|m| m * unit)]
        );
        let exposed =
            String::from_utf8_lossy(&file("-Y 1 +X 1", b"")).replace("# made", "EXPOSURE=2\nEXPOSURE= 4");
        let bytes = [exposed.as_bytes(), &[127, 127, 127, 128 + 4]].concat();
        assert_eq!(decode(&bytes, |_, _| true).unwrap().1, [[127.5 / 128.0; 3]]);
    }

    #[test]
    fn exposure_that_is_not_positive_is_ignored() {
        let of = |exposure: &str| {
            let head = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE={exposure}\n\n-Y 1 +X 1\n");
            decode(&[head.as_bytes(), &[128, 128, 128, 129]].concat(), |_, _| true).unwrap().1
        };
        for exposure in ["0", "0.0", "-0", "-1", "nan", "inf", "-inf", "1e-46", "1e39", "none", ""] {
            assert_eq!(of(exposure), of("1"), "{exposure}");
        }
        assert_eq!(of("1e-30\nEXPOSURE=1e-30"), of("1e-30"));
        for exposure in
            ["2", "2 # twice", "2,0", "1\nCOLORCORR= 2 2 2", "2\n\tEXPOSURE=8", "2\nCOLORCORR= 4 0 1"]
        {
            assert_eq!(of(exposure)[0][0], of("1")[0][0] / 2.0, "{exposure}");
        }
        assert_eq!(of("1\nCOLORCORR=4 2 1")[0], [4.0, 2.0, 1.0].map(|by| of("1")[0][0] / by));
    }

    #[test]
    fn both_run_length_encodings() {
        let plain: Vec<u8> = (0..9).flat_map(|k| [if k < 6 { 5 } else { k }, 0, 7, 130]).collect();
        let old = [[5, 0, 7, 130], [1, 1, 1, 5], [6, 0, 7, 130], [7, 0, 7, 130], [8, 0, 7, 130]].concat();
        let new = [&[2, 2, 0, 9, 128 + 6, 5, 3, 6, 7, 8][..], &[137, 0, 137, 7, 137, 130]].concat();
        for data in [old, new] {
            assert_eq!(read("-Y 1 +X 9", &data), read("-Y 1 +X 9", &plain));
        }
        // The second count is the higher digit.
        let long = [[5, 0, 7, 130], [1, 1, 1, 4], [1, 1, 1, 1]].concat();
        assert!(read("-Y 1 +X 261", &long).is_ok() && read("-Y 1 +X 262", &long).is_err());
    }

    #[test]
    fn orientations_are_normalized() {
        let red = |k: u8| [k, 0, 0, 136];
        let upright = [red(1), red(2), red(3), red(4), red(5), red(6)].concat();
        let (_, expected) = read("-Y 2 +X 3", &upright).unwrap();
        for (size, order) in [
            ("+Y 2 +X 3", [4, 5, 6, 1, 2, 3]),
            ("-Y 2 -X 3", [3, 2, 1, 6, 5, 4]),
            ("+X 3 -Y 2", [1, 4, 2, 5, 3, 6]),
            ("-X 3 +Y 2", [6, 3, 5, 2, 4, 1]),
        ] {
            assert_eq!(read(size, &order.map(red).concat()), Ok(([3, 2], expected.clone())), "{size}");
        }
    }

    #[test]
    fn radiance_errors() {
        for (size, data, said) in [
            ("-Y 1 +X 9", &[2, 2, 0, 9, 0][..], "a run extends beyond its scanline"),
            ("-Y 1 +X 9", &[2, 2, 0, 9, 138, 1], "a run extends beyond its scanline"),
            ("-Y 1 +X 9", &[2, 2, 0, 8], "scanline width differs from the image width"),
            ("-Y 1 +X 9", &[2, 2, 0, 9, 5, 1], "file ends within the pixel data"),
            ("-Y 1 +X 2", &[1, 1, 1, 1], "a scanline begins with a repetition"),
            ("-Y 1 +X", &[], "image size is not four words"),
            ("-Y 1 +Y 2", &[], "image size has axes other than X and Y"),
            ("-Y -1 +X 2", &[], "image size is not a number"),
        ] {
            assert_eq!(read(size, data), Err(said), "{size}");
        }
        assert_eq!(
            decode(b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n", |_, _| true).unwrap_err().split(':').next(),
            Some("unsupported color format")
        );
    }
}
