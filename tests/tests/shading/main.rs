//! Shading: level of detail, Fresnel terms and means over the surface.

mod bad_input;
mod bsdf;
mod checked;
mod energy;
mod environment;
mod footprints;
mod fresnel;
mod fuzz;
mod golden;
mod golden_materials;
mod heights;
mod image_light;
mod materials;
mod mean_radiance;
mod normal_maps;
mod painted;
mod reflectance;
mod relief;
mod remapped;
mod rough_glass;
mod specular_antialiasing;
mod tangents;
mod textures;
mod visible_zoom;
mod zoom;
