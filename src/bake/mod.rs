//! Ages the props of a model file without an engine, and writes them as a model that other programs read.
//!
//! ```text
//! Input --read--> Model --bake--> Baked --> glb (aged model), stats (figures), csv (vertices) --> StagedFiles
//! ```
//!
//! This is the library behind the program `coating-bake`. It needs the feature `bake`, and neither a window nor a
//! graphics adapter.
//!
//! # From a prop to an aged model
//!
//! 1. [`Input::read`] reads a `.glb`, `.gltf` or `.obj` file, or makes a test piece of the paper;
//!    [`Model::from_gltf`] and [`Model::from_obj`] read bytes in memory.
//! 2. [`bake()`] makes a film for each mesh and ages all of them, each on a thread of its own. [`Progress`] tells how
//!    far it is.
//! 3. [`Baked::glb`] makes the aged model, with its stains in textures or in vertex colours ([`StainOutput`]);
//!    [`Baked::stats`] returns the figures of the run, and [`Baked::csv`] all vertices.
//! 4. [`StagedFiles`] writes files whole or not at all.
//!
//! The same model, options and seed give the same bits on every platform and on any number of threads.
//!
//! ```
//! use bevy_coating::bake::{BakeOptions, Images, Input, StainOutput, Stopwatch, bake};
//!
//! let stopwatch = Stopwatch::start();
//! let model = Input::parse("plate:200".as_ref())?.read(0, Images::Load)?;
//! let options = BakeOptions { age: 0.2, steps: 200, ..BakeOptions::default() };
//! let mut baked = bake(model, &options, stopwatch, &())?;
//!
//! let glb = baked.glb(StainOutput::Textures(64))?;
//! assert!(glb.starts_with(b"glTF"));
//!
//! let stats = baked.stats();
//! assert_eq!(stats.film.triangles, 200);
//! let last = stats.timeline.last().expect("the age asked for");
//! assert_eq!(last.age, 0.2);
//! assert!(baked.warnings.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What is kept of a model
//!
//! The aged model begins with the document that was read ([`Carried`]): nodes with their pivots, animations, cameras,
//! lights, extras, extensions that nobody here knows, and names stay as they are, and every index in it holds. Each
//! coated node gets a mesh of its own, in the node's space. Base colour, metalness, roughness and normals are baked
//! together with the stains where stains are written into textures. Glass, primitives of points and lines, and what
//! [`BakeOptions::exclude`] names are left as they are, and so is what custom properties say is not painted
//! ([`extras`](crate::extras)). What must go, such as morph targets, is named in one
//! [`BakeWarning`] a kind.

mod age;
mod baked;
mod carried;
mod coat;
mod dump;
mod error;
mod extras;
mod glb;
mod gltf;
mod images;
mod input;
mod leave;
mod limits;
mod mask_files;
mod media;
mod model;
mod name_pattern;
mod obj;
mod options;
mod output;
mod parallel;
mod printable;
mod progress;
mod shelter;
mod stain_output;
mod stats;
mod stopwatch;
mod texture_refs;
mod textures;
mod warning;
mod write;

pub use age::bake;
pub use baked::Baked;
pub use carried::Carried;
pub use coat::{Coated, Prop, coat};
pub use error::{BakeError, BrokenFilm, OptionsError};
pub use gltf::GltfError;
pub use images::Images;
pub use input::{Input, InputError, TestPiece};
pub use limits::{MAX_AGE, MAX_STEPS_PER_AGE, MAX_TRIANGLES, TEXTURE_SIZES, UNITS};
pub use mask_files::MaskFiles;
pub use model::{Image, Instance, MaterialLibrary, Model, ModelMesh, Place, Slot};
pub use name_pattern::NamePattern;
pub use obj::ObjError;
pub use options::BakeOptions;
pub use output::StagedFiles;
pub use printable::Printable;
pub use progress::Progress;
pub use stain_output::StainOutput;
pub use stats::{FilmStats, InputStats, RunStats, STATS_SCHEMA, Stats};
pub use stopwatch::{Seconds, Stopwatch};
pub use warning::BakeWarning;
