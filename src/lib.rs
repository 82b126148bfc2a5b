//! Paint on metal that separates, cracks, curls, flakes off and bleeds rust while a [Bevy](https://bevy.org) game runs.
//!
//! After A. Ishitobi, M. Nakayama, I. Fujishiro: *Visual Simulation of Crack and Bend Generation in Deteriorated Films
//! Coated on Metal Objects: Combination of Static Fracture and Position-Based Deformation*, The Visual Computer, 2023
//! ("VC" in these pages).
//!
//! # Quick start
//!
//! Add the plugin, and a [`Coating`](plugin::Coating) to an entity with a mesh or to the root of a scene:
//!
//! ```no_run
//! use bevy::prelude::*;
//! use bevy_coating::prelude::*;
//!
//! fn main() {
//!     // In a game: DefaultPlugins.
//!     App::new()
//!         .add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin))
//!         .add_plugins(CoatingWeatheringPlugin::default())
//!         .add_systems(Startup, paint)
//!         .add_systems(Update, sweep_up)
//!         .run();
//! }
//!
//! fn paint(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>) {
//!     let barrel = meshes.add(Cylinder::new(0.3, 0.9));
//!     let coating = Coating::preset("heavy").unwrap_or_default().with_seed(7).with_start_age(0.4);
//!     commands.spawn((Mesh3d(barrel), coating));
//! }
//!
//! fn sweep_up(mut pieces: MessageReader<PieceFallen>) {
//!     for piece in pieces.read() {
//!         info!("{} shed a flake of {:.0} mm at {}", piece.entity, piece.size * 1e3, piece.position);
//!     }
//! }
//! ```
//!
//! # Concepts
//!
//! - The **film** is the paint: a half-edge mesh of near-equal triangles over the prop's surface ([`film`]), made in the
//!   background from any mesh ([`film::build`]). Its parts (mesh, forces, constraints, stains) are components on the prop's entity.
//! - **Age** is its time: 0 is fresh, 1 the end of the paper's reference run. Every rate is per unit age. A film ages in
//!   whole steps, by default 1,000 a unit of age, and its state depends on their number alone: at any frame rate and on
//!   any number of threads the same seed gives the same bits.
//! - **Settings** steer the stages ([`settings`]): given in code, as a preset, or as a `.coating.ron` asset.
//! - **Stains** follow ([`stain`]): rust that runs off below cracks, dust, and moisture where it rains, on the film and on
//!   the metal under it.
//! - What is **shown** is the film, wearing the prop's own surface, and where it has come off its back in primer and the
//!   bare metal beneath ([`shown`]).
//!
//! # The pipeline
//!
//! ```text
//! Mesh3d + Coating --(in the background: clean, weld, remesh, age to the start age)--> film components
//!                                                                                           |
//! CoatingClock, CoatingBudget --> n runs of the schedule CoatingStep a frame:                v
//!     Forces -> Separate -> Tear -> Strip -> Bend -> Rust -> Dust -> Moisture -> Report
//!                                                                                           |
//! PostUpdate, only for films that changed:                                                  v
//!     the prop's Mesh3d (a mesh of its own), backs of flakes, bare metal
//! ```
//!
//! [`sim::FilmState`] runs the same stages in the same order without an engine, for tools and tests.
//!
//! # Features
//!
//! | feature | default | what it adds |
//! |---|---|---|
//! | `render` | yes | stains in detail (`StainedMaterial`), the backs of flakes and the bare metal; needs `bevy_pbr` |
//!
//! # Limits
//!
//! - Skinned and morphed meshes and alpha-blended materials are refused with an error that says so
//!   ([`plugin::CoatingFault`]), and so are materials other than `StandardMaterial` unless [`plugin::StainDisplay`] leaves
//!   them alone; the prop keeps its mesh. Vertex attributes other than normals, both sets of texture
//!   coordinates, tangents and colours are not carried over.
//! - Contact is with the metal alone, and only with the plane under each vertex: on concave or intersecting surfaces film
//!   may still cut into metal or other film.
//! - The film takes the prop's world scale when it is built. Later changes of scale stretch what is shown, and shear (a
//!   rotated child of an unevenly scaled parent) is taken for the nearest scale without it.
//! - A mesh asset that is edited in place is not followed; a handle that is swapped is.

#![warn(missing_docs)]
// What a user gives must end in a typed error, never in a panic.
#![warn(clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::unreachable)]

#[cfg(feature = "plugin")]
mod api;
pub mod appearance;
#[cfg(feature = "plugin")]
mod attach;
#[cfg(feature = "bake")]
pub mod bake;
pub mod deform;
#[cfg(feature = "plugin")]
mod display;
pub mod film;
pub mod fracture;
pub mod guide;
#[cfg(feature = "plugin")]
mod mesh_reader;
#[cfg(feature = "plugin")]
mod plugin;
pub mod prelude;
pub mod remesh;
pub mod settings;
#[cfg(feature = "plugin")]
mod shelter;
pub mod sim;
pub mod stain;
#[cfg(feature = "plugin")]
mod stepping;
pub mod surface;

#[cfg(feature = "plugin")]
pub use api::{
    budget::CoatingBudget,
    clock::{CoatingClock, CoatingGravity, DEFAULT_AGE_PER_SECOND},
    coating::{Coating, DEFAULT_TRIANGLES, SettingsSource},
    diagnostics,
    error::{CoatingError, CoatingFault},
    film_pace::FilmPace,
    links::{CoatedBy, CoatingPart},
    messages::{FilmFailed, FilmReady, FirstCrack, PieceFallen},
    shelter::{RainShelter, Shelter},
    stain_display::StainDisplay,
    status::CoatingStatus,
    system_sets::{CoatingAdvance, CoatingAttach, CoatingDisplay, CoatingStep, CoatingSystems},
    weather::CoatingWeather,
};
#[cfg(feature = "plugin")]
pub use display::{ATTRIBUTE_REST, ATTRIBUTE_REST_NORMAL, ATTRIBUTE_STAINS};
#[cfg(feature = "render")]
pub use display::{CoatedMaterial, StainExtension, StainView, StainedMaterial};
#[cfg(feature = "plugin")]
pub use plugin::CoatingWeatheringPlugin;
#[cfg(feature = "plugin")]
pub use settings::asset::{CoatingSettingsLoader, CoatingSettingsLoaderError, CoatingSettingsPlugin};

/// Compiles the snippets of the README.
#[cfg(all(doctest, feature = "plugin"))]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;
