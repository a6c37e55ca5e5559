//! Materials seen from afar to very near: means, aliasing, and positions about a focus.

mod aliasing;
mod zoom_focus;
mod zoom_means;
