//! The constraints of a film, and their upkeep.
//!
//! Fracture decides which constraints there are (see [`update_constraints`](super::update_constraints)). They are kept
//! in a ledger by the half-edge that carries them. Those that anything can move lie in the packs of the packed solver,
//! the others are parked.

#[cfg(feature = "bench")]
mod bench;
mod digest;
pub(in crate::deform) mod saved;
mod validate;

use super::{
    bend::{BendConstraint, bend_points},
    curl::CurlField,
    ledger::Ledger,
    length::LengthConstraint,
    pace::{Narrowing, SolverQuality},
    packed::{
        constraints::PackedConstraints,
        level::SimdLevel,
        points::{Motion, Points},
    },
    plain::PlainConstraints,
    sleep::SleepMarks,
};
use crate::{
    film::{FaceId, FilmMesh, Geometry, HalfEdgeId, LoosePieces, Mend, Topology, VertexId},
    settings::DeformSettings,
};

/// Constraints of a film, and the state of the solvers.
///
/// A bound edge has at most one length and one bend constraint, carried by its lower half-edge; a torn edge has one
/// length constraint for each half-edge whose face is live. A vertex is attached, awake or asleep: sleep leaves out
/// what moves too little to be seen.
///
/// The order in which constraints are solved follows from the order of fracture alone. It decides later bits, so it is
/// part of the film's state: a film that is cloned goes on with the same bits.
///
/// ```
/// use bevy_coating::{
///     deform::{FilmConstraints, update_constraints},
///     film::{FilmChanges, FilmMesh, VertexId},
/// };
/// use bevy_math::Vec3;
///
/// // A square of two triangles, attached to the metal.
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
/// let mesh = FilmMesh::new(corners, &[[0, 1, 2], [0, 2, 3]])?;
/// let mut constraints = FilmConstraints::new(&mesh);
/// assert!(constraints.is_attached(VertexId(1)));
/// assert_eq!((constraints.length_count(), constraints.bend_count()), (0, 0));
///
/// // One corner separates. Its two edges keep their length, and the diagonal, which pushed it, bends.
/// let changes = FilmChanges { separated: vec![VertexId(1)], ..FilmChanges::default() };
/// update_constraints(&mesh, &mut constraints, &changes);
/// assert!(!constraints.is_attached(VertexId(1)));
/// assert_eq!((constraints.length_count(), constraints.bend_count()), (2, 1));
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component), component(clone_behavior = Ignore))]
pub struct FilmConstraints {
    ledger: Ledger,
    packed: PackedConstraints,
    plain: PlainConstraints,
    sleep: SleepMarks,
    /// Settings and quality of the last step.
    settings: Option<(DeformSettings, SolverQuality)>,
    /// Distances from free edges, on a film that is measured by its grain.
    curl: Option<Box<CurlField>>,
}

impl FilmConstraints {
    /// Makes the constraints of a fresh film: none, as all of its vertices are attached.
    pub fn new(mesh: &FilmMesh) -> Self {
        Self {
            ledger: Ledger::new(mesh.topology.half_edge_count()),
            packed: PackedConstraints::new(&mesh.geometry),
            sleep: SleepMarks::new(mesh.topology.vertex_count()),
            ..Self::default()
        }
    }

    /// Returns the number of length constraints.
    pub fn length_count(&self) -> usize {
        self.ledger.lengths().count()
    }

    /// Returns the number of bend constraints.
    pub fn bend_count(&self) -> usize {
        self.ledger.bends().count()
    }

    /// Returns the number of length and of bend constraints that sweeps visit: those at a vertex that is awake.
    pub fn active_counts(&self) -> [usize; 2] {
        self.packed.active_counts()
    }

    /// Returns the vertices that are awake.
    pub fn awake(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.packed.points().awake().map(VertexId::new)
    }

    /// Returns the number of vertices that are awake.
    pub fn awake_count(&self) -> usize {
        self.packed.points().awake_count()
    }

    /// Returns whether `v` is held by the metal, so that its inverse mass is 0.
    pub fn is_attached(&self, v: VertexId) -> bool {
        self.packed.motion(v) == Motion::Attached
    }

    /// Returns whether `v` is free but sleeps, as it moves too little to be seen.
    pub fn is_asleep(&self, v: VertexId) -> bool {
        self.packed.motion(v) == Motion::Asleep
    }

    /// Returns the length constraint that `h` carries, if any.
    pub fn length_of(&self, mesh: &FilmMesh, h: HalfEdgeId) -> Option<LengthConstraint> {
        self.ledger.lengths().has(h).then(|| LengthConstraint::of_edge(mesh, h))
    }

    /// Returns all length constraints, sorted by half-edge.
    pub fn lengths<'a>(&'a self, mesh: &'a FilmMesh) -> impl Iterator<Item = LengthConstraint> + 'a {
        self.ledger.lengths().iter().map(|h| LengthConstraint::of_edge(mesh, h))
    }

    /// Returns the bend constraint that `h` carries, if any, with its target now.
    pub fn bend_of(&self, mesh: &FilmMesh, h: HalfEdgeId) -> Option<BendConstraint> {
        self.packed.bend_of(&self.ledger, mesh, h)
    }

    /// Puts a length constraint on the edge of `h`, or on `h` alone if the edge is torn; none twice.
    pub(super) fn ensure_length(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        let topology = &mesh.topology;
        let carrier = topology.bound_twin(h).map_or(h, |twin| twin.min(h));
        if self.ledger.lengths().has(carrier) || !topology.is_live(carrier.face()) {
            return;
        }
        self.ledger.add_length(carrier);
        self.packed.unpark_length(&mut self.ledger, mesh, carrier);
    }

    /// Puts a bend constraint on the edge of `h`, starting at the current angle; none twice, and none on an
    /// edge that is torn or at the border.
    pub(super) fn ensure_bend(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        self.ensure_bend_at(mesh, h, None);
    }

    /// Puts a bend constraint on the edge of `h` as [`ensure_bend`](Self::ensure_bend) does, with the angle at which it
    /// began and its target (radians) if they are known.
    pub(super) fn ensure_bend_at(&mut self, mesh: &FilmMesh, h: HalfEdgeId, angles: Option<[f32; 2]>) {
        let Some(twin) = mesh.topology.bound_twin(h) else { return };
        let carrier = h.min(twin);
        if self.ledger.bends().has(carrier) || !mesh.topology.is_live(carrier.face()) {
            return;
        }
        self.ledger.add_bend(carrier, angles.unwrap_or_else(|| [angle_now(mesh, carrier); 2]));
        self.packed.unpark_bend(&mut self.ledger, mesh, carrier);
        // Its target is about to narrow.
        for v in bend_points(&mesh.topology, carrier) {
            self.wake(mesh, VertexId(v));
        }
    }

    /// Returns the angle at which the bend that `h` carries began, and its target, in radians. `topology` is that of
    /// the film at any time.
    pub(super) fn angles_of(&self, topology: &Topology, h: HalfEdgeId) -> Option<[f32; 2]> {
        let target = self.packed.target(&self.ledger, topology, h)?;
        Some([self.ledger.start(h), target])
    }

    /// Takes over the settings and the quality of the last step of `other`.
    pub(super) fn settings_of(&mut self, other: &Self) {
        self.settings.clone_from(&other.settings);
    }

    /// Puts all points where the film is, at rest.
    pub(super) fn place_points(&mut self, geometry: &Geometry) {
        for (v, &p) in geometry.positions.iter().enumerate() {
            self.packed.points_mut().put(v, p, p);
        }
    }

    /// Takes the length constraint off `h`.
    pub(super) fn remove_length(&mut self, topology: &Topology, h: HalfEdgeId) {
        self.packed.remove_length(&mut self.ledger, topology, h);
    }

    /// Takes the bend constraint off `h`.
    pub(super) fn remove_bend(&mut self, topology: &Topology, h: HalfEdgeId) {
        self.packed.remove_bend(&mut self.ledger, topology, h);
    }

    /// Makes the constraints that `h` carries, if any, refer to the vertices that it has now.
    pub(super) fn refresh(&mut self, topology: &Topology, h: HalfEdgeId) {
        self.packed.refresh(&mut self.ledger, topology, h);
    }

    /// Returns whether the length constraint that `h` carries, if it is in a pack, refers to the vertices that `h` has.
    pub(super) fn is_length_of(&self, topology: &Topology, h: HalfEdgeId) -> bool {
        let ends = [topology.origin(h).0, topology.target(h).0];
        let lane = self.ledger.lengths().lane(h);
        lane.is_none_or(|lane| self.packed.length_in(topology, h, lane).vertices == ends)
    }

    /// Returns whether the bend constraint that `h` carries, if it is in a pack, refers to the vertices that `h` has.
    pub(super) fn is_bend_of(&self, topology: &Topology, h: HalfEdgeId) -> bool {
        let lane = self.ledger.bends().lane(h);
        lane.is_none_or(|lane| self.packed.bend_in(topology, h, lane).vertices == bend_points(topology, h))
    }

    /// Gives up packs that are nearly empty.
    pub(super) fn compact(&mut self, topology: &Topology) {
        self.packed.compact(&mut self.ledger, topology);
    }

    /// Appends a vertex: a duplicate of `kept`.
    pub(super) fn duplicate(&mut self, kept: VertexId) {
        self.packed.points_mut().duplicate(kept.index());
        self.sleep.append(kept);
    }

    /// Frees `v`, which has separated: it is awake.
    pub(super) fn free(&mut self, v: VertexId) {
        if self.is_attached(v) {
            self.packed.points_mut().wake(v.index());
            self.sleep.mark(v, self.packed.points());
        }
    }

    /// Holds `vertices` again, where the film has them.
    pub(super) fn hold(&mut self, geometry: &Geometry, vertices: &[VertexId]) {
        let points = self.packed.points_mut();
        vertices.iter().for_each(|v| points.hold(v.index()));
        points.settle();
        for &v in vertices {
            let position = geometry.positions[v.index()];
            points.put(v.index(), position, position);
            self.sleep.forget(v, position);
        }
    }

    /// Lets the points follow a mend of the film: what has moved to another vertex goes on as it did, the metal holds
    /// what is attached now, all else at the places is awake, and vertices without faces are gone.
    pub(super) fn mend_points(&mut self, mesh: &FilmMesh, mend: &Mend, is_attached: impl Fn(VertexId) -> bool) {
        let points = self.packed.points_mut();
        mend.moved.iter().for_each(|[from, to]| points.put_like(to.index(), from.index()));
        let held: Vec<VertexId> = mend.here.iter().copied().filter(|&v| is_attached(v)).collect();
        mend.left.iter().for_each(|v| points.leave(v.index()));
        self.hold(&mesh.geometry, &held);
        for &v in &mend.left {
            self.sleep.forget(v, mesh.geometry.positions[v.index()]);
        }
        let points = self.packed.points_mut();
        for &v in mend.fresh.iter().filter(|&&v| !is_attached(v)) {
            let position = mesh.geometry.positions[v.index()];
            points.put(v.index(), position, position);
        }
        for &v in mend.here.iter().filter(|&&v| !is_attached(v)) {
            self.packed.points_mut().wake(v.index());
            self.sleep.mark(v, self.packed.points());
        }
    }

    /// Wakes `v` if it sleeps, and the constraints at it.
    pub(super) fn wake(&mut self, mesh: &FilmMesh, v: VertexId) {
        self.sleep.wake(&mut self.packed, &mut self.ledger, mesh, v);
    }

    /// Puts the constraints at `v`, which is awake, into packs.
    pub(super) fn unpark_around(&mut self, mesh: &FilmMesh, v: VertexId) {
        self.packed.unpark_around(&mut self.ledger, mesh, v);
    }

    /// Takes the corners of removed faces that have no other face off the list of what moves.
    pub(super) fn forget(&mut self, mesh: &FilmMesh, removed: &[FaceId]) {
        let (topology, points) = (&mesh.topology, self.packed.points_mut());
        for v in removed.iter().flat_map(|&f| topology.corners(f)).filter(|&v| !topology.has_faces(v)) {
            points.leave(v.index());
            self.sleep.forget(v, mesh.geometry.positions[v.index()]);
        }
        points.settle();
    }

    /// Wakes every vertex that sleeps if settings or quality are not those of the last step.
    pub(super) fn follow_settings(&mut self, mesh: &FilmMesh, settings: &DeformSettings, quality: SolverQuality) {
        if self.settings.as_ref().is_some_and(|(last, last_quality)| last == settings && *last_quality == quality) {
            return;
        }
        self.settings = Some((settings.clone(), quality));
        for v in mesh.topology.all_vertices() {
            self.wake(mesh, v);
        }
        self.packed.restart_narrowing();
    }

    /// Takes the distances from free edges, to be brought up to date.
    pub(super) fn take_curl(&mut self) -> Option<Box<CurlField>> {
        self.curl.take()
    }

    /// Puts the distances from free edges back.
    pub(super) fn put_curl(&mut self, field: Box<CurlField>) {
        self.curl = Some(field);
    }

    /// Sets the share of what the settings say by which the target at the edge `h` narrows, now or once it bends. Where
    /// it bends and may now go on, its vertices wake.
    pub(super) fn set_share(&mut self, mesh: &FilmMesh, h: HalfEdgeId, share: f32) {
        if self.packed.set_share(&mut self.ledger, &mesh.topology, h, share) {
            for v in bend_points(&mesh.topology, h) {
                self.wake(mesh, VertexId(v));
            }
        }
    }

    /// Narrows all targets.
    pub(super) fn narrow(&mut self, level: SimdLevel, by: Narrowing) {
        self.packed.narrow(level, by);
    }

    /// Sweeps over the film with the plain solver.
    pub(super) fn solve_plainly(&mut self, mesh: &mut FilmMesh, sweeps: u32) {
        self.plain.follow(mesh, &self.ledger, &self.packed);
        for _ in 0..sweeps {
            self.plain.sweep(&mut mesh.geometry);
        }
        self.packed.mark_outdated();
    }

    /// Sweeps over the film with the packed solver; `momentum` is from 0 to 1.
    pub(super) fn solve_packed(&mut self, mesh: &mut FilmMesh, level: SimdLevel, sweeps: u32, momentum: f32) {
        self.packed.solve(&mut mesh.geometry, level, sweeps, momentum);
    }

    /// Ends a tick: wakes the vertices that are disturbed, and puts those to sleep that have long been quiet. `by` is
    /// how targets narrow.
    pub(super) fn tick(&mut self, mesh: &FilmMesh, loose: &LoosePieces, by: Narrowing) {
        let by_grain = self.curl.is_some();
        self.sleep.tick(&mut self.packed, &mut self.ledger, mesh, loose, by, by_grain);
    }

    /// Returns the points of the packed solver.
    pub(super) fn points(&self) -> &Points {
        self.packed.points()
    }

    /// Returns the points of the packed solver, to be moved.
    pub(super) fn points_mut(&mut self) -> &mut Points {
        self.packed.points_mut()
    }
}

/// Returns the dihedral angle now, in radians, of the bound edge that `h` carries. A face folded to nothing has none;
/// its rest angle is what it comes from, and it is also that of a pair that has not moved.
fn angle_now(mesh: &FilmMesh, h: HalfEdgeId) -> f32 {
    let (topology, geometry) = (&mesh.topology, &mesh.geometry);
    let rest = geometry.rest_dihedrals[h.index()];
    let moved = |&v: &u32| geometry.positions[v as usize] != geometry.rest_positions[v as usize];
    if bend_points(topology, h).iter().any(moved) { geometry.dihedral(topology, h).unwrap_or(rest) } else { rest }
}
