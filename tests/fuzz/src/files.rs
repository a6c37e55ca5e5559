//! Readers of images and meshes: a valid result or a one-line error, with memory in proportion to
//! the file.

use std::path::Path;

use asperity_render::geometry::mesh_file::{self, Format, MeshFileError, MeshReading, Up};
use asperity_render::image::content::Content;
use asperity_render::image::read::ImageFile;

use crate::within;

const MIB: usize = 1 << 20;

/// Reads an image. The reader may allocate `least` samples for any file size.
fn image(bytes: Vec<u8>, least: usize) {
    // The samples accepted by a reader: once as bytes, once as planes, and once in the decoder's
    // intermediate form. A one-byte sample becomes four bytes.
    let most = 16 * MIB + 12 * (1032 * bytes.len()).max(least);
    match within(most, || ImageFile::decode(&bytes, Content::Colors)) {
        Ok(image) => {
            assert!(image.width > 0 && image.height > 0 && !image.planes.is_empty());
            let all = |plane: &Vec<f32>| plane.len() == image.width * image.height;
            assert!(image.planes.iter().all(all));
            if !image.floats {
                let share = |x: &f32| (0.0..=1.0).contains(x);
                assert!(image.planes.iter().all(|plane| plane.iter().all(share)));
            }
            assert_eq!(image.gray().len(), image.width * image.height);
        }
        Err(error) => one_line(&error.to_string()),
    }
}

fn one_line(error: &str) {
    assert!(!error.is_empty() && error.lines().count() == 1 && error.len() < 1000, "{error:?}");
}

/// Prepends the magic bytes of a format.
fn beginning(magic: &[u8], data: &[u8]) -> Vec<u8> {
    let mut bytes = data.to_vec();
    bytes.resize(bytes.len().max(magic.len()), 0);
    bytes[..magic.len()].copy_from_slice(magic);
    bytes
}

pub(crate) fn png(data: &[u8]) {
    image(beginning(b"\x89PNG\r\n\x1a\n", data), 4 * MIB);
}

pub(crate) fn exr(data: &[u8]) {
    // The display window, of which the file fills a part.
    image(beginning(b"\x76\x2f\x31\x01\x02\0\0", data), 16 * MIB);
}

/// JPEG, WebP, Radiance HDR, and other data.
pub(crate) fn picture(data: &[u8]) {
    image(data.to_vec(), 4 * MIB);
}

fn mesh_of(format: Format, bytes: &[u8], up: Up) {
    // A triangle of a strip takes a byte in the file, and more than half a kilobyte until its
    // corners have normals. The textures of a glTF have at most 64 Mi texels and 1032 for each
    // byte, of up to 4 bytes. The last image is also in the decoder's form, of up to 8 bytes per
    // texel.
    let texels = 64 * MIB + 1032 * bytes.len();
    let most = 64 * MIB + 4096 * bytes.len() + if format == Format::Gltf { 12 * texels } else { 0 };
    let reading = MeshReading { up, crease: 40.0, materials: true };
    match within(most, || mesh_file::decode(format, bytes, Path::new("/nowhere"), reading)) {
        Ok(file) => {
            let mesh = &file.mesh;
            assert!(!mesh.triangles.is_empty());
            for vertex in &mesh.vertices {
                assert!(vertex.position.length() < 1.0 + 1e-6, "{}", vertex.position);
                assert!((vertex.normal.length() - 1.0).abs() < 1e-4, "{}", vertex.normal);
                assert!((vertex.tangent.length() - 1.0).abs() < 1e-4, "{}", vertex.tangent);
                assert!(vertex.uv.is_finite(), "{}", vertex.uv);
            }
            let inside = |&i: &u32| (i as usize) < mesh.vertices.len();
            assert!(mesh.triangles.iter().flatten().all(inside));
        }
        Err(MeshFileError::Unreadable { .. }) => panic!("no file was opened"),
        Err(error) => one_line(&error.to_string()),
    }
}

/// OBJ, PLY and STL, selected by the first byte.
pub(crate) fn mesh(data: &[u8]) {
    let Some((&first, bytes)) = data.split_first() else { return };
    let format = [Format::Obj, Format::Ply, Format::Stl][usize::from(first) % 3];
    mesh_of(format, bytes, if first & 0x80 == 0 { Up::Y } else { Up::Z });
}

pub(crate) fn gltf(data: &[u8]) {
    mesh_of(Format::Gltf, data, Up::Y);
}
