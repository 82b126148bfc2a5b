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
    /// Lime wash that has turned to chalk: it crumbles away in small flat scales.
    ChalkyWhitewash,
    /// Paint burnt dry by the sun: a fine net of cracks, small crisp scales, sand instead of rust.
    DesertSun,
    /// Paint that peels more than it cracks (VC fig. 12a).
    FewCracks,
    /// Good enamel, well cared for: a few hairline cracks at age 1, and hardly a chip.
    FreshEnamel,
    /// Paint that has been cared for: fewer separated places, little curl.
    Gentle,
    /// Long neglect: most of the paint separated, cracked and curled.
    Heavy,
    /// Ruin: most of the paint gone, shreds on bare metal.
    Harsh,
    /// Paint by the sea, where rust leads: metal rusts fast, and long streaks run off at every crack.
    Marine,
    /// Old lead paint in thick coats: large flakes that curl up and hang on by an edge.
    OldLeadPaint,
    /// The paper's rules and constants as printed, which count in triangles: for its figures and for comparison.
    Paper,
    /// Powder coat: a tough skin that hardly cracks and comes off in large sheets.
    PowderCoat,
}

impl Preset {
    /// Every preset, in the order of their names.
    pub const ALL: [Self; 12] = [
        Self::ChalkyWhitewash,
        Self::Default,
        Self::DesertSun,
        Self::FewCracks,
        Self::FreshEnamel,
        Self::Gentle,
        Self::Harsh,
        Self::Heavy,
        Self::Marine,
        Self::OldLeadPaint,
        Self::Paper,
        Self::PowderCoat,
    ];

    /// Returns the name by which files, programs and [`FromStr`] know the preset.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ChalkyWhitewash => "chalky_whitewash",
            Self::Default => "default",
            Self::DesertSun => "desert_sun",
            Self::FewCracks => "few_cracks",
            Self::FreshEnamel => "fresh_enamel",
            Self::Gentle => "gentle",
            Self::Harsh => "harsh",
            Self::Heavy => "heavy",
            Self::Marine => "marine",
            Self::OldLeadPaint => "old_lead_paint",
            Self::Paper => "paper",
            Self::PowderCoat => "powder_coat",
        }
    }

    /// Returns the RON text of the preset.
    pub const fn ron(self) -> &'static str {
        match self {
            Self::ChalkyWhitewash => include_str!("../../assets/presets/chalky_whitewash.coating.ron"),
            Self::Default => include_str!("../../assets/presets/default.coating.ron"),
            Self::DesertSun => include_str!("../../assets/presets/desert_sun.coating.ron"),
            Self::FewCracks => include_str!("../../assets/presets/few_cracks.coating.ron"),
            Self::FreshEnamel => include_str!("../../assets/presets/fresh_enamel.coating.ron"),
            Self::Gentle => include_str!("../../assets/presets/gentle.coating.ron"),
            Self::Harsh => include_str!("../../assets/presets/harsh.coating.ron"),
            Self::Heavy => include_str!("../../assets/presets/heavy.coating.ron"),
            Self::Marine => include_str!("../../assets/presets/marine.coating.ron"),
            Self::OldLeadPaint => include_str!("../../assets/presets/old_lead_paint.coating.ron"),
            Self::Paper => include_str!("../../assets/presets/paper.coating.ron"),
            Self::PowderCoat => include_str!("../../assets/presets/powder_coat.coating.ron"),
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
