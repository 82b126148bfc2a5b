//! The masks that belong to presets.

use super::{effect::CoatingMask, read::read_masks};
use crate::settings::Preset;

impl Preset {
    /// Returns the masks of the preset: where its paint begins weak or dirty on any prop, like a hull near the
    /// waterline. They are rules only, without images. Presets that are alike everywhere have none.
    ///
    /// ```
    /// use bevy_coating::settings::Preset;
    ///
    /// assert_eq!(Preset::Marine.masks().len(), 2);
    /// assert!(Preset::Default.masks().is_empty());
    /// ```
    pub fn masks(self) -> Vec<CoatingMask> {
        // A test parses every file, so this never falls back to none.
        self.masks_ron().and_then(|text| read_masks(text, self.name()).ok()).unwrap_or_default()
    }

    /// Returns the RON text of the masks, if the preset has some.
    pub const fn masks_ron(self) -> Option<&'static str> {
        Some(match self {
            Self::ChalkyWhitewash => include_str!("../../assets/presets/chalky_whitewash.masks.ron"),
            Self::DesertSun => include_str!("../../assets/presets/desert_sun.masks.ron"),
            Self::FreshEnamel => include_str!("../../assets/presets/fresh_enamel.masks.ron"),
            Self::Marine => include_str!("../../assets/presets/marine.masks.ron"),
            Self::OldLeadPaint => include_str!("../../assets/presets/old_lead_paint.masks.ron"),
            Self::PowderCoat => include_str!("../../assets/presets/powder_coat.masks.ron"),
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn every_file_of_masks_is_read_and_does_something() {
        let mut files = 0;
        for entry in fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/assets/presets")).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            let Some(preset) = name.strip_suffix(".masks.ron") else { continue };
            files += 1;
            let preset: Preset = preset.parse().unwrap();
            let text = preset.masks_ron().unwrap_or_else(|| panic!("{preset} leaves its file aside"));
            let masks = read_masks(text, preset.name()).unwrap_or_else(|error| panic!("{error}"));
            assert!(!masks.is_empty() && preset.masks() == masks, "{preset}");
            assert!(masks.iter().all(|mask| mask.effect != Default::default()), "{preset} has a mask without effect");
        }
        assert_eq!(files, Preset::ALL.iter().filter(|preset| preset.masks_ron().is_some()).count());
    }
}
