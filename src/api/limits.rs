//! Defines the ranges of a [`Coating`]'s fields, and checks them.

use std::ops::RangeInclusive;

use super::{coating::Coating, error::CoatingFault, paint::SettingsSource};

/// Greatest [`Coating::rate`].
pub const MAX_RATE: f64 = 1000.0;
/// Greatest [`Coating::start_age`].
pub const MAX_START_AGE: f64 = 10.0;
/// Greatest [`Coating::steps_per_age`].
pub const MAX_STEPS_PER_AGE: u32 = 100_000;

impl Coating {
    /// Checks the ranges of the fields, and of settings that are stored in the component.
    ///
    /// The plugin does so before it builds a film. Settings of an asset are checked when they have loaded.
    ///
    /// # Errors
    /// [`CoatingFault::Field`], [`CoatingFault::Build`] (the resolution) or [`CoatingFault::Settings`] with the first
    /// value that is out of its range.
    ///
    /// ```
    /// use bevy_coating::prelude::*;
    ///
    /// assert_eq!(Coating::default().with_rate(0.2).validate(), Ok(()));
    /// let fault = Coating::default().with_rate(-1.0).validate();
    /// let text = fault.expect_err("a negative rate").to_string();
    /// assert_eq!(text, "`Coating::rate` is -1, but must be 0 to 1000");
    /// ```
    pub fn validate(&self) -> Result<(), CoatingFault> {
        let steps = f64::from(self.steps_per_age);
        let most_steps = f64::from(MAX_STEPS_PER_AGE);
        self.checked_rate()?;
        check_field("start_age", self.start_age, 0.0..=MAX_START_AGE, "0 to 10")?;
        let date = self.painted.unwrap_or_default();
        check_field("painted", date, f64::MIN..=f64::MAX, "a finite number")?;
        check_field("steps_per_age", steps, 1.0..=most_steps, "1 to 100000")?;
        if let Some((field, found, range)) = self.detail.out_of_range() {
            return Err(CoatingFault::Field { field, found, range });
        }
        self.resolution.validate()?;
        match &self.settings {
            SettingsSource::Inline(settings) => Ok(settings.validate()?),
            SettingsSource::Asset(_) => Ok(()),
        }
    }

    /// Checks the range of [`Coating::rate`] alone, which may change while a film ages.
    pub(crate) fn checked_rate(&self) -> Result<f64, CoatingFault> {
        check_field("rate", self.rate, 0.0..=MAX_RATE, "0 to 1000").map(|()| self.rate)
    }
}

/// Returns an error if `found`, the value of `field`, is out of `range`, which `text` describes. NaN is out of any.
fn check_field(
    field: &'static str,
    found: f64,
    range: RangeInclusive<f64>,
    text: &'static str,
) -> Result<(), CoatingFault> {
    if range.contains(&found) { Ok(()) } else { Err(CoatingFault::Field { field, found, range: text }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{appearance::Detail, remesh::FilmResolution, settings::CoatingSettings, surface::BuildError};

    #[test]
    fn fields_out_of_range_are_named() {
        let rates =
            [-1e-9, 1000.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY].map(|rate| Coating::default().with_rate(rate));
        let ages = [-1e-9, 10.1, f64::NAN, f64::INFINITY].map(|age| Coating::default().with_start_age(age));
        let steps = [0, 100_001, u32::MAX].map(|steps| Coating::default().with_steps_per_age(steps));
        let details = [(5, 0.2), (0, -0.1), (2, 1.1), (2, f32::NAN)].map(|(level, chips)| Coating {
            detail: Detail { level, chips, ..Detail::default() },
            ..Coating::default()
        });
        let dates = [f64::NAN, f64::INFINITY].map(|date| Coating::default().with_painted(date));
        let faults = [
            ("painted", dates.to_vec()),
            ("detail.", details.to_vec()),
            ("rate", rates.to_vec()),
            ("start_age", ages.to_vec()),
            ("steps_per_age", steps.to_vec()),
        ];
        for (name, coatings) in faults {
            for coating in coatings {
                let fault = coating.validate();
                assert!(
                    matches!(fault, Err(CoatingFault::Field { field, .. }) if field.starts_with(name)),
                    "{fault:?}"
                );
            }
        }
        let mut settings = CoatingSettings::default();
        settings.tearing.alpha = 7.0;
        assert!(matches!(Coating::new(settings).validate(), Err(CoatingFault::Settings(_))));
    }

    #[test]
    fn resolutions_out_of_range_are_named() {
        let grain = |share, max_triangles| FilmResolution::Grain { share, max_triangles };
        let bad =
            [grain(f32::NAN, 100), grain(0.05, 100), grain(2.1, 100), grain(0.7, 3), FilmResolution::Triangles(3)];
        for resolution in bad {
            let fault = Coating::default().with_resolution(resolution).validate();
            assert!(matches!(fault, Err(CoatingFault::Build(BuildError::Resolution { .. }))), "{fault:?}");
        }
    }

    #[test]
    fn the_ends_of_the_ranges_belong_to_them() {
        for (rate, age, steps) in [(0.0, 0.0, 1), (MAX_RATE, MAX_START_AGE, MAX_STEPS_PER_AGE)] {
            let coating = Coating::default().with_rate(rate).with_start_age(age).with_steps_per_age(steps);
            assert_eq!(coating.validate(), Ok(()));
        }
    }
}
