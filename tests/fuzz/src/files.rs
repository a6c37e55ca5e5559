//! Readers of pictures and meshes: a right result or one line, and no more memory than the file is worth.

use std::path::Path;

use asperity_render::geometry::mesh_file::{self, Format, MeshFileError, MeshReading, Up};
use asperity_render::image::content::Content;
use asperity_render::image::read::ImageFile;

use crate::within;

const MIB: usize = 1 << 20;

/// An image, for which its reader may allocate so many samples whatever the file's size.
fn image(bytes: Vec<u8>, least: usize) {
    // The samples that a reader admits, once as bytes, once as planes, and once as the decoder has them in between; a sample of a
    // byte becomes four.
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
            assert_eq!(image.grey().len(), image.width * image.height);
        }
        Err(error) => one_line(&error.to_string()),
    }
}

fn one_line(error: &str) {
    assert!(!error.is_empty() && error.lines().count() == 1 && error.len() < 1000, "{error:?}");
}

/// The file with the first bytes of its format.
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
    // The frame of a display window, of which the file fills a part.
    image(beginning(b"\x76\x2f\x31\x01\x02\0\0", data), 16 * MIB);
}

/// JPEG, WebP and Radiance HDR, and what is none of them.
pub(crate) fn picture(data: &[u8]) {
    image(data.to_vec(), 4 * MIB);
}

fn mesh_of(format: Format, bytes: &[u8], up: Up) {
    // A triangle of a strip takes a byte, and more than half a kilobyte until its corners have normals.
    let most = 64 * MIB + 4096 * bytes.len();
    let reading = MeshReading { up, crease: 40.0 };
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

/// OBJ, PLY and STL; the first byte chooses.
pub(crate) fn mesh(data: &[u8]) {
    let Some((&first, bytes)) = data.split_first() else { return };
    let format = [Format::Obj, Format::Ply, Format::Stl][usize::from(first) % 3];
    mesh_of(format, bytes, if first & 0x80 == 0 { Up::Y } else { Up::Z });
}

pub(crate) fn gltf(data: &[u8]) {
    mesh_of(Format::Gltf, data, Up::Y);
}
