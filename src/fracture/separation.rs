//! Separates the film from the metal where bending force exceeds adhesion (VC 5.1, eq. 4).

use super::forces::FilmForces;
use crate::{
    film::{FilmChanges, FilmMesh, Topology, VertexId},
    settings::CoatingSettings,
};

/// Returns the sum of the bending forces F_B = k T S(phi) on `v` (VC 5.1, eq. 4), in units of the initial contraction.
///
/// Each bound edge opposite `v` in a face of its one-ring exerts one: T is the contraction of that face and S the
/// [`sigmoid`](super::sigmoid) of the edge's dihedral angle at rest. Border edges and torn edges exert none. `gain` is
/// k; at its default of 1/3 a vertex of a flat film with six neighbours feels exactly T.
///
/// By [`Rules::Grain`](crate::settings::Rules::Grain) it is six times the mean of the bending forces of the one-ring,
/// as long as that is whole: then vertices with fewer neighbours, and those at open borders, feel no less.
///
/// ```
/// use bevy_coating::{
///     film::{FilmMesh, VertexId},
///     fracture::{FilmForces, bending_force},
///     settings::{CoatingSettings, Preset},
/// };
/// use bevy_math::Vec3;
///
/// // Two flat triangles: vertex 0 lies opposite the edge that they share.
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
/// let mesh = FilmMesh::new(corners, &[[0, 1, 2], [2, 1, 3]])?;
/// let settings = CoatingSettings::from(Preset::Paper);
/// let forces = FilmForces::new(&mesh, &settings, 7);
/// let force = bending_force(&mesh, &forces, VertexId(0), settings.bending.gain);
/// assert!((force - 1.0 / 6.0).abs() < 1e-6, "k T S(pi) = 1/3 * 1 * 1/2");
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
#[inline]
pub fn bending_force(mesh: &FilmMesh, forces: &FilmForces, v: VertexId, gain: f32) -> f32 {
    OneRing::new(mesh, forces, v, gain).force
}

/// Returns the age at which a vertex separates if nothing tears around it: 0 or more, or infinity if it never does.
///
/// The result is the root a of the linear equation `lift` (`contraction` + `growth` a) = `adhesion` - `decay` a.
/// `lift` is the sum of k S(phi) over the one-ring, that is the [`bending_force`] for a contraction of 1. `contraction`
/// and `adhesion` are those of the fresh film, as forces; `growth` and `decay` are what they gain and lose per unit
/// age.
///
/// ```
/// use bevy_coating::fracture::separation_age;
///
/// assert_eq!(separation_age(1.0, 1.0, 1.0, 2.0, 1.0), 0.5);
/// assert_eq!(separation_age(3.0, 1.0, 1.0, 2.0, 1.0), 0.0, "separates at once");
/// assert_eq!(separation_age(0.0, 1.0, 1.0, 2.0, 1.0), f32::INFINITY, "nothing lifts it");
/// ```
pub fn separation_age(lift: f32, contraction: f32, growth: f32, adhesion: f32, decay: f32) -> f32 {
    if lift * contraction > adhesion {
        return 0.0;
    }
    let closing = decay + lift * growth;
    if lift <= 0.0 || closing <= 0.0 { f32::INFINITY } else { (adhesion - lift * contraction) / closing }
}

/// Returns the age after which `v`, which is attached, separates if nothing tears around it: 0 if it does so at once,
/// or infinity if it never does.
///
/// Adhesion and contraction change at the rates of `settings`, and faster at a `moisture` (0 to 1) that stays as it is.
/// It is the closed form [`separation_age`] from the present forces on. Panics if the film has no such vertex.
///
/// ```
/// use bevy_coating::{
///     film::{FilmMesh, VertexId},
///     fracture::{FilmForces, age_until_separation},
///     settings::{CoatingSettings, Preset},
/// };
/// use bevy_math::Vec3;
///
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
/// let mesh = FilmMesh::new(corners, &[[0, 1, 2], [2, 1, 3]])?;
/// let settings = CoatingSettings::from(Preset::Paper);
/// let mut forces = FilmForces::new(&mesh, &settings, 7);
/// forces.set_adhesion(VertexId(0), 0.75); // the bending force there is 1/6 and grows by 1/6 an age
/// let age = age_until_separation(&mesh, &forces, VertexId(0), &settings, 0.0);
/// assert!((age - 0.5).abs() < 1e-6, "0.75 - a = 1/6 + a/6");
/// assert!(age_until_separation(&mesh, &forces, VertexId(0), &settings, 1.0) < age, "sooner where it is wet");
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn age_until_separation(
    mesh: &FilmMesh,
    forces: &FilmForces,
    v: VertexId,
    settings: &CoatingSettings,
    moisture: f32,
) -> f32 {
    let ring = OneRing::new(mesh, forces, v, settings.bending.gain);
    if ring.lift <= 0.0 {
        return f32::INFINITY;
    }
    let decay = settings.adhesion.decay * (1.0 + moisture * settings.moisture.adhesion);
    let growth = settings.tearing.contraction_growth;
    separation_age(ring.lift, ring.force / ring.lift, growth, forces.adhesion(v), decay)
}

/// Separates every attached vertex on which the sum of the bending forces exceeds its adhesion (VC 5.1, eq. 4).
///
/// A vertex that has separated never attaches again. `age` is the age of the film at the end of this step; it is stored
/// in [`FilmForces::separated_age`]. The vertices are appended to [`FilmChanges::separated`] in the order of their ids.
///
/// Only vertices whose predicted separation is due are judged. Adhesion and bending force are linear in age while
/// nothing tears, and a tear or a fall can only reduce the bending force, so a prediction can be too early but never
/// too late.
///
/// ```
/// use bevy_coating::{
///     film::{FilmChanges, FilmMesh, VertexId},
///     fracture::{FilmForces, separate},
///     settings::{CoatingSettings, Preset},
/// };
/// use bevy_math::Vec3;
///
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
/// let mesh = FilmMesh::new(corners, &[[0, 1, 2], [2, 1, 3]])?;
/// let settings = CoatingSettings::from(Preset::Paper);
/// let mut forces = FilmForces::new(&mesh, &settings, 7);
/// forces.set_adhesion(VertexId(0), 0.1); // the bending force there is 1/6
/// forces.set_adhesion(VertexId(3), 0.2);
///
/// let mut changes = FilmChanges::default();
/// separate(&mesh, &mut forces, &settings, 0.001, &mut changes);
/// assert_eq!(changes.separated, [VertexId(0)]);
/// assert_eq!(forces.separated_age[0], 0.001);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn separate(
    mesh: &FilmMesh,
    forces: &mut FilmForces,
    settings: &CoatingSettings,
    age: f32,
    changes: &mut FilmChanges,
) {
    let topology = &mesh.topology;
    forces.find_pieces(topology);
    let gain = settings.bending.gain;
    // Duplicates have separated already, so only original vertices are queued.
    let elements = topology.original_vertex_count();
    let basis = forces.predictions.separation_basis(gain, forces.gamma);
    let queue = &mut forces.predictions.separations;
    let mut due = if queue.is_valid(basis, elements) {
        queue.take_due()
    } else {
        queue.restart(basis, elements, 0..elements as u32)
    };
    due.sort_unstable();
    for &v in &due {
        let v = VertexId(v);
        if !forces.is_attached(v) || !topology.has_faces(v) {
            continue;
        }
        let ring = OneRing::new(mesh, forces, v, gain);
        if ring.force > forces.adhesion(v) {
            let_go(topology, forces, v, age, changes);
        } else {
            let steps = ring.steps_until_separation(forces, v);
            forces.predictions.separations.schedule(v.0, steps);
        }
    }
    forces.predictions.separations.give_back(due);
}

/// Separates `v` from the metal at `age`, whatever holds it. Does nothing if it has separated before.
pub(super) fn let_go(topology: &Topology, forces: &mut FilmForces, v: VertexId, age: f32, changes: &mut FilmChanges) {
    if !forces.is_attached(v) {
        return;
    }
    forces.separated_age[v.index()] = age;
    forces.separations += 1;
    forces.predictions.pieces.vertex_separated(topology, v);
    forces.make_edges_due(topology, v);
    changes.separated.push(v);
}

/// Number of faces at a vertex of a regular film.
const REGULAR: f32 = 6.0;

/// Bending forces of a one-ring on its vertex.
struct OneRing {
    /// Sum of the bending forces.
    force: f32,
    /// Sum of the bending forces for a contraction of 1 everywhere, that is the sum of k S(phi).
    lift: f32,
    /// Number of edges that exert a force.
    edges: f32,
}

impl OneRing {
    #[inline]
    fn new(mesh: &FilmMesh, forces: &FilmForces, v: VertexId, gain: f32) -> Self {
        let (mut force, mut lift, mut edges, mut inner) = (0.0, 0.0, 0.0, 0.0);
        for h in mesh.topology.fan(v) {
            let opposite = h.next();
            inner += if mesh.topology.rest_twin(opposite).is_some() { 1.0 } else { 0.0 };
            if !mesh.topology.is_torn(opposite) {
                let weight = forces.bend_weights[opposite.index()];
                force += forces.contraction(h.face()) * weight;
                lift += weight;
                edges += 1.0;
            }
        }
        // While the vertex is attached no face of its ring is gone, so the number of edges stays.
        let gain = if forces.grain().is_some() && inner > 0.0 { gain * (REGULAR / inner) } else { gain };
        Self { force: gain * force, lift: gain * lift, edges }
    }

    /// Returns the number of steps before which `v`, which holds now, cannot separate.
    ///
    /// This is the root of the linear equation of [`separation_age`]. If any vertex of the film is wet, `v` is taken to
    /// be fully wet. The error that rounding can cause is subtracted.
    fn steps_until_separation(&self, forces: &FilmForces, v: VertexId) -> f64 {
        let (lift, force, adhesion) = (f64::from(self.lift), f64::from(self.force), f64::from(forces.adhesion(v)));
        if self.lift == 0.0 || adhesion == f64::INFINITY {
            return f64::INFINITY;
        }
        let base = f64::from(forces.adhesion_drawn[v.index()].abs() + forces.adhesion_lost_wet[v.index()]);
        let rates = forces.predictions.rates;
        // Each term of a sum may be off by half the last place of the largest term, and so may each step while it is
        // wet.
        let rounding = f64::from(f32::EPSILON * (self.edges + 8.0));
        let slack = rounding * (force + lift * forces.contraction_gained + base + forces.adhesion_lost);
        let mut closing = lift * rates.contraction_growth;
        if adhesion > 0.0 {
            closing += rates.adhesion_loss;
            if rates.wet_adhesion_loss > 0.0 {
                closing += rates.wet_adhesion_loss + f64::from(f32::EPSILON) * base;
            }
        }
        let steps = (adhesion - force - slack) / (closing * (1.0 + rounding));
        // If the two forces do not approach each other, the vertex holds until the rates change.
        if closing > 0.0 { steps } else { f64::INFINITY }
    }
}
