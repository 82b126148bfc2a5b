//! Whether the film is measured in triangles or in metres.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::{ReflectDefault, ReflectDeserialize, ReflectSerialize};
use serde::{Deserialize, Serialize};

/// Rules by which fracture and curls are measured.
///
/// ```
/// use bevy_coating::settings::{CoatingSettings, Rules};
///
/// let mut settings = CoatingSettings::default();
/// assert_eq!(settings.scale.rules, Rules::Grain);
/// settings.set("scale.rules", "Paper")?;
/// assert_eq!(settings.scale.rules, Rules::Paper);
/// # Ok::<(), bevy_coating::settings::SettingsError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Clone, Debug, Default, PartialEq, Hash, Serialize, Deserialize),
    type_path = "bevy_coating::settings"
)]
pub enum Rules {
    /// The paper's rules as printed, which count in edges and faces (VC 5): a finer film cracks more densely and curls
    /// less.
    Paper,
    /// Rules that count in grains ([`ScaleSettings::grain`](super::ScaleSettings::grain)): films of any fineness crack
    /// and curl at one scale. Go beyond the paper.
    #[default]
    Grain,
}

impl Rules {
    /// Names of all rules, in the order of their numbers.
    pub(super) const NAMES: &[&str] = &["Paper", "Grain"];
}
