//! The solve of a step (VC 4.1): targets narrow, then sweeps, then loose pieces go back to their place.

use bevy_math::Vec3;

use super::{
    constraints::FilmConstraints,
    pace::{Narrowing, SolvePace, SolverQuality},
    packed::level::SimdLevel,
    rigid,
};
use crate::{
    film::{FilmChanges, FilmMesh, LoosePieces},
    settings::DeformSettings,
};

/// Buffers and instruction set of the solver: what it keeps between steps that is no part of the film.
///
/// ```
/// use bevy_coating::deform::{BendScratch, SimdLevel};
///
/// // The same bits as with any other instruction set, but slower.
/// let mut scratch = BendScratch::default();
/// scratch.level = SimdLevel::Scalar;
/// ```
#[derive(Clone, Debug, Default)]
pub struct BendScratch {
    /// Instruction set of the packed solver. Default: the best that this CPU has.
    pub level: SimdLevel,
    before: Vec<Vec3>,
}

/// Bends the film for one step: targets narrow, then bends and lengths are solved in sweeps (VC 4), then loose pieces
/// are put back in their place.
///
/// Writes the positions of `mesh`, and sets [`FilmChanges::moved`] if any may have moved. Where no vertex is awake
/// nothing is done. A change of `settings` or quality wakes every vertex that sleeps.
///
/// ```
/// use bevy_coating::{
///     deform::{BendScratch, FilmConstraints, SolvePace, SolverQuality, bend_film, update_constraints},
///     film::{FilmChanges, FilmMesh, LoosePieces, VertexId},
///     settings::DeformSettings,
/// };
/// use bevy_math::Vec3;
///
/// // A square of two triangles, one corner of which separates.
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
/// let mut mesh = FilmMesh::new(corners, &[[0, 1, 2], [0, 2, 3]])?;
/// let mut constraints = FilmConstraints::new(&mesh);
/// let mut changes = FilmChanges { separated: vec![VertexId(1)], ..FilmChanges::default() };
/// update_constraints(&mesh, &mut constraints, &changes);
///
/// let (settings, loose) = (DeformSettings::default(), LoosePieces::default());
/// let mut scratch = BendScratch::default();
/// for step in 1..=100 {
///     let pace = SolvePace::of_step(settings.sweeps_per_age, SolverQuality::High, (step, 1000), false);
///     bend_film(&mut mesh, &mut constraints, &loose, &settings, pace, &mut changes, &mut scratch);
/// }
/// assert!(changes.moved && mesh.geometry.height(VertexId(1)) > 0.0);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn bend_film(
    mesh: &mut FilmMesh,
    constraints: &mut FilmConstraints,
    loose: &LoosePieces,
    settings: &DeformSettings,
    pace: SolvePace,
    changes: &mut FilmChanges,
    scratch: &mut BendScratch,
) {
    constraints.follow_settings(mesh, settings, pace.quality);
    if constraints.awake_count() == 0 {
        return;
    }
    let is_plain = pace.quality == SolverQuality::Reference;
    let narrowing = Narrowing { step: settings.narrowing_rate * pace.dt, limit: settings.bend_limit };
    constraints.narrow(scratch.level, narrowing);
    if pace.sweeps > 0 {
        changes.moved = true;
        rigid::remember(&mesh.geometry.positions, loose, constraints.points(), &mut scratch.before);
        if is_plain {
            constraints.solve_plainly(mesh, pace.sweeps);
        } else {
            constraints.solve_packed(mesh, scratch.level, pace.sweeps, pace.momentum);
        }
        rigid::put_back(&mut mesh.geometry, loose, constraints.points_mut(), &scratch.before);
    }
    if pace.tick && !is_plain {
        constraints.tick(mesh, loose, narrowing);
    }
}
