//! Figures of the paper, measured on our films. Needs no engine: the gallery writes them beside its pictures, and
//! `cargo core --test gallery` holds them to their bands.

#![allow(dead_code, reason = "the gallery and its test include this folder as a module, and each uses its part")]

pub mod claim;
pub mod curvature;
pub mod disk;
pub mod exhibit;
pub mod figure;
pub mod figures;
pub mod page;
pub mod painted;
pub mod solid;
pub mod spread;
pub mod stains;
pub mod table1;
pub mod trends;
