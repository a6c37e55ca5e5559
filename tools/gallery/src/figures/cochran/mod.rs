//! Figures of Cochran, Lewis and Hart 2000.

pub(super) mod area;
pub(super) mod bounds;
pub(super) mod corner;
pub(super) mod curves;
pub(super) mod landscape;
pub(super) mod mirrors;
pub(super) mod models;
pub(super) mod orders;
pub(super) mod zoom;
