//! Checks the invariants of a film's connectivity and geometry.

use super::{
    handles::{FaceId, HalfEdgeId, VertexId},
    mesh::FilmMesh,
    topology::FaceFate,
};

/// Invariant of a film that does not hold. This is a bug of this crate, never a fault of the user.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvariantError {
    /// A flat array does not have one entry for each element. Holds the name of the array.
    #[error("array {0} has the wrong length")]
    ArrayLength(&'static str),
    /// The twin of a half-edge has another twin.
    #[error("half-edge {0:?} is not its twin's twin")]
    Twin(HalfEdgeId),
    /// Only one of two twins is marked as torn, or a half-edge on the border is.
    #[error("half-edge {0:?} is torn on one side only")]
    TornOneSided(HalfEdgeId),
    /// Two bound twins do not run between the same two vertices.
    #[error("half-edge {0:?} and its bound twin have different ends")]
    BoundEnds(HalfEdgeId),
    /// A half-edge of a live face is bound to a removed face.
    #[error("half-edge {0:?} of a live face is bound to a removed one")]
    BoundToRemoved(HalfEdgeId),
    /// A stripped face is still bound to another face.
    #[error("stripped face {0:?} has a bound inner edge")]
    StrippedBound(FaceId),
    /// The faces of a vertex do not form one fan, or the fan is open but does not start at its clockwise end.
    #[error("the live faces at vertex {0:?} are not one fan")]
    NotOneFan(VertexId),
    /// A duplicate is not marked as a border vertex, or is the duplicate of another duplicate.
    #[error("vertex {0:?} is no proper duplicate")]
    Duplicate(VertexId),
    /// A position of the vertex, at rest or now, is NaN or infinite.
    #[error("vertex {0:?} is not finite")]
    NonFinite(VertexId),
    /// An attached vertex has moved.
    #[error("attached vertex {0:?} has moved")]
    AttachedMoved(VertexId),
    /// A vertex lies below the plane through its rest position and perpendicular to its rest normal.
    #[error("vertex {0:?} lies below its plane")]
    BelowPlane(VertexId),
    /// An end of a torn edge is attached.
    #[error("torn half-edge {0:?} has an attached end")]
    TornAttached(HalfEdgeId),
    /// A crack tip does not have exactly one torn edge.
    #[error("crack tip {0:?} does not have exactly one torn edge")]
    Tip(VertexId),
    /// The binding of an edge does not decay once for each of its faces that has a torn edge (VC 5.2).
    #[error("the binding of half-edge {0:?} decays at the wrong rate")]
    Decay(HalfEdgeId),
    /// The recorded pieces of the film differ from those that a search of the whole film finds.
    #[error("the connected pieces of the film are not those that are known")]
    Pieces,
    /// The inverse mass of a vertex does not agree with whether it is attached.
    #[error("vertex {0:?} has the wrong inverse mass")]
    InverseMass(VertexId),
    /// A stain is negative, above its range or not finite. Holds the name of the stain.
    #[error("stain {0} of vertex {1:?} is out of range")]
    Stain(&'static str, VertexId),
    /// The rust that sources gave off differs from the rust that is wet, has stained or has dripped off.
    #[error("{emitted} of rust was given off, but {found} is accounted for")]
    RustBudget {
        /// Rust given off in all.
        emitted: f64,
        /// Rust that is wet, has stained and has dripped off, together.
        found: f64,
    },
    /// The solver and the film have different positions for a vertex.
    #[error("vertex {0:?} is elsewhere in the solver")]
    PointElsewhere(VertexId),
    /// Two constraints of one pack share a vertex, though a pack is solved all at once.
    #[error("two constraints of a pack share vertex {0:?}")]
    SharedPoint(VertexId),
    /// A constraint of a half-edge is missing, is there twice or refers to the wrong vertices.
    #[error("constraint of half-edge {0:?} is wrong")]
    Constraint(HalfEdgeId),
}

impl FilmMesh {
    /// Checks the invariants of connectivity and geometry that hold between any two edits.
    ///
    /// It takes time proportional to the size of the film and is meant for tests and debugging.
    ///
    /// # Errors
    /// [`InvariantError`]: the first one that is found. Arrays are checked first, then half-edges, then vertices.
    ///
    /// ```
    /// use bevy_coating::film::{FilmMesh, InvariantError, VertexId};
    /// use bevy_math::Vec3;
    ///
    /// let mut film = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// assert_eq!(film.validate(), Ok(()));
    /// film.geometry.positions[1].x = f32::NAN;
    /// assert_eq!(film.validate(), Err(InvariantError::NonFinite(VertexId(1))));
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn validate(&self) -> Result<(), InvariantError> {
        self.check_lengths()?;
        self.check_half_edges()?;
        self.check_vertices()
    }

    fn check_lengths(&self) -> Result<(), InvariantError> {
        let (t, g) = (&self.topology, &self.geometry);
        let (vertices, half_edges) = (t.vertex_count(), t.half_edge_count());
        for (name, found, expected) in [
            ("twins", t.twins.len(), half_edges),
            ("torn", t.torn.len(), half_edges),
            ("fates", t.fates.len() * 3, half_edges),
            ("originals", t.originals.len(), vertices),
            ("border", t.border.len(), vertices),
            ("rest_positions", g.rest_positions.len(), vertices),
            ("rest_normals", g.rest_normals.len(), vertices),
            ("positions", g.positions.len(), vertices),
            ("rest_lengths", g.rest_lengths.len(), half_edges),
            ("rest_dihedrals", g.rest_dihedrals.len(), half_edges),
        ] {
            if found != expected {
                return Err(InvariantError::ArrayLength(name));
            }
        }
        Ok(())
    }

    fn check_half_edges(&self) -> Result<(), InvariantError> {
        let t = &self.topology;
        for h in t.all_half_edges() {
            let Some(twin) = t.rest_twin(h) else {
                if t.is_torn(h) {
                    return Err(InvariantError::TornOneSided(h));
                }
                continue;
            };
            if t.rest_twin(twin) != Some(h) {
                return Err(InvariantError::Twin(h));
            }
            if t.is_torn(h) != t.is_torn(twin) {
                return Err(InvariantError::TornOneSided(h));
            }
            if t.is_torn(h) {
                continue;
            }
            if t.origin(h) != t.target(twin) || t.target(h) != t.origin(twin) {
                return Err(InvariantError::BoundEnds(h));
            }
            match t.fate(h.face()) {
                FaceFate::Live if !t.is_live(twin.face()) => return Err(InvariantError::BoundToRemoved(h)),
                FaceFate::Stripped => return Err(InvariantError::StrippedBound(h.face())),
                _ => {}
            }
        }
        Ok(())
    }

    fn check_vertices(&self) -> Result<(), InvariantError> {
        let (t, g) = (&self.topology, &self.geometry);
        let mut corners = vec![0usize; t.vertex_count()];
        for f in t.live_faces() {
            for v in t.corners(f) {
                corners[v.index()] += 1;
            }
        }
        for v in t.all_vertices() {
            let in_fan = t.fan(v).count();
            let own = t.fan(v).all(|h| t.origin(h) == v && t.is_live(h.face()));
            // A walk that starts in the middle of an open fan misses faces.
            if in_fan != corners[v.index()] || !own {
                return Err(InvariantError::NotOneFan(v));
            }
            let original = t.original(v);
            let is_original = v.index() < t.original_vertex_count();
            let proper = if is_original {
                original == v
            } else {
                original.index() < t.original_vertex_count() && t.is_border(v)
            };
            if !proper {
                return Err(InvariantError::Duplicate(v));
            }
            if !g.positions[v.index()].is_finite() || !g.rest_positions[v.index()].is_finite() {
                return Err(InvariantError::NonFinite(v));
            }
        }
        Ok(())
    }
}
