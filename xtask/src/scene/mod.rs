//! A small ray caster: shapes, a pinhole camera, and shading by a normal density function.

pub(crate) mod background;
pub(crate) mod camera;
pub(crate) mod car;
pub(crate) mod cobbles;
pub(crate) mod field;
pub(crate) mod finish;
pub(crate) mod fractal;
pub(crate) mod hemisphere;
pub(crate) mod lights;
pub(crate) mod material;
pub(crate) mod mesh;
pub(crate) mod mesh_file;
pub(crate) mod pattern;
pub(crate) mod ray;
pub(crate) mod relief;
pub(crate) mod render;
pub(crate) mod request;
pub(crate) mod revolution;
pub(crate) mod sampler;
pub(crate) mod set;
pub(crate) mod shape;
pub(crate) mod stage;
pub(crate) mod surroundings;
pub(crate) mod swatch;
pub(crate) mod teapot;
