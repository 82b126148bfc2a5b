//! Checks the invariants of a whole film.

use super::state::FilmState;
use crate::film::{InvariantError, VertexId};

/// Depth below its plane that a vertex may have, in mean edges.
const PLANE_TOLERANCE: f32 = 1e-5;
/// Depth that is added to [`PLANE_TOLERANCE`], relative to the largest coordinate: rounding counts where a film is far
/// from its origin.
const PLANE_ROUNDING: f32 = 8.0 * f32::EPSILON;

impl FilmState {
    /// Checks every invariant of the film, its forces, its constraints and its stains. For tests and debugging: takes
    /// time proportional to the size of the film.
    ///
    /// - The live faces of every vertex are one fan, and twins share their ends.
    /// - Both ends of a torn edge have separated, but where new paint ends.
    /// - An attached vertex has not moved, and no vertex lies below the plane of its rest position.
    /// - A stripped face is bound to no other, and a crack tip has exactly one torn edge.
    /// - Predictions, connected pieces, constraints and the rust budget agree with the film.
    ///
    /// # Errors
    /// The first [`InvariantError`] found.
    ///
    /// ```
    /// use bevy_coating::{
    ///     film::{InvariantError, VertexId},
    ///     remesh::sample,
    ///     settings::CoatingSettings,
    ///     sim::FilmState,
    /// };
    ///
    /// let piece = sample::plate(100, 7)?;
    /// let mut film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
    /// assert_eq!(film.validate(), Ok(()));
    /// film.mesh.geometry.positions[0].z += 0.1;
    /// assert_eq!(film.validate(), Err(InvariantError::AttachedMoved(VertexId(0))));
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn validate(&self) -> Result<(), InvariantError> {
        self.mesh.validate()?;
        let (topology, geometry, forces) = (&self.mesh.topology, &self.mesh.geometry, &self.forces);
        forces.validate(topology)?;
        for v in topology.all_vertices() {
            let moved = geometry.positions[v.index()] != geometry.rest_positions[v.index()];
            if forces.is_attached(v) && moved {
                return Err(InvariantError::AttachedMoved(v));
            }
            let rounding = PLANE_ROUNDING * geometry.rest_positions[v.index()].abs().max_element();
            if geometry.height(v) < -PLANE_TOLERANCE * geometry.mean_edge - rounding {
                return Err(InvariantError::BelowPlane(v));
            }
            if forces.tip(v).is_some() && !self.is_tip(v) {
                return Err(InvariantError::Tip(v));
            }
        }
        for h in topology.all_half_edges().filter(|&h| topology.is_torn(h)) {
            let holds = |v: VertexId| forces.is_attached(v) && !forces.is_rebound(v);
            if holds(topology.origin(h)) || holds(topology.target(h)) {
                return Err(InvariantError::TornAttached(h));
            }
        }
        self.constraints.validate(&self.mesh, |v| forces.is_attached(v))?;
        self.stains.validate(&self.mesh)
    }

    /// Returns whether `v` lies inside the film and has exactly one torn edge: its open fan begins and ends at that
    /// edge.
    fn is_tip(&self, v: VertexId) -> bool {
        let topology = &self.mesh.topology;
        let torn = topology
            .fan(v)
            .map(|h| u32::from(topology.is_torn(h)) + u32::from(topology.is_torn(h.previous())))
            .sum::<u32>();
        let ends_meet = topology
            .fan(v)
            .last()
            .zip(topology.fan(v).next())
            .is_some_and(|(last, first)| topology.rest_twin(first) == Some(last.previous()));
        !topology.is_border(v) && torn == 2 && ends_meet
    }
}
