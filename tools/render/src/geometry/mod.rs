//! Geometry: shapes, meshes, rays with differentials, and cameras.

mod boxes;
pub mod camera;
pub mod car;
#[cfg(test)]
mod checks;
pub mod fractal;
pub mod mesh;
pub mod mesh_file;
pub mod ray;
pub mod relief;
pub mod revolution;
pub mod shape;
pub mod teapot;
