//! Shading: level of detail, Fresnel terms and means over the surface.

mod aliasing;
mod environment;
mod fresnel;
mod image_light;
mod materials;
mod mean_radiance;

mod normal_maps;
mod reflectance;
mod remapped;
mod textures;
mod zoom;
mod zoom_means;
