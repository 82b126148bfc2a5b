//! Corrodes the metal itself where it lies open.

use bevy_math::ops;

use super::fields::StainFields;
use crate::settings::CoatingSettings;

/// Corrodes open metal for `dt`, an age.
///
/// Corrosion c obeys dc/dt = [`corrosion`](crate::settings::RustSettings::corrosion) times openness times (1 - c).
/// Where the metal is wet the rate is larger by the factor 1 +
/// [`emission`](crate::settings::MoistureSettings::emission) times moisture.
pub(super) fn corrode(stains: &mut StainFields, settings: &CoatingSettings, dt: f32) {
    let pace = settings.rust.corrosion * dt;
    if pace <= 0.0 {
        return;
    }
    // Dry metal has only three degrees of openness, so the exponential is mostly one of the last three.
    let (mut known, mut oldest) = ([[f32::NAN, 1.0]; 3], 0);
    for &v in &stains.open {
        let v = v as usize;
        let rate = pace * stains.openness[v] * (1.0 + settings.moisture.emission * stains.metal.moisture[v]);
        let left = match known.iter().find(|known| known[0] == rate) {
            Some(&[_, left]) => left,
            None => {
                let left = ops::exp(-rate);
                known[oldest] = [rate, left];
                oldest = (oldest + 1) % known.len();
                left
            }
        };
        stains.corrosion[v] = 1.0 - (1.0 - stains.corrosion[v]) * left;
    }
}
