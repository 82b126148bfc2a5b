//! The metal's own rust: where it lies open it rusts towards saturation.

use bevy_math::ops;

use super::StainFields;
use crate::settings::CoatingSettings;

/// Corrodes open metal for `dt`: c grows by (1 - c) times the rate and how open the metal lies; faster where it is wet.
pub(super) fn corrode(stains: &mut StainFields, settings: &CoatingSettings, dt: f32) {
    let pace = settings.rust.corrosion * dt;
    if pace <= 0.0 {
        return;
    }
    // Dry metal is open to one of a few degrees.
    let (mut known, mut left) = (f32::NAN, 1.0);
    for &v in &stains.open {
        let v = v as usize;
        let rate = pace * stains.openness[v] * (1.0 + settings.moisture.emission * stains.metal.moisture[v]);
        if rate != known {
            (known, left) = (rate, ops::exp(-rate));
        }
        stains.corrosion[v] = 1.0 - (1.0 - stains.corrosion[v]) * left;
    }
}
