//! The stain fields of one film and of the metal under it.

use bevy_math::Vec3;

use super::{duplicates::Duplicates, dust::DustRates, flow::Flow, sources::Catchments};
use crate::film::FilmMesh;

/// Fields of one surface: the film, one entry a vertex, duplicates included; or the metal, one entry an original
/// vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StainLayer {
    /// Wet rust, which runs off: layers, the thickness in that of a full coat of rust. 0 or more.
    pub wet: Vec<f32>,
    /// Rust that has stained the surface for good: layers. 0 or more.
    pub stained: Vec<f32>,
    /// Dust and soot (VC 6.2): 0 clean to 1 black.
    pub dust: Vec<f32>,
    /// Moisture: 0 dry to 1 wet.
    pub moisture: Vec<f32>,
    /// Surface that a vertex stands for, at rest: a third of each of its faces, in square metres. 0 once it has none.
    pub areas: Vec<f32>,
}

impl StainLayer {
    fn new(areas: Vec<f32>) -> Self {
        let clean = vec![0.0; areas.len()];
        Self { wet: clean.clone(), stained: clean.clone(), dust: clean.clone(), moisture: clean, areas }
    }

    /// Rust at vertex `i`, wet and stained: layers.
    pub fn rust(&self, i: usize) -> f32 {
        self.wet[i] + self.stained[i]
    }

    /// Duplicates all that belongs to vertex `i` to a new vertex at the end, which has no area yet.
    pub(super) fn duplicate(&mut self, i: usize) {
        self.wet.push(self.wet[i]);
        self.stained.push(self.stained[i]);
        self.dust.push(self.dust[i]);
        self.moisture.push(self.moisture[i]);
        self.areas.push(0.0);
    }
}

/// Whether rust comes out at a vertex (VC 6.1, fig. 9).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RustSource {
    /// It never has.
    #[default]
    Never,
    /// It does.
    Present,
    /// It did, but the crack has run on or the film has gone.
    Past,
}

/// Rust that has come and gone: layers times square metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RustBudget {
    /// Given off by sources so far.
    pub emitted: f64,
    /// Left the prop: dripped off, or fell with the pieces that it was on.
    pub dripped: f64,
}

/// Exposure of each original vertex to the weather, 0 to 1: what nothing shelters. Which way the surface faces is not
/// part of it. Empty: nothing shelters anything; entries that are missing or no number count as 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exposure {
    /// To rain.
    pub rain: Vec<f32>,
    /// To sunlight.
    pub sun: Vec<f32>,
}

/// All stains of one film and the metal under it (VC 6), and what their stages remember.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component))]
pub struct StainFields {
    /// Stains on the film.
    pub film: StainLayer,
    /// Stains on the metal.
    pub metal: StainLayer,
    /// How far the metal itself has rusted at each original vertex: 0 bright to 1 rusted through.
    pub corrosion: Vec<f32>,
    /// Whether each film vertex is a source of rust.
    pub sources: Vec<RustSource>,
    /// What sources have given off and what has left.
    pub budget: RustBudget,
    /// Exposure to rain and sun; written by whoever knows what stands around the prop.
    pub exposure: Exposure,
    /// Direction in which stains have run, as a mean over all that was stained so far: not of unit length. Fine
    /// streaks are drawn along it, so that they keep their direction when the prop is turned later.
    pub streaks: Vec3,
    /// Counts what can be seen, so that display follows only then.
    pub revision: u32,
    /// How open the metal lies at each original vertex: 0 under film that holds, 1 bare.
    pub(super) openness: Vec<f32>,
    /// Original vertices with any openness, in the order in which they opened.
    pub(super) open: Vec<u32>,
    pub(super) duplicates: Duplicates,
    pub(super) catchments: Catchments,
    pub(super) flow: Flow,
    pub(super) dust_rates: DustRates,
    /// Whether anything is wet or may get so.
    pub(super) damp: bool,
}

impl StainFields {
    /// Clean film and metal. `mesh` is the film at rest.
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

    /// Whether anything is wet: effects of moisture need to be looked at only then.
    pub fn is_damp(&self) -> bool {
        self.damp
    }
}
