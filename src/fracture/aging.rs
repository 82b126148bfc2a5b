//! How forces age (VC 5.1, 5.2).

use super::{FilmForces, predictions::Rates};
use crate::{film::FilmMesh, settings::CoatingSettings};

/// Ages the forces by `dt`: adhesion falls (VC 5.1), faster where the film is wet, contraction grows, and the bound
/// edges of a face that has a torn one lose binding, once for each such face (VC 5.2). `moisture` is that of each
/// vertex in 0..=1, or empty where all is dry; only then does this take time that depends on the film's size.
pub fn age_forces(mesh: &FilmMesh, forces: &mut FilmForces, settings: &CoatingSettings, moisture: &[f32], dt: f32) {
    forces.set_gamma(mesh, settings.bending.gamma);
    let per_step = |rate: f32| f64::from(rate) * f64::from(dt);
    let fall = per_step(settings.adhesion.decay);
    let wet_fall = if moisture.is_empty() { 0.0 } else { fall * f64::from(settings.moisture.adhesion) };
    let rates = Rates {
        fall,
        wet_fall,
        growth: per_step(settings.tearing.contraction_growth),
        decay: per_step(settings.tearing.binding_decay),
    };
    forces.adhesion_lost += rates.fall;
    forces.grown += rates.growth;
    forces.decay += rates.decay;
    if wet_fall > 0.0 {
        let wet_fall = wet_fall as f32;
        for (base, &moisture) in forces.adhesion_bases.iter_mut().zip(moisture) {
            *base -= wet_fall * moisture;
        }
    }
    forces.predictions.advance(rates);
}
