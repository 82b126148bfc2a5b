//! Paint on metal that separates, cracks, curls, flakes off and bleeds rust while a [Bevy](https://bevy.org) game runs.
//!
//! The simulation follows A. Ishitobi, M. Nakayama, I. Fujishiro: *Visual Simulation of Crack and Bend Generation in
//! Deteriorated Films Coated on Metal Objects: Combination of Static Fracture and Position-Based Deformation*, The
//! Visual Computer, 2023 ("VC" in these pages).
//!
//! # Quick start
//!
//! Add the plugin, and a [`Coating`] to an entity with a mesh or to the root of a scene:
//!
#![cfg_attr(feature = "plugin", doc = "```no_run")]
#![cfg_attr(not(feature = "plugin"), doc = "```ignore")]
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
//!     let coating = Coating::new(Preset::Heavy).with_seed(7).with_start_age(0.4);
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
//! Without an engine the same film can be aged step by step:
//!
//! ```
//! use bevy_coating::{prelude::*, remesh::sample, sim::FilmState, stain::Environment};
//!
//! let piece = sample::plate(400, 1)?;
//! let settings = CoatingSettings::from(Preset::Heavy);
//! let mut film = FilmState::new(&piece.film, &settings, 7, 100).ok_or("an empty film")?;
//! film.age_to(1.0, &settings, &Environment::default());
//! assert!(film.forces.torn_edges > 0, "the paint has cracked");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Concepts
//!
//! - **Prop**: an object of the game, whose mesh is metal with paint on it.
//! - **Film**: the paint. It is a half-edge mesh of nearly equal triangles over the prop's surface ([`film`]), which is
//!   made in the background from any triangle mesh ([`surface`], [`remesh`]). Its mesh, forces, constraints and stains
//!   are components on one entity.
//! - **Age**: the time of a film. 0 is fresh paint, 1 the end of the paper's reference run, and every rate is per unit
//!   of age. A film ages in whole steps, 1,000 per unit of age by default. Its state depends on the number of steps
//!   alone: the same seed gives the same bits at any frame rate and on any number of threads.
//! - **Fracture**: vertices separate from the metal, edges tear into cracks, and loose pieces fall ([`fracture`], VC
//!   5).
//! - **Deformation**: separated paint bends and curls ([`deform`], VC 4).
//! - **Stains**: rust that runs off below cracks, dust, and moisture where it rains, on the film and on the metal under
//!   it ([`stain`], VC 6).
//! - **Appearance**: the meshes that are drawn. They are the front of the film with the prop's own attributes, the
//!   backs of flakes in primer, and the bare metal ([`appearance`]).
//! - **Heat maps**: what a film is about to do, as colours over it ([`heat`]).
//! - **Settings**: the numbers that steer each stage ([`settings`]). They are given in code, as a
//!   [`Preset`](settings::Preset), or as a `.coating.ron` asset.
//!
//! # Pipeline
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
//! | feature | default | contents |
//! |---|---|---|
//! | `plugin` | yes | the Bevy plugin: components, resources, messages, assets, and meshes that follow their films |
//! | `render` | yes | stains in detail, the backs of flakes and the bare metal; needs `bevy_pbr`, includes `plugin` |
//! | `tools` | no | brushes at the pointer, gizmos; needs `bevy_picking` and `bevy_gizmos`, includes `plugin` |
//! | `panel` | no | a panel for settings, clock, maps and figures; needs `bevy_egui`, includes `render`, `tools` |
//! | `gltf` | no | coatings from custom properties of glTF files, as Blender writes them; needs `bevy_gltf` |
//! | `bake` | no | ageing of model files without an engine: the module `bake` and the program `coating-bake` |
//! | (none) | | with `default-features = false` the simulation alone, which depends on `bevy_math` but not on Bevy |
//!
//! # Limits
//!
//! - Skinned and morphed meshes are refused with an error that names the way out ([`CoatingFault`]). Materials other
//!   than `StandardMaterial` are refused, too, unless [`StainDisplay`] says to leave the material alone. A refused prop
//!   keeps its mesh, and is coated as soon as the cause is mended. Glass is left alone.
//! - Of the vertex attributes only positions, normals, both sets of texture coordinates, tangents and colours are
//!   carried over to the film.
//! - A film touches the metal under it only, as a plane under each vertex. On concave or intersecting surfaces film
//!   may cut into metal or into other film.
//! - A film takes the prop's world scale when it is built. Later changes of scale stretch the film's mesh. Shear (a
//!   rotated child of an unevenly scaled parent) is replaced by the nearest scale without it.
//! - A film follows when the handle of the prop's mesh is replaced, but not when the mesh asset is edited.
//!
#![cfg_attr(not(feature = "plugin"), doc = "[`Coating`]: https://docs.rs/bevy_coating")]
#![cfg_attr(not(feature = "plugin"), doc = "[`CoatingFault`]: https://docs.rs/bevy_coating")]
#![cfg_attr(not(feature = "plugin"), doc = "[`StainDisplay`]: https://docs.rs/bevy_coating")]
#![warn(missing_docs)]
// Invalid input from a user must end in a typed error, never in a panic.
#![deny(clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::unreachable)]

#[cfg(feature = "plugin")]
mod api;
pub mod appearance;
#[cfg(feature = "plugin")]
mod attach;
#[cfg(feature = "bake")]
pub mod bake;
mod coding;
#[cfg(feature = "plugin")]
mod debris;
pub mod deform;
#[cfg(feature = "plugin")]
mod display;
#[cfg(any(feature = "bake", feature = "gltf"))]
pub mod extras;
mod files;
pub mod film;
pub mod fracture;
#[cfg(feature = "tools")]
mod gizmos;
pub mod guide;
pub mod heat;
pub mod history;
#[cfg(feature = "plugin")]
mod inspect;
pub mod masks;
#[cfg(feature = "plugin")]
mod mesh_reader;
#[cfg(feature = "panel")]
mod panel;
#[cfg(feature = "plugin")]
mod plugin;
#[cfg(feature = "tools")]
mod pointing;
pub mod prelude;
pub mod remesh;
mod rest;
pub mod settings;
#[cfg(feature = "plugin")]
mod shelter;
pub mod sim;
pub mod snapshot;
pub mod stain;
#[cfg(feature = "plugin")]
mod stepping;
pub mod surface;
pub mod survey;
#[cfg(feature = "plugin")]
mod timeline;
pub mod touch;

#[cfg(feature = "plugin")]
pub use api::{
    budget::CoatingBudget,
    calendar::CoatingCalendar,
    clock::{CoatingClock, CoatingGravity, DEFAULT_AGE_PER_SECOND},
    coating::Coating,
    debris::{CoatingDebris, Flake},
    diagnostics,
    error::{CoatingError, CoatingFault},
    exclude::CoatingExclude,
    film_pace::FilmPace,
    heat_map_view::HeatMapView,
    history::CoatingHistory,
    limits::{MAX_RATE, MAX_START_AGE, MAX_STEPS_PER_AGE},
    links::{CoatedBy, CoatedMesh, CoatingFilms, CoatingPart},
    masks::CoatingMasks,
    messages::{
        AgeReached, FilmFailed, FilmReady, FilmRepainted, FirstCrack, FirstSeparation, PieceFallen, RatingReached,
        RestoreFailed,
    },
    outline::{PropMask, PropOutline},
    paint::{Paint, SettingsSource},
    seed::CoatingSeed,
    shelter::{RainShelter, Shelter},
    snapshot::{CoatingSnapshot, SaveError, SavedFilm},
    stain_display::StainDisplay,
    status::CoatingStatus,
    summary::FilmSummary,
    system_sets::{CoatingAdvance, CoatingAttach, CoatingDisplay, CoatingStep, CoatingSystems},
    unit::CoatingUnit,
    weather::{CoatingWeather, PropWeather},
};
#[cfg(feature = "plugin")]
pub use display::{ATTRIBUTE_REST, ATTRIBUTE_REST_NORMAL, ATTRIBUTE_STAINS};
#[cfg(feature = "render")]
pub use display::{CoatedMaterial, StainExtension, StainView, StainedMaterial};
#[cfg(feature = "tools")]
pub use gizmos::{CoatingGizmos, CoatingGizmosPlugin};
#[cfg(feature = "plugin")]
pub use inspect::{FilmHit, FilmQuery};
#[cfg(feature = "panel")]
pub use panel::{CoatingPanel, CoatingPanelPlugin, PanelWidget};
#[cfg(feature = "plugin")]
pub use plugin::CoatingWeatheringPlugin;
#[cfg(feature = "tools")]
pub use pointing::{BrushGizmos, CoatingBrush, CoatingPointingPlugin};
#[cfg(feature = "plugin")]
pub use settings::asset::{CoatingSettingsLoader, CoatingSettingsLoaderError, CoatingSettingsPlugin};
#[cfg(feature = "plugin")]
pub use stepping::{FilmEdit, TouchAt, TouchCommands};
#[cfg(feature = "plugin")]
pub use timeline::{CoatingCommands, FilmHistory};

/// Compiles the snippets of the README.
#[cfg(all(doctest, feature = "plugin"))]
#[doc = include_str!("../README.md")]
struct ReadmeDoctests;
