//! Checks the invariants of stains.

use super::{
    fields::{RustSource, StainFields},
    layer::StainLayer,
};
use crate::film::{FilmMesh, InvariantError, VertexId};

/// Error of the rust budget that rounding may cause, as a share of the rust that was given off.
const ROUNDING: f64 = 1e-3;

impl StainFields {
    /// Checks the stains against the film that they belong to. For tests and debugging: takes time proportional to the
    /// size of the film.
    ///
    /// # Errors
    /// - [`InvariantError::ArrayLength`] if a field does not have one entry for each vertex.
    /// - [`InvariantError::Stain`] if a stain is out of its range or not finite, or if rust comes out at a vertex that
    ///   has no faces.
    /// - [`InvariantError::RustBudget`] if the rust given off is not the rust that is wet, has stained or has left.
    ///
    /// ```
    /// use bevy_coating::{film::FilmMesh, stain::StainFields};
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let mut stains = StainFields::new(&mesh);
    /// assert!(stains.validate(&mesh).is_ok());
    /// stains.film.dust[0] = 1.5;
    /// assert_eq!(stains.validate(&mesh).unwrap_err().to_string(), "stain dust of vertex VertexId(0) is out of range");
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn validate(&self, mesh: &FilmMesh) -> Result<(), InvariantError> {
        let (vertices, originals) = (mesh.topology.vertex_count(), mesh.topology.original_vertex_count());
        check_layer(&self.film, vertices)?;
        check_layer(&self.metal, originals)?;
        if [self.sources.len(), self.duplicates.len()] != [vertices; 2] {
            return Err(InvariantError::ArrayLength("sources"));
        }
        if [self.corrosion.len(), self.openness.len()] != [originals; 2] {
            return Err(InvariantError::ArrayLength("corrosion"));
        }
        check_range("corrosion", &self.corrosion, 1.0)?;
        for v in mesh.topology.all_vertices() {
            if self.sources[v.index()] == RustSource::Present && !mesh.topology.has_faces(v) {
                return Err(InvariantError::Stain("source", v));
            }
        }
        let found = self.wet_amount() + self.stained_amount() + self.budget.dripped;
        if !((found - self.budget.emitted).abs() <= ROUNDING * self.budget.emitted) {
            return Err(InvariantError::RustBudget { emitted: self.budget.emitted, found });
        }
        Ok(())
    }
}

/// Checks that `layer` has one entry for each of `vertices` vertices and that all entries are in range.
fn check_layer(layer: &StainLayer, vertices: usize) -> Result<(), InvariantError> {
    let lengths = [&layer.wet, &layer.stained, &layer.dust, &layer.moisture, &layer.areas].map(Vec::len);
    if lengths != [vertices; 5] {
        return Err(InvariantError::ArrayLength("stains"));
    }
    check_range("wet", &layer.wet, f32::MAX)?;
    check_range("stained", &layer.stained, f32::MAX)?;
    check_range("dust", &layer.dust, 1.0)?;
    check_range("moisture", &layer.moisture, 1.0)
}

/// Checks that all entries of `field` lie between 0 and `most`.
fn check_range(name: &'static str, field: &[f32], most: f32) -> Result<(), InvariantError> {
    match field.iter().position(|value| !(0.0..=most).contains(value)) {
        Some(i) => Err(InvariantError::Stain(name, VertexId::new(i))),
        None => Ok(()),
    }
}
