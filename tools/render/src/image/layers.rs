//! OpenEXR: selects the part and the channels of a file that form the image, within its display
//! window.

use std::io::Cursor;

use exr::{
    error::{Error, Result as ExrResult},
    image::read::any_channels::ReadAnyChannels,
    image::read::samples::ReadFlatSamples,
    meta::{MetaData, attribute::EnvironmentMap, header::Header},
    prelude::{ReadChannels, ReadLayers, Vec2},
};

use crate::image::content::{Content, ImageFileError, check_size};

/// Maximum pixels of a display window that a small file may fill with black around its data.
const MOST_FRAME: usize = 1 << 24;

/// An image's width and height, and its planes.
type Planes = ([usize; 2], Vec<Vec<f32>>);

/// Reads the channels of a content, black outside the data window.
pub(super) fn decode(bytes: &[u8], content: Content) -> Result<Planes, ImageFileError> {
    let broken = |error: Error| ImageFileError::Broken { format: "OpenEXR file", error: error.into() };
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(broken)?;
    for header in &meta.headers {
        let (width, height) = (header.layer_size.0, header.layer_size.1);
        check_size(width, height, header.channels.bytes_per_pixel, bytes.len())?;
        // The offset table has eight bytes per chunk.
        if header.chunk_count.saturating_mul(8) > bytes.len() {
            return Err(ImageFileError::Truncated { width, height, bytes: bytes.len() });
        }
    }
    let chosen = choose(&meta.headers, content)?;
    let header = &meta.headers[chosen.part];
    if content == Content::Colors && header.own_attributes.environment_map == Some(EnvironmentMap::Cube) {
        return Err(ImageFileError::CubeMap);
    }
    if header.channels.list.iter().any(|channel| channel.sampling != Vec2(1, 1)) {
        return Err(ImageFileError::Subsampled);
    }
    let frame = header.shared_attributes.display_window;
    let (width, height) = (frame.size.0, frame.size.1);
    if width.checked_mul(height).is_none_or(|pixels| pixels > MOST_FRAME) {
        check_size(width, height, 4 * chosen.channels.len(), bytes.len())?;
    }
    let all = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels();
    let image = OnePart { all, header }
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(broken)?;
    let layer = image.layer_data;
    let data = [layer.size.0, layer.size.1];
    let position = layer.attributes.layer_position;
    let offset = [position.0, position.1].map(i64::from);
    let offset = [offset[0] - i64::from(frame.position.0), offset[1] - i64::from(frame.position.1)];
    let planes = chosen.channels.iter().map(|&k| {
        let samples: Vec<f32> = layer.channel_data.list[k].sample_data.values_as_f32().collect();
        framed(samples, data, offset, [width, height])
    });
    Ok(([width, height], planes.collect()))
}

/// Places a plane in its frame, with 0 outside the data.
fn framed(samples: Vec<f32>, data: [usize; 2], offset: [i64; 2], frame: [usize; 2]) -> Vec<f32> {
    if offset == [0; 2] && data == frame {
        return samples;
    }
    let mut plane = vec![0.0; frame[0] * frame[1]];
    let inside = |from: i64, count: usize, frame: usize| {
        let first = (-from).clamp(0, count as i64);
        first as usize..(frame as i64 - from).clamp(first, count as i64) as usize
    };
    let columns = inside(offset[0], data[0], frame[0]);
    for row in inside(offset[1], data[1], frame[1]).filter(|_| !columns.is_empty()) {
        let to = (row as i64 + offset[1]) as usize * frame[0] + (columns.start as i64 + offset[0]) as usize;
        let from = &samples[row * data[0]..][columns.clone()];
        plane[to..to + from.len()].copy_from_slice(from);
    }
    plane
}

/// A reader of one part of the file.
struct OnePart<'h> {
    all: ReadAnyChannels<ReadFlatSamples>,
    header: &'h Header,
}

impl<'s> ReadChannels<'s> for OnePart<'_> {
    type Reader = <ReadAnyChannels<ReadFlatSamples> as ReadChannels<'s>>::Reader;

    fn create_channels_reader(&'s self, header: &Header) -> ExrResult<Self::Reader> {
        if header != self.header {
            return Err(Error::NotSupported("another part".into()));
        }
        self.all.create_channels_reader(header)
    }
}

/// Channels of a part that form an image.
#[derive(Clone)]
struct Candidate {
    part: usize,
    /// The names of the part, if there are several, and of the layer.
    layer: String,
    /// Indices into the part's channel list.
    channels: Vec<usize>,
}

impl Candidate {
    /// Returns the last word of the layer: `Combined` of `View Layer.Combined`.
    fn name(&self) -> &str {
        self.layer.rsplit('.').next().unwrap_or_default()
    }
}

/// Channel names in order of preference.
const COLORS: &[&[&str]] =
    &[&["r", "g", "b"], &["red", "green", "blue"], &["y"], &["l"], &["gray"], &["grey"], &["luminance"]];
const NORMALS: &[&[&str]] = &[
    &["x", "y", "z"],
    &["nx", "ny", "nz"],
    &["r", "g", "b"],
    &["red", "green", "blue"],
    &["x", "y"],
    &["nx", "ny"],
    &["r", "g"],
];

/// Names of layers that renderers use for the image and for normals. The first view of a stereo
/// pair is the left view.
const PICTURES: &[&str] = &[
    "",
    "rgba",
    "rgb",
    "combined",
    "beauty",
    "composite",
    "color",
    "colour",
    "c",
    "ci",
    "main",
    "image",
    "left",
];
const NORMAL_LAYERS: &[&str] = &["normal", "normals", "n", "nrm", "normalmap", "normal_map", ""];

/// Layers of data that are not images: words in their names, and whole names.
const DATA_WORDS: [&str; 9] =
    ["crypto", "depth", "mist", "motion", "normal", "position", "vector", "velocity", "object"];
const DATA: [&str; 8] = ["id", "n", "nn", "p", "st", "uv", "world", "z"];

/// Channels that are not displayed.
const HIDDEN: [&str; 9] = ["a", "alpha", "ar", "ag", "ab", "z", "zback", "depth", "id"];

/// Chooses the part and the channels of a content.
fn choose(headers: &[Header], content: Content) -> Result<Candidate, ImageFileError> {
    if headers.iter().any(|header| header.deep) {
        return Err(ImageFileError::DeepData);
    }
    let several = headers.len() > 1;
    let every = headers.iter().flat_map(|header| &header.channels.list);
    let names = every.map(|channel| channel.name.to_string()).collect::<Vec<_>>();
    let shown = names.iter().map(|name| name.chars().filter(|c| !c.is_control()).take(40).collect());
    let shown = shown.take(12).collect::<Vec<String>>().join(", ");
    let (kinds, layers) = match content {
        Content::Colors => (COLORS, PICTURES),
        Content::Normals => (NORMALS, NORMAL_LAYERS),
    };
    let has = |of: &Candidate, suffix: &str| channel(&headers[of.part], &of.layer, several, suffix).is_some();
    let mut found = candidates(headers, kinds);
    if content == Content::Colors {
        // Y next to X or Z is a coordinate.
        let coordinate = |of: &Candidate| has(of, "x") || has(of, "z") && !of.layer.is_empty();
        found.retain(|of| of.channels.len() == 3 || !coordinate(of));
        found.retain(|of| !is_data(of.name()));
    }
    let named = |name: &&str| {
        let of_name: Vec<_> = found.iter().filter(|of| of.name().eq_ignore_ascii_case(name)).collect();
        let first = *of_name.first()?;
        let whole = of_name.iter().find(|of| of.layer.eq_ignore_ascii_case(name));
        let composite = of_name.iter().find(|of| of.layer.to_ascii_lowercase().starts_with("composite"));
        let one = of_name.iter().all(|of| of.layer == first.layer).then_some(first);
        // Of several layers with the same name, none can be chosen.
        Some(whole.or(composite).copied().or(one).cloned())
    };
    let best = match layers.iter().find_map(named) {
        Some(best) => best,
        None => found.first().filter(|first| found.iter().all(|of| of.layer == first.layer)).cloned(),
    };
    if let Some(best) = best {
        if best.channels.len() == 1 && (has(&best, "ry") || has(&best, "by")) {
            return Err(ImageFileError::LuminanceChroma);
        }
        return Ok(best);
    }
    if !found.is_empty() {
        let mut layers: Vec<_> = found.iter().map(|candidate| candidate.layer.clone()).collect();
        layers.sort();
        layers.dedup();
        layers.truncate(12);
        return Err(ImageFileError::SeveralLayers { layers: layers.join(", ") });
    }
    if content == Content::Normals {
        return Err(ImageFileError::NoNormals { channels: shown });
    }
    // A single channel with any other name is a gray image.
    let mut others = headers.iter().enumerate().flat_map(|(part, header)| {
        let all = header.channels.list.iter().enumerate();
        let picture = all.filter(move |(_, channel)| {
            let name = channel.name.to_string();
            let layer = layer_of(header, several, &name);
            let last = layer.rsplit('.').next().unwrap_or_default();
            !HIDDEN.iter().any(|hidden| suffix_is(&name, hidden)) && !is_data(last)
        });
        picture.map(move |(k, _)| Candidate { part, layer: String::new(), channels: vec![k] })
    });
    match (others.next(), others.next()) {
        (Some(one), None) => Ok(one),
        (None, _) if names.iter().all(|name| suffix_is(name, "a")) => Err(ImageFileError::OnlyAlpha),
        _ => Err(ImageFileError::NoColors { channels: shown }),
    }
}

/// Whether a layer of this name contains depth, normals or other data.
fn is_data(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    DATA.contains(&&*name) || DATA_WORDS.iter().any(|word| name.contains(word))
}

/// Returns every layer of every part that has all channels of one of the sets, ordered by set.
fn candidates(headers: &[Header], sets: &[&[&str]]) -> Vec<Candidate> {
    let several = headers.len() > 1;
    let mut found: Vec<Candidate> = Vec::new();
    for set in sets {
        for (part, header) in headers.iter().enumerate() {
            for name in &header.channels.list {
                let name = name.name.to_string();
                if !suffix_is(&name, set[0]) {
                    continue;
                }
                let layer = layer_of(header, several, &name);
                let channels: Option<Vec<usize>> =
                    set.iter().map(|suffix| channel(header, &layer, several, suffix)).collect();
                if let Some(channels) = channels {
                    found.push(Candidate { part, layer, channels });
                }
            }
        }
    }
    found
}

/// Whether the name's last word equals `suffix`, ignoring case.
fn suffix_is(name: &str, suffix: &str) -> bool {
    name.rsplit('.').next().is_some_and(|last| last.eq_ignore_ascii_case(suffix))
}

/// Returns the layer of a channel, after the name of its part if there are several.
fn layer_of(header: &Header, several: bool, name: &str) -> String {
    let own = name.rsplit_once('.').map_or("", |(layer, _)| layer);
    let part = header.own_attributes.layer_name.as_ref().map(ToString::to_string);
    match part.filter(|_| several) {
        Some(part) if own.is_empty() => part,
        Some(part) if own != part && !own.starts_with(&format!("{part}.")) => format!("{part}.{own}"),
        _ => own.to_owned(),
    }
}

/// Returns the index of a layer's channel in its part.
fn channel(header: &Header, layer: &str, several: bool, suffix: &str) -> Option<usize> {
    header.channels.list.iter().position(|channel| {
        let name = channel.name.to_string();
        suffix_is(&name, suffix) && layer_of(header, several, &name) == layer
    })
}

#[cfg(test)]
mod tests {
    use exr::prelude::{
        AnyChannel, AnyChannels, Encoding, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
        LayerAttributes, Text, WritableImage,
    };

    use super::*;
    use crate::image::formats::exr;
    use crate::image::read::ImageFile;

    macro_rules! file {
        ($name:literal) => {
            include_bytes!(concat!("../../tests/data/images/", $name)).to_vec()
        };
    }

    fn colors(bytes: &[u8]) -> ImageFile {
        ImageFile::decode(bytes, Content::Colors).unwrap_or_else(|error| panic!("{error}"))
    }

    fn refused(bytes: &[u8], content: Content) -> String {
        decode(bytes, content).unwrap_err().to_string()
    }

    /// Parses channels such as `R=1, G=2`, two pixels each.
    fn channels(text: &str) -> impl Iterator<Item = (&str, Vec<f32>)> {
        let channels = text.split(", ").filter_map(|channel| channel.split_once('='));
        channels.map(|(name, value)| (name, vec![value.parse().unwrap(); 2]))
    }

    fn file(text: &str) -> Vec<u8> {
        exr(2, 1, channels(text)).unwrap()
    }

    /// Encodes a file of several parts.
    fn parts(parts: &[(&str, &str)]) -> Vec<u8> {
        let size = Vec2(2, 1);
        let layer = |&(name, text): &(&str, &str)| {
            let attributes = LayerAttributes::named(Text::new_or_panic(name));
            let channel = |(name, samples)| AnyChannel::new(name, FlatSamples::F32(samples));
            let channels = AnyChannels::sort(channels(text).map(channel).collect());
            Layer::new(size, attributes, Encoding::UNCOMPRESSED, channels)
        };
        let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
        let mut bytes = Cursor::new(Vec::new());
        let layers: Vec<_> = parts.iter().map(layer).collect();
        Image::from_layers(attributes, layers).write().non_parallel().to_buffered(&mut bytes).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn exr_data_window_is_placed_in_the_display_window() {
        assert_eq!(colors(&file!("crop.exr")), colors(&file!("crop-expected.exr")));
        assert_eq!(colors(&file!("overscan.exr")), colors(&file!("overscan-expected.exr")));
    }

    #[test]
    fn framed_clips_and_fills_on_every_side() {
        let data: Vec<f32> = (1..=6_u8).map(f32::from).collect();
        for (offset, expected) in [
            ([0, 0], [[1.0, 2.0, 3.0, 0.0], [4.0, 5.0, 6.0, 0.0]]),
            ([1, 1], [[0.0; 4], [0.0, 1.0, 2.0, 3.0]]),
            ([2, -1], [[0.0, 0.0, 4.0, 5.0], [0.0; 4]]),
            ([-1, 0], [[2.0, 3.0, 0.0, 0.0], [5.0, 6.0, 0.0, 0.0]]),
            ([4, 0], [[0.0; 4]; 2]),
            ([-3, 0], [[0.0; 4]; 2]),
            ([0, 2], [[0.0; 4]; 2]),
            ([i64::from(i32::MIN), i64::from(i32::MAX)], [[0.0; 4]; 2]),
        ] {
            assert_eq!(framed(data.clone(), [3, 2], offset, [4, 2]), expected.as_flattened(), "{offset:?}");
        }
    }

    #[test]
    fn exr_colors_may_be_in_a_layer() {
        let combined = colors(&file!("blender-multilayer.exr"));
        let layer = colors(&file!("prefix.exr"));
        assert_eq!((combined.planes.len(), layer.planes.len()), (3, 3));
        for (channels, expected) in [
            ("R=1, G=2, B=3, diffuse.R=9, diffuse.G=9, diffuse.B=9", [1.0, 2.0, 3.0]),
            ("red=1, green=2, blue=3, Z=9", [1.0, 2.0, 3.0]),
            ("r=1, g=2, b=3, a=9", [1.0, 2.0, 3.0]),
            ("Y=4, Z=9, A=9", [4.0; 3]),
            (
                "RenderLayer.Combined.R=1, RenderLayer.Combined.G=2, RenderLayer.Combined.B=3, \
                 RenderLayer.Diffuse.R=9, RenderLayer.Diffuse.G=9, RenderLayer.Diffuse.B=9",
                [1.0, 2.0, 3.0],
            ),
            ("density=5, A=9, Z=9", [5.0; 3]),
            ("Y=4, normal.R=9, normal.G=9, normal.B=9", [4.0; 3]),
            ("Y=4, Crypto00.R=9, Crypto00.G=9, Crypto00.B=9", [4.0; 3]),
            ("diffuse.R=1, diffuse.G=2, diffuse.B=3, N.R=9, N.G=9, N.B=9", [1.0, 2.0, 3.0]),
            (
                "Composite.Combined.R=1, Composite.Combined.G=2, Composite.Combined.B=3, \
                 Back.Combined.R=9, Back.Combined.G=9, Back.Combined.B=9",
                [1.0, 2.0, 3.0],
            ),
            ("left.R=1, left.G=2, left.B=3, right.R=9, right.G=9, right.B=9", [1.0, 2.0, 3.0]),
        ] {
            let image = colors(&file(channels));
            assert_eq!(image.colors().map(|plane| plane[0]), expected, "{channels:?}");
        }
    }

    #[test]
    fn exr_colors_may_be_in_any_part() {
        let rgb = "R=1, G=2, B=3";
        let other = "R=9, G=9, B=9";
        let prefixed = "beauty.R=1, beauty.G=2, beauty.B=3";
        let depth = "Z=9";
        for of in [
            parts(&[("depth", depth), ("rgba", rgb)]),
            parts(&[("depth", depth), ("picture", rgb)]),
            parts(&[("diffuse", other), ("beauty", rgb)]),
            parts(&[("diffuse", other), ("beauty", prefixed)]),
        ] {
            assert_eq!(colors(&of).colors().map(|plane| plane[0]), [1.0, 2.0, 3.0]);
        }
        assert_eq!(colors(&file!("multipart-depth-first.exr")).planes.len(), 3);
        let unnamed = refused(&parts(&[("one", rgb), ("two", other)]), Content::Colors);
        assert_eq!(unnamed, "cannot choose between the image's layers: one, two");
    }

    #[test]
    fn exr_without_colors_is_an_error() {
        for (channels, message) in [
            ("Z=1", "the image has no color channels (found Z)"),
            ("R=1, G=1", "the image has no color channels (found G, R)"),
            ("A=1", "the image has only an alpha channel"),
            ("Depth.V=1", "the image has no color channels"),
            ("Depth.R=1, Depth.G=1, Depth.B=1", "the image has no color channels"),
            ("X=1, Y=1, Z=1", "the image has no color channels"),
            ("P.X=1, P.Y=1, P.Z=1", "the image has no color channels"),
            ("UV.U=1, UV.V=1", "the image has no color channels"),
            ("H=1, S=1, V=1", "the image has no color channels"),
            (
                "A.Combined.R=1, A.Combined.G=1, A.Combined.B=1, B.Combined.R=1, B.Combined.G=1, B.Combined.B=1",
                "cannot choose between the image's layers: A.Combined, B.Combined",
            ),
            ("Y=1, RY=0, BY=0", "luminance and chroma channels"),
        ] {
            let got = refused(&file(channels), Content::Colors);
            assert!(got.contains(message), "{got}");
        }
        assert!(refused(&file!("luminance-chroma.exr"), Content::Colors).contains("luminance and chroma"));
        assert!(refused(&file!("cube-attr.exr"), Content::Colors).contains("cube maps are not supported"));
    }

    #[test]
    fn exr_normals_are_taken_from_their_layer() {
        let picture = "R=9, G=9, B=9, Z=9";
        for normals in [
            "N.X=1, N.Y=2, N.Z=3, P.X=9, P.Y=9, P.Z=9",
            "View Layer.Normal.X=1, View Layer.Normal.Y=2, View Layer.Normal.Z=3",
            "normal.r=1, normal.g=2, normal.b=3",
        ] {
            let image = ImageFile::decode(&file(&format!("{picture}, {normals}")), Content::Normals).unwrap();
            assert_eq!(image.colors().map(|plane| plane[0]), [1.0, 2.0, 3.0], "{normals:?}");
        }
        let two = ImageFile::decode(&file("R=1, G=2"), Content::Normals).unwrap();
        assert_eq!(two.planes, [[1.0; 2], [2.0; 2]]);
        let gray = refused(&file("Y=1"), Content::Normals);
        assert_eq!(gray, "a normal map needs channels R, G, B or X, Y, Z, got Y");
    }

    #[test]
    fn exr_small_file_cannot_claim_a_large_display_window() {
        let mut bytes = file("Y=1");
        let name = b"displayWindow\0box2i\0";
        let at = bytes.windows(name.len()).position(|window| window == name).unwrap() + name.len() + 12;
        bytes[at..at + 4].copy_from_slice(&((1 << 25) - 1_i32).to_le_bytes());
        assert!(refused(&bytes, Content::Colors).contains("cannot hold the 33554432 × 1 pixels"));
    }
}
