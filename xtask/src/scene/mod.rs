//! A small ray caster: shapes, a pinhole camera, and shading by a normal density function.

pub(crate) mod camera;
pub(crate) mod mesh;
pub(crate) mod render;
pub(crate) mod shape;
pub(crate) mod teapot;
