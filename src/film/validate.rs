//! Checks every invariant of a film's connectivity and geometry.

use super::{
    handles::{FaceId, HalfEdgeId, VertexId},
    mesh::FilmMesh,
    topology::FaceFate,
};

/// A broken invariant: a bug, never the user's doing.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InvariantError {
    /// A per-element array does not have one entry an element.
    #[error("array {0} has the wrong length")]
    ArrayLength(&'static str),
    /// Twins do not point at each other.
    #[error("half-edge {0:?} is not its twin's twin")]
    Twin(HalfEdgeId),
    /// The torn flag differs between twins, or a border half-edge is torn.
    #[error("half-edge {0:?} is torn on one side only")]
    TornOneSided(HalfEdgeId),
    /// Bound twins run between different vertices.
    #[error("half-edge {0:?} and its bound twin have different ends")]
    BoundEnds(HalfEdgeId),
    /// A bound half-edge leads to a removed face.
    #[error("half-edge {0:?} of a live face is bound to a removed one")]
    BoundToRemoved(HalfEdgeId),
    /// A stripped face is still bound to another.
    #[error("stripped face {0:?} has a bound inner edge")]
    StrippedBound(FaceId),
    /// The faces of a vertex are not one fan, or the fan does not start where it is open.
    #[error("the live faces at vertex {0:?} are not one fan")]
    NotOneFan(VertexId),
    /// A duplicate is not marked as border, or its original is no original.
    #[error("vertex {0:?} is no proper duplicate")]
    Duplicate(VertexId),
    /// A position is NaN or infinite.
    #[error("vertex {0:?} is not finite")]
    NonFinite(VertexId),
    /// An attached vertex has moved.
    #[error("attached vertex {0:?} has moved")]
    AttachedMoved(VertexId),
    /// A vertex lies below the plane of its rest position.
    #[error("vertex {0:?} lies below its plane")]
    BelowPlane(VertexId),
    /// An end of a torn edge is attached.
    #[error("torn half-edge {0:?} has an attached end")]
    TornAttached(HalfEdgeId),
    /// A crack tip does not have exactly one torn edge.
    #[error("crack tip {0:?} does not have exactly one torn edge")]
    Tip(VertexId),
    /// The binding of an edge decays for more or fewer faces than have a torn edge.
    #[error("the binding of half-edge {0:?} decays at the wrong rate")]
    Decay(HalfEdgeId),
    /// What is known of connected pieces is not what a look at the whole film finds.
    #[error("the connected pieces of the film are not those that are known")]
    Pieces,
    /// The inverse mass of a vertex does not agree with whether it is attached.
    #[error("vertex {0:?} has the wrong inverse mass")]
    InverseMass(VertexId),
    /// A stain is negative, above its range or not finite.
    #[error("stain {0} of vertex {1:?} is out of range")]
    Stain(&'static str, VertexId),
    /// Rust given off is not what is wet, has stained or has left.
    #[error("{emitted} of rust was given off, but {found} is accounted for")]
    RustBudget {
        /// Given off.
        emitted: f64,
        /// Wet, stained and dripped.
        found: f64,
    },
    /// The solver has a vertex in another place than the film.
    #[error("vertex {0:?} is elsewhere in the solver")]
    PointElsewhere(VertexId),
    /// Two constraints of a pack share a vertex.
    #[error("two constraints of a pack share vertex {0:?}")]
    SharedPoint(VertexId),
    /// A constraint is missing, doubled or refers to the wrong vertices.
    #[error("constraint of half-edge {0:?} is wrong")]
    Constraint(HalfEdgeId),
}

impl FilmMesh {
    /// Checks the invariants of connectivity and geometry that hold between any two edits. Takes time
    /// proportional to the film's size; meant for tests and debugging.
    ///
    /// # Errors
    /// The first [`InvariantError`] found, in handle order.
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
            // An open fan must be seen whole from its first half-edge.
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
