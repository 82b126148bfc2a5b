//! Ages the forces of a film (VC 5.1, 5.2).

use super::{forces::FilmForces, predictions::Rates};
use crate::{film::FilmMesh, settings::CoatingSettings};

/// Ages the forces of a film by one step of `dt`, an age: 0.001 in the paper's reference run.
///
/// - Adhesion falls everywhere at [`adhesion.decay`](crate::settings::AdhesionSettings::decay) (VC 5.1). At a vertex of
///   moisture m it falls faster, by the factor 1 + m times
///   [`moisture.adhesion`](crate::settings::MoistureSettings::adhesion).
/// - Contraction grows everywhere at
///   [`tearing.contraction_growth`](crate::settings::TearingSettings::contraction_growth) (VC 5.2).
/// - The binding of an edge is multiplied by exp(-[`tearing.binding_decay`] `dt`), once for each of its two faces that
///   has a torn edge (VC 5.2).
///
/// Where `settings` are no longer those that the film was drawn with, it follows them first: see
/// [`FilmForces::follow_settings`].
///
/// `moisture` holds the moisture of each vertex, from 0 (dry) to 1 (wet). Pass an empty slice while the whole film is
/// dry: the call then takes the same time for a film of any size.
///
/// [`tearing.binding_decay`]: crate::settings::TearingSettings::binding_decay
///
/// ```
/// use bevy_coating::{
///     film::{FaceId, FilmMesh, VertexId},
///     fracture::{FilmForces, age_forces},
///     settings::CoatingSettings,
/// };
/// use bevy_math::Vec3;
///
/// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
/// let settings = CoatingSettings::default();
/// let mut forces = FilmForces::new(&mesh, &settings, 1);
/// forces.set_adhesion(VertexId(0), 2.0);
/// age_forces(&mesh, &mut forces, &settings, &[], 0.5);
/// assert_eq!(forces.adhesion(VertexId(0)), 1.5);
/// assert_eq!(forces.contraction(FaceId(0)), 1.5);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn age_forces(mesh: &FilmMesh, forces: &mut FilmForces, settings: &CoatingSettings, moisture: &[f32], dt: f32) {
    forces.set_gamma(mesh, settings.bending.gamma);
    forces.follow_settings(mesh, settings);
    let per_step = |rate: f32| f64::from(rate) * f64::from(dt);
    let adhesion_loss = per_step(settings.adhesion.decay);
    let wet_adhesion_loss =
        if moisture.is_empty() { 0.0 } else { adhesion_loss * f64::from(settings.moisture.adhesion) };
    let rates = Rates {
        adhesion_loss,
        wet_adhesion_loss,
        contraction_growth: per_step(settings.tearing.contraction_growth),
        binding_decay: per_step(settings.tearing.binding_decay),
    };
    forces.adhesion_lost += rates.adhesion_loss;
    forces.contraction_gained += rates.contraction_growth;
    forces.binding_decay += rates.binding_decay;
    if wet_adhesion_loss > 0.0 {
        let wet_adhesion_loss = wet_adhesion_loss as f32;
        for (lost, &moisture) in forces.adhesion_lost_wet.iter_mut().zip(moisture) {
            *lost += wet_adhesion_loss * moisture;
        }
    }
    forces.predictions.advance(rates);
}
