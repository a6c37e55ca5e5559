//! The modules shared by the programs of this repository: input, exported tables, progress, pages,
//! command line.
#![expect(
    missing_docs,
    clippy::missing_errors_doc,
    clippy::must_use_candidate,
    reason = "only programs of this repository use it"
)]

pub mod cli;
pub mod failure;
pub mod html;
pub mod input;
pub mod output;
pub mod progress;
pub mod quality;
pub mod tables;
