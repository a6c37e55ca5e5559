//! Materials from far to very close: means, aliasing, and positions about a focus.

mod aliasing;
mod zoom_focus;
mod zoom_means;
