//! Holds all stains of one film and of the metal under it.

use bevy_math::Vec3;

use super::{
    catchments::Catchments, duplicates::Duplicates, dust::rates::DustRates, flow::Flow, layer::StainLayer,
    places::Places, shown::Shown,
};
use crate::film::FilmMesh;

/// State of a vertex as a source of rust (VC 6.1, fig. 9).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RustSource {
    /// No rust has come out here so far.
    #[default]
    Never,
    /// Rust comes out here.
    Present,
    /// Rust came out here until the crack ran on or the film fell off.
    Past,
}

/// Amounts of rust that have entered and left one film and its metal, in layers times square metres.
///
/// `emitted` is always the sum of `dripped` and of the rust that is still on film and metal
/// ([`StainFields::wet_amount`] and [`StainFields::stained_amount`]), but for rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RustBudget {
    /// Rust that the sources have given off so far.
    pub emitted: f64,
    /// Rust that has left the prop so far: it dripped off, or it fell with the pieces that it was on.
    pub dripped: f64,
}

/// Exposure of each original vertex to rain and sunlight: the share of them that nothing holds off, from 0 (sheltered)
/// to 1 (exposed).
///
/// It does not count which way the surface faces. An empty field means that everything is exposed; a missing entry or
/// one that is not finite counts as 1. [`exposure_of`](super::exposure::exposure_of) computes it without an engine.
///
/// ```
/// use bevy_coating::stain::Exposure;
///
/// let shed = Exposure { rain: vec![1.0, 0.5, 0.0], ..Exposure::default() };
/// assert!(shed.sun.is_empty(), "the sun reaches every vertex");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exposure {
    /// Share of the rain that reaches each original vertex.
    pub rain: Vec<f32>,
    /// Share of the sunlight that reaches each original vertex.
    pub sun: Vec<f32>,
}

/// All stains of one film and of the metal under it (VC 6).
///
/// ```
/// use bevy_coating::{
///     film::FilmMesh,
///     stain::{RustSource, StainFields},
/// };
/// use bevy_math::Vec3;
///
/// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
/// let stains = StainFields::new(&mesh);
/// assert_eq!(stains.film.dust, [0.0; 3]);
/// assert_eq!(stains.sources, [RustSource::Never; 3]);
/// assert_eq!(stains.wet_amount() + stains.stained_amount(), 0.0);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component), component(clone_behavior = Ignore))]
pub struct StainFields {
    /// Stains on the film: one entry for each film vertex, duplicates included.
    pub film: StainLayer,
    /// Stains on the metal: one entry for each original vertex.
    pub metal: StainLayer,
    /// Corrosion of the metal itself at each original vertex: from 0 (bright) to 1 (fully rusted).
    pub corrosion: Vec<f32>,
    /// State of each film vertex as a source of rust.
    pub sources: Vec<RustSource>,
    /// Rust that the sources have given off and that has left the prop.
    pub budget: RustBudget,
    /// Exposure to rain and sunlight. The default, empty, means that everything is exposed. It is an input, written by
    /// the plugin or the caller, who know what stands around the prop.
    pub exposure: Exposure,
    /// Direction in which stains have run: the sum of the pulls' unit vectors, each times the rust that it stained
    /// (layers times square metres), so not of unit length. Display draws fine streaks along it; they keep their
    /// direction when the prop is turned later.
    pub streaks: Vec3,
    /// Counter that changes whenever stains look different, so that display needs to follow only then: something tore
    /// or came off, or a value that is shown, from 0 to 1, has changed by more than 1/255 since it last came to count.
    pub revision: u32,
    /// Stains as they were when the revision last changed.
    pub(super) shown: Shown,
    /// Openness of the metal at each original vertex: from 0 (under film that holds) to 1 (bare).
    pub(super) openness: Vec<f32>,
    /// Original vertices with an openness above 0, in the order in which they opened.
    pub(super) open: Vec<u32>,
    /// Film vertices of each original vertex.
    pub(super) duplicates: Duplicates,
    /// Lengths of the cracks that drain to each place.
    pub(super) catchments: Catchments,
    /// Ways of run-off.
    pub(super) flow: Flow,
    /// Rates at which dust settles.
    pub(super) dust_rates: DustRates,
    /// Whether anything is wet or rain falls.
    pub(super) damp: bool,
    /// Buffer of the places where something tore or came off; empty between steps.
    pub(super) places: Places,
}

impl StainFields {
    /// Creates the stains of a clean film on clean metal. `mesh` must be a fresh film, on which nothing has torn yet.
    ///
    /// ```
    /// use bevy_coating::{film::FilmMesh, stain::StainFields};
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X * 3.0, Vec3::Y * 2.0], &[[0, 1, 2]])?;
    /// let stains = StainFields::new(&mesh);
    /// assert_eq!(stains.film.areas, [1.0; 3], "each vertex stands for a third of its face");
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn new(mesh: &FilmMesh) -> Self {
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        let vertices = topology.vertex_count();
        let mut areas = vec![0.0; vertices];
        for f in topology.all_faces() {
            let third = geometry.rest_area_of(topology, f) / 3.0;
            for v in topology.corners(f) {
                areas[v.index()] += third;
            }
        }
        Self {
            film: StainLayer::new(areas.clone()),
            metal: StainLayer::new(areas),
            corrosion: vec![0.0; vertices],
            sources: vec![RustSource::Never; vertices],
            openness: vec![0.0; vertices],
            duplicates: Duplicates::new(topology),
            catchments: Catchments::new(vertices),
            flow: Flow::new(vertices),
            ..Self::default()
        }
    }

    /// Returns whether anything is wet or rain falls. While it is false, all moisture is 0 and no stage need consider
    /// it.
    pub fn is_damp(&self) -> bool {
        self.damp
    }

    /// Counts stains as changed if they look different from when they last did.
    pub(super) fn revise_if_seen(&mut self) {
        if self.shown.differs(&self.film, &self.metal, &self.corrosion, self.streaks) {
            self.revision = self.revision.wrapping_add(1);
            self.shown.note(&self.film, &self.metal, &self.corrosion, self.streaks);
        }
    }

    /// Returns the amount of wet rust on film and metal, in layers times square metres.
    pub fn wet_amount(&self) -> f64 {
        amount(&self.film.areas, &self.film.wet) + amount(&self.metal.areas, &self.metal.wet)
    }

    /// Returns the amount of rust that has stained film and metal, in layers times square metres.
    pub fn stained_amount(&self) -> f64 {
        amount(&self.film.areas, &self.film.stained) + amount(&self.metal.areas, &self.metal.stained)
    }
}

/// Returns the sum of area times layers over all vertices.
fn amount(areas: &[f32], layers: &[f32]) -> f64 {
    areas.iter().zip(layers).map(|(&area, &layers)| f64::from(area) * f64::from(layers)).sum()
}
