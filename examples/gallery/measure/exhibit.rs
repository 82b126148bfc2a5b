//! A film that is shown: on what it lies, its settings, and what is done to it before it ages.

use std::path::Path;

use bevy_coating::{
    bake::{BakeError, Images, Input},
    deform::FilmConstraints,
    film::{FilmMesh, HalfEdgeId, VertexId},
    fracture::FilmForces,
    remesh::{FilmTarget, build_film, sample},
    settings::{CoatingSettings, Preset},
    sim::{FilmMeasures, FilmState},
    stain::Environment,
    surface::{BuildError, Surface},
};
use bevy_math::Vec3;

use super::{
    painted::{self, Stroke},
    solid,
};

/// On what a film lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The paper's square plate, of exactly so many triangles; one metre wide, facing +z.
    Plate(u32),
    /// The paper's curved plate, a quarter of a cylinder.
    CurvedPlate(u32),
    /// The paper's disk, of radius 1.
    Disk(u32),
    /// A vase, a metre high.
    Vase(u32),
    /// A toothed wheel, a metre across.
    Wheel(u32),
    /// The plate of a street sign, from a file.
    Sign(u32),
    /// A fire hydrant, about a metre high: a closed model from a file.
    Hydrant(u32),
}

/// Reason why there is no film.
#[derive(Debug, thiserror::Error)]
pub enum NoFilm {
    #[error(transparent)]
    Build(#[from] BuildError),
    #[error(transparent)]
    Read(#[from] BakeError),
    #[error("the model has no such mesh")]
    NoMesh,
    #[error("the triangles are no manifold")]
    NoManifold,
}

impl Shape {
    /// Returns the surface, with a position and a normal for every corner.
    ///
    /// # Errors
    /// [`NoFilm`] if a file cannot be read.
    pub fn surface(self, seed: u64) -> Result<Surface, NoFilm> {
        Ok(match self {
            Self::Plate(n) => unshared(&sample::plate(n, seed)?.surface),
            Self::CurvedPlate(n) => unshared(&sample::curved_plate(n, seed)?.surface),
            Self::Disk(n) => unshared(&sample::disk(n, seed)?.surface),
            Self::Vase(_) => solid::vase(),
            Self::Wheel(_) => solid::wheel(),
            Self::Sign(_) => read("city/street_sign.glb", "plate", 1.0)?,
            Self::Hydrant(_) => read("props/prop_firehydrant.glb", "", 4.2)?,
        })
    }

    /// Returns to what the surface is remeshed: test pieces stay as they are.
    pub fn target(self) -> FilmTarget {
        match self {
            Self::Plate(_) | Self::CurvedPlate(_) | Self::Disk(_) => FilmTarget::Keep,
            Self::Vase(n) | Self::Wheel(n) | Self::Sign(n) | Self::Hydrant(n) => FilmTarget::Triangles(n),
        }
    }
}

/// Returns the same triangles, no two of which share a vertex, as those of a mesh that is drawn.
fn unshared(surface: &Surface) -> Surface {
    let corners = || surface.triangles.iter().flatten().map(|&v| v as usize);
    Surface {
        positions: corners().map(|v| surface.positions[v]).collect(),
        triangles: (0..surface.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        slots: Vec::new(),
        ..surface.clone()
    }
}

/// Reads the mesh of a model whose name begins with `name`, enlarged by `scale` and with its middle at the origin.
fn read(file: &str, name: &str, scale: f32) -> Result<Surface, NoFilm> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets").join(file);
    let model = Input::File(path).read(0, Images::Skip)?;
    let found = model.meshes.into_iter().find(|mesh| mesh.name.starts_with(name));
    let surface = unshared(&found.ok_or(NoFilm::NoMesh)?.surface);
    let low = surface.positions.iter().copied().reduce(Vec3::min).unwrap_or_default();
    let high = surface.positions.iter().copied().reduce(Vec3::max).unwrap_or_default();
    let positions = surface.positions.iter().map(|&p| scale * (p - 0.5 * (low + high))).collect();
    Ok(Surface { positions, tangents: Vec::new(), colors: Vec::new(), uvs_1: Vec::new(), ..surface })
}

/// What is done to a fresh film before it ages.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Beginning {
    /// Nothing.
    #[default]
    Fresh,
    /// Chains of edges tear in the first step, from place to place.
    Cracked(Vec<[Vec3; 2]>),
    /// The adhesion is painted.
    Painted(Vec<Stroke>),
    /// There is no metal under the film, only free space.
    Free,
}

impl Beginning {
    /// Does it to a fresh film.
    pub fn begin(&self, mesh: &mut FilmMesh, forces: &mut FilmForces, constraints: &mut FilmConstraints) {
        match self {
            Self::Fresh => {}
            Self::Cracked(cracks) => cracks.iter().for_each(|&[from, to]| weaken_chain(mesh, forces, from, to)),
            Self::Painted(strokes) => painted::paint(mesh, forces, strokes),
            Self::Free => {
                // A plane without a direction keeps nothing above it.
                mesh.geometry.rest_normals.fill(Vec3::ZERO);
                *constraints = FilmConstraints::new(mesh);
            }
        }
    }
}

fn nearest(mesh: &FilmMesh, place: Vec3) -> VertexId {
    let distance = |v: &VertexId| mesh.geometry.rest_positions[v.index()].distance_squared(place);
    let nearest = mesh.topology.all_vertices().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    nearest.unwrap_or(VertexId(0))
}

/// Takes the binding of a chain of edges from about `from` to about `to`, so that they tear in the next step.
pub fn weaken_chain(mesh: &FilmMesh, forces: &mut FilmForces, from: Vec3, to: Vec3) {
    let (mut v, end) = (nearest(mesh, from), nearest(mesh, to));
    let goal = mesh.geometry.rest_positions[end.index()];
    let topology = &mesh.topology;
    while v != end {
        let distance = |h: &HalfEdgeId| mesh.geometry.rest_positions[topology.target(*h).index()].distance(goal);
        let around = topology.fan(v).flat_map(|h| [Some(h), topology.bound_twin(h.previous())]).flatten();
        let Some(h) = around.min_by(|a, b| distance(a).total_cmp(&distance(b))) else { return };
        forces.set_binding(topology, h, 0.0);
        v = topology.target(h);
    }
}

/// A film that is shown.
#[derive(Clone, Debug)]
pub struct Exhibit {
    /// Of its files.
    pub name: &'static str,
    /// What is written below it.
    pub title: String,
    pub shape: Shape,
    pub settings: CoatingSettings,
    pub seed: u64,
    pub beginning: Beginning,
}

impl Exhibit {
    pub fn new(name: &'static str, title: impl Into<String>, shape: Shape, settings: CoatingSettings) -> Self {
        Self { name, title: title.into(), shape, settings, seed: 7, beginning: Beginning::Fresh }
    }

    /// Returns its film before it ages, with steps of 1 / `steps_per_age`.
    ///
    /// # Errors
    /// [`NoFilm`] if there is none.
    pub fn film(&self, steps_per_age: u32) -> Result<FilmState, NoFilm> {
        let built = build_film(&self.shape.surface(self.seed)?, self.shape.target(), self.seed)?;
        let mut film = FilmState::new(&built, &self.settings, self.seed, steps_per_age).ok_or(NoFilm::NoManifold)?;
        self.beginning.begin(&mut film.mesh, &mut film.forces, &mut film.constraints);
        Ok(film)
    }
}

impl Exhibit {
    /// Ages its film in 1,000 steps for an age, as the plugin does, and measures it at each of `ages`, which rise.
    ///
    /// # Errors
    /// [`NoFilm`] if there is none.
    pub fn measured(&self, ages: &[f64]) -> Result<Vec<FilmMeasures>, NoFilm> {
        let mut film = self.film(1000)?;
        let at = |age: &f64| {
            film.age_to(*age, &self.settings, &Environment::default());
            film.measure()
        };
        Ok(ages.iter().map(at).collect())
    }
}

/// Returns the paper's settings, without stains.
pub fn paper() -> CoatingSettings {
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.dust.rate = 0.0;
    settings.rust.emission = 0.0;
    settings
}

/// Returns settings under which the film lets go at once and does nothing more by itself.
pub fn held() -> CoatingSettings {
    let mut settings = CoatingSettings::from(Preset::Paper);
    (settings.adhesion.mean, settings.adhesion.deviation) = (0.0, 0.0);
    settings.tearing.binding = 1e6;
    settings.tearing.weak_probability = 0.0;
    settings.tearing.contraction_growth = 0.0;
    settings.deform.sweeps_per_age = 0.0;
    settings
}
