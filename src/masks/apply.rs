//! Puts masks on a fresh film.

use super::{effect::CoatingMask, error::MaskError, ground::MaskGround};
use crate::{film::FilmMesh, sim::FilmState};

/// Factors and stains that masks give each vertex of a fresh film.
///
/// ```
/// use bevy_coating::{
///     film::FilmMesh,
///     masks::{CoatingMask, Mask, MaskEffect, MaskFactors, MaskGround, MaskImages, Span},
///     remesh::sample,
/// };
/// use bevy_math::Vec3;
///
/// let piece = sample::plate(100, 7)?;
/// let mesh = FilmMesh::new(piece.film.positions.clone(), &piece.film.triangles)?;
/// let images = MaskImages::new();
/// let ground = MaskGround { surface: &piece.surface, built: &piece.film, gravity: Vec3::NEG_Y, images: &images };
/// let half = CoatingMask {
///     mask: Mask::Even(0.5),
///     effect: MaskEffect { adhesion: Span(1.0, 0.5), ..MaskEffect::default() },
/// };
/// let factors = MaskFactors::of(&[half.clone(), half], &mesh, &ground)?;
/// assert!(factors.adhesion.iter().all(|&factor| factor == 0.75 * 0.75));
/// assert!(factors.binding.iter().all(|&factor| factor == 1.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct MaskFactors {
    /// Factor of the adhesion.
    pub adhesion: Vec<f32>,
    /// Factor of the binding. An edge has the mean of its ends.
    pub binding: Vec<f32>,
    /// Factor of the contraction. A face has the mean of its corners.
    pub contraction: Vec<f32>,
    /// Dust to begin with, 0 to 1.
    pub dust: Vec<f32>,
    /// Rust stains to begin with, in layers.
    pub rust: Vec<f32>,
    /// Moisture to begin with, 0 to 1.
    pub moisture: Vec<f32>,
}

impl MaskFactors {
    /// Returns what `masks` do together: factors are multiplied, and of stains the largest counts.
    ///
    /// # Errors
    /// [`MaskError`] if a mask cannot be used: see [`Mask::weights`](super::Mask::weights) and
    /// [`MaskEffect::validate`](super::MaskEffect::validate).
    pub fn of(masks: &[CoatingMask], mesh: &FilmMesh, ground: &MaskGround) -> Result<Self, MaskError> {
        let vertices = mesh.topology.vertex_count();
        let (one, none) = (vec![1.0; vertices], vec![0.0; vertices]);
        let mut factors = Self {
            adhesion: one.clone(),
            binding: one.clone(),
            contraction: one,
            dust: none.clone(),
            rust: none.clone(),
            moisture: none,
        };
        for CoatingMask { mask, effect } in masks {
            effect.validate()?;
            let weights = mask.weights(mesh, ground)?;
            let Self { adhesion, binding, contraction, dust, rust, moisture } = &mut factors;
            for (all, span) in
                [(adhesion, effect.adhesion), (binding, effect.binding), (contraction, effect.contraction)]
            {
                all.iter_mut().zip(&weights).for_each(|(factor, &weight)| *factor *= span.at(weight));
            }
            for (all, span) in [(dust, effect.dust), (rust, effect.rust), (moisture, effect.moisture)] {
                all.iter_mut().zip(&weights).for_each(|(stain, &weight)| *stain = stain.max(span.at(weight)));
            }
        }
        Ok(factors)
    }

    /// Puts the factors and stains on a fresh film. What has a factor of 1 keeps its bits, and all of it goes on
    /// following the settings.
    ///
    /// # Errors
    /// [`MaskError::NotFresh`] if the film has taken a step, [`MaskError::OtherFilm`] if it has other vertices. The
    /// film is not changed then.
    pub fn apply(&self, film: &mut FilmState) -> Result<(), MaskError> {
        if film.clock.steps > 0 {
            return Err(MaskError::NotFresh { steps: film.clock.steps });
        }
        let (topology, forces) = (&film.mesh.topology, &mut film.forces);
        let (found, expected) = (topology.vertex_count(), self.adhesion.len());
        if found != expected {
            return Err(MaskError::OtherFilm { found, expected });
        }
        let at = |factors: &[f32], v: usize| factors.get(v).copied().unwrap_or(1.0);
        for v in topology.all_vertices() {
            let factor = at(&self.adhesion, v.index());
            // A force without end stays so, whatever the factor.
            if factor != 1.0 && forces.adhesion(v).is_finite() {
                forces.scale_adhesion(v, factor);
            }
        }
        for h in topology.all_edges() {
            let ends = [topology.origin(h), topology.target(h)].map(|v| at(&self.binding, v.index()));
            let factor = 0.5 * (ends[0] + ends[1]);
            if factor != 1.0 && forces.binding(topology, h).is_finite() {
                forces.scale_binding(topology, h, factor);
            }
        }
        for f in topology.all_faces() {
            let [a, b, c] = topology.corners(f).map(|v| at(&self.contraction, v.index()));
            if [a, b, c] != [1.0; 3] {
                let factor = (a + b + c) / 3.0;
                forces.scale_contraction(topology, f, factor);
            }
        }
        film.stains.begin_with(&self.dust, &self.rust, &self.moisture);
        Ok(())
    }
}

/// Puts `masks` on a fresh film: the forces that they scale, and the stains that it begins with.
///
/// Without masks, and where all factors are 1 and all stains 0, the film keeps its bits.
///
/// # Errors
/// [`MaskError`] if a mask cannot be used, or the film has taken a step. The film is not changed then.
pub fn apply_masks(film: &mut FilmState, masks: &[CoatingMask], ground: &MaskGround) -> Result<(), MaskError> {
    if masks.is_empty() {
        return Ok(());
    }
    MaskFactors::of(masks, &film.mesh, ground)?.apply(film)
}
