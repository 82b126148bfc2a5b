//! Checks every invariant of stains.

use super::{RustSource, StainFields, StainLayer};
use crate::film::{FilmMesh, InvariantError, VertexId};

/// How far the rust budget may be off, in what was given off.
const ROUNDING: f64 = 1e-3;

impl StainFields {
    /// Checks the stains against the film: one entry a vertex, all in range, no rust out of nowhere, no source without
    /// film. Takes time proportional to the film's size; meant for tests and debugging.
    ///
    /// # Errors
    /// The first [`InvariantError`] found.
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

    /// All wet rust on film and metal: layers times square metres.
    pub fn wet_amount(&self) -> f64 {
        amount(&self.film.areas, &self.film.wet) + amount(&self.metal.areas, &self.metal.wet)
    }

    /// All rust that has stained film and metal: layers times square metres.
    pub fn stained_amount(&self) -> f64 {
        amount(&self.film.areas, &self.film.stained) + amount(&self.metal.areas, &self.metal.stained)
    }
}

fn amount(areas: &[f32], layers: &[f32]) -> f64 {
    areas.iter().zip(layers).map(|(&area, &layers)| f64::from(area) * f64::from(layers)).sum()
}

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

fn check_range(name: &'static str, field: &[f32], most: f32) -> Result<(), InvariantError> {
    match field.iter().position(|value| !(0.0..=most).contains(value)) {
        Some(i) => Err(InvariantError::Stain(name, VertexId::new(i))),
        None => Ok(()),
    }
}
