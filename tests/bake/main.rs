//! The tools from outside: exit codes, figures, files, and aged models in other readers.

mod tool;

mod figures;
mod files;
mod model;
#[cfg(feature = "render")]
mod picture;
mod safety;
mod several;
mod table1;
