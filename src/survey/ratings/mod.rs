//! Rates films in the terms of the standards by which coatings are inspected.

pub(super) mod all;
pub(super) mod astm_rust;
pub(super) mod cracking;
pub(super) mod error;
pub(super) mod flaking;
pub(super) mod rust_grade;
pub(super) mod size;
mod words;
