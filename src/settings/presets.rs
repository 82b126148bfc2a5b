//! The presets that come with the crate.

use std::{fmt, str::FromStr};

use super::{
    error::{SettingsError, SettingsErrorKind},
    stages::CoatingSettings,
};

/// Named settings that come with the crate. Each is a file in `assets/presets` that is compiled into the crate.
///
/// ```
/// use bevy_coating::settings::{CoatingSettings, Preset};
///
/// let settings = CoatingSettings::from(Preset::Heavy);
/// assert_eq!("heavy".parse(), Ok(Preset::Heavy));
/// assert!(settings.adhesion.mean < CoatingSettings::default().adhesion.mean);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Preset {
    /// The defaults of [`CoatingSettings`]: long branching cracks, flakes curled outward along them.
    #[default]
    Default,
    /// Paint that peels more than it cracks (VC fig. 12a).
    FewCracks,
    /// Paint that has been cared for: fewer separated places, little curl.
    Gentle,
    /// Long neglect: most of the paint separated, cracked and curled.
    Heavy,
    /// Ruin: most of the paint gone, shreds on bare metal.
    Harsh,
    /// The paper's rules and constants as printed, which count in triangles: for its figures and for comparison.
    Paper,
}

impl Preset {
    /// Every preset, in the order of their names.
    pub const ALL: [Self; 6] = [Self::Default, Self::FewCracks, Self::Gentle, Self::Harsh, Self::Heavy, Self::Paper];

    /// Returns the name by which files, programs and [`FromStr`] know the preset.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Default => "default",
            Self::FewCracks => "few_cracks",
            Self::Gentle => "gentle",
            Self::Heavy => "heavy",
            Self::Harsh => "harsh",
            Self::Paper => "paper",
        }
    }

    /// Returns the RON text of the preset.
    pub const fn ron(self) -> &'static str {
        match self {
            Self::Default => include_str!("../../assets/presets/default.coating.ron"),
            Self::FewCracks => include_str!("../../assets/presets/few_cracks.coating.ron"),
            Self::Gentle => include_str!("../../assets/presets/gentle.coating.ron"),
            Self::Heavy => include_str!("../../assets/presets/heavy.coating.ron"),
            Self::Harsh => include_str!("../../assets/presets/harsh.coating.ron"),
            Self::Paper => include_str!("../../assets/presets/paper.coating.ron"),
        }
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Preset {
    type Err = SettingsError;

    /// Returns the preset with this [name](Preset::name).
    ///
    /// # Errors
    /// [`SettingsErrorKind::UnknownPreset`], which lists all names.
    fn from_str(name: &str) -> Result<Self, SettingsError> {
        let known = || Self::ALL.map(Self::name).into();
        let found = Self::ALL.into_iter().find(|preset| preset.name() == name);
        found.ok_or_else(|| SettingsErrorKind::UnknownPreset { name: name.into(), known: known() }.into())
    }
}

impl From<Preset> for CoatingSettings {
    /// Returns the settings of the preset.
    fn from(preset: Preset) -> Self {
        // A test parses every file, so this never falls back to the defaults.
        Self::from_ron(preset.ron(), preset.name()).unwrap_or_default()
    }
}

impl CoatingSettings {
    /// Returns the settings of the preset with this [name](Preset::name).
    ///
    /// # Errors
    /// [`SettingsErrorKind::UnknownPreset`], which lists all names.
    ///
    /// ```
    /// use bevy_coating::settings::{CoatingSettings, Preset};
    ///
    /// assert_eq!(CoatingSettings::preset("gentle")?, CoatingSettings::from(Preset::Gentle));
    /// assert!(CoatingSettings::preset("rusty").is_err());
    /// # Ok::<(), bevy_coating::settings::SettingsError>(())
    /// ```
    pub fn preset(name: &str) -> Result<Self, SettingsError> {
        name.parse::<Preset>().map(Self::from)
    }
}
