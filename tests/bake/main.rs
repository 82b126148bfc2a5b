//! The tools from outside: exit codes, figures, files, and aged models in other readers.

#[path = "../../examples/common/mod.rs"]
mod common;
mod tool;

mod figures;
mod model;
#[cfg(feature = "render")]
mod picture;
mod table1;
