//! One settings struct a stage. Lengths are in mean film edges, forces in units of the initial contraction,
//! time in age: 0 is fresh, 1 the end of the reference run.

use serde::{Deserialize, Serialize};

/// All settings of a coating, one struct a stage.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CoatingSettings {
    /// Adhesion of the film to the metal (VC 5.1).
    pub adhesion: AdhesionSettings,
    /// Bending force that lifts the film (VC 5.1, eq. 4).
    pub bending: BendingSettings,
    /// Contraction, binding and tearing (VC 5.2).
    pub tearing: TearingSettings,
    /// PBD-2 bending (VC 4).
    pub deform: DeformSettings,
    /// Stripping and falling pieces (VC 5.3).
    pub stripping: StrippingSettings,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct AdhesionSettings {
    pub mean: f32,
    pub deviation: f32,
    pub octaves: u32,
    /// Noise cycles over the longest side of the film's bounding box.
    pub frequency: f32,
    pub decay: f32,
}
impl Default for AdhesionSettings {
    fn default() -> Self {
        Self { mean: 2.1, deviation: 0.70, octaves: 2, frequency: 5.0, decay: 1.0 }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BendingSettings {
    pub gain: f32,
    pub gamma: f32,
}
impl Default for BendingSettings {
    fn default() -> Self {
        Self { gain: 1.0 / 3.0, gamma: 2.0 }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TearingSettings {
    pub contraction: f32,
    pub contraction_growth: f32,
    pub contraction_kept: f32,
    pub binding: f32,
    pub binding_decay: f32,
    pub weak_probability: f32,
    pub weak_factor: f32,
    pub alpha: f32,
    pub beta: f32,
}
impl Default for TearingSettings {
    fn default() -> Self {
        Self {
            contraction: 1.0,
            contraction_growth: 1.0,
            contraction_kept: 0.3,
            binding: 6.0,
            binding_decay: 1.3,
            weak_probability: 0.01,
            weak_factor: 0.001,
            alpha: 0.45,
            beta: 0.20,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DeformSettings {
    pub narrowing_rate: f32,
    pub bend_limit: f32,
    pub sweeps_per_age: f32,
}
impl Default for DeformSettings {
    fn default() -> Self {
        Self { narrowing_rate: 0.7, bend_limit: 0.35, sweeps_per_age: 10_000.0 }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StrippingSettings {
    pub fall_faces: u32,
}
impl Default for StrippingSettings {
    fn default() -> Self {
        Self { fall_faces: 6 }
    }
}
