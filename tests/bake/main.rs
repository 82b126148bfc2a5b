//! The tools from outside: exit codes, figures, files, and aged models in other readers.

mod build;
mod strict;
mod tool;

mod carried;
mod extras;
mod faulty;
mod figures;
mod files;
mod left_alone;
mod masks;
mod model;
#[cfg(feature = "render")]
mod picture;
mod safety;
mod scale;
mod several;
mod table1;
mod units;
