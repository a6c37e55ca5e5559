//! What a ray can meet: shapes, meshes and where they come from, and the camera that the rays start at.

pub mod camera;
pub mod car;
pub mod fractal;
pub mod mesh;
pub mod mesh_file;
pub mod ray;
pub mod relief;
pub mod revolution;
pub mod shape;
pub mod teapot;
