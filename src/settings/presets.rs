//! The presets that come with the crate.

use super::{CoatingSettings, SettingsError, SettingsErrorKind};

/// Name and RON text of every preset. The texts are the files of `assets/presets`, built into the crate.
///
/// - `default`: the settings' defaults: long branching cracks, flakes curled outward along them.
/// - `few_cracks`: paint that peels more than it cracks (VC fig. 12a).
/// - `gentle`: paint that has been cared for: fewer separated places, little curl.
/// - `heavy`: long neglect: most of the paint separated, cracked and curled.
pub const PRESETS: [(&str, &str); 4] = [
    ("default", include_str!("../../assets/presets/default.coating.ron")),
    ("few_cracks", include_str!("../../assets/presets/few_cracks.coating.ron")),
    ("gentle", include_str!("../../assets/presets/gentle.coating.ron")),
    ("heavy", include_str!("../../assets/presets/heavy.coating.ron")),
];

impl CoatingSettings {
    /// The settings of one of the [`PRESETS`].
    ///
    /// # Errors
    /// [`SettingsErrorKind::UnknownPreset`], which lists the presets there are.
    pub fn preset(name: &str) -> Result<Self, SettingsError> {
        let (_, text) = PRESETS.iter().find(|(known, _)| *known == name).ok_or_else(|| {
            SettingsErrorKind::UnknownPreset { name: name.into(), known: PRESETS.map(|(known, _)| known).into() }
        })?;
        Self::from_ron(text, &format!("{name}.coating.ron"))
    }
}
