//! The tools from outside: exit codes, figures, files, and aged models in other readers.

mod tool;

mod figures;
mod model;
#[cfg(feature = "render")]
mod picture;
mod table1;
