//! Reads custom properties.

use std::collections::BTreeMap;

use serde_json::Value;

use super::{error::ExtrasError, limits::MOST_START_AGE};
use crate::settings::{CoatingSettings, Preset};

/// Beginning of the names of properties that are single settings.
const SETTING: &str = "coating.";

/// Paint of an object by its custom properties.
#[derive(Clone, Debug, PartialEq)]
pub enum PropExtras {
    /// It is not painted, so nothing ages: `coating` is `false` or `"none"`.
    Exclude,
    /// It is painted.
    Coat(Box<PropCoating>),
}

/// Paint of an object.
#[derive(Clone, Debug, PartialEq)]
pub struct PropCoating {
    /// Preset that the settings began with.
    pub preset: Preset,
    /// Settings of the paint.
    pub settings: CoatingSettings,
    /// Seed of all that is random; `None`: whatever it would be.
    pub seed: Option<u64>,
    /// Age with which it appears; `None`: fresh.
    pub start_age: Option<f64>,
}

impl PropExtras {
    /// Reads custom properties, a JSON object. Returns `None` if none of them is about paint; what else there is does
    /// not matter.
    ///
    /// # Errors
    /// [`ExtrasError`] for the first property, in the order of their names, that cannot be used.
    ///
    /// ```
    /// use bevy_coating::extras::PropExtras;
    ///
    /// assert!(matches!(PropExtras::read(r#"{ "coating_start_age": 0.5 }"#)?, Some(PropExtras::Coat(_))));
    /// let error = PropExtras::read(r#"{ "coating_strat_age": 0.5 }"#).unwrap_err().to_string();
    /// assert!(error.contains("there are coating, coating_seed, coating_start_age"), "{error}");
    /// # Ok::<(), bevy_coating::extras::ExtrasError>(())
    /// ```
    pub fn read(json: &str) -> Result<Option<Self>, ExtrasError> {
        let value: Value = serde_json::from_str(json).map_err(|error| ExtrasError::Json(error.to_string()))?;
        let Value::Object(map) = value else { return Ok(None) };
        let about_paint = |key: &str| key.starts_with("coating");
        let own: BTreeMap<&str, &Value> =
            map.iter().map(|(key, value)| (key.as_str(), value)).filter(|(key, _)| about_paint(key)).collect();
        if own.is_empty() {
            return Ok(None);
        }
        let mut coating =
            PropCoating { preset: Preset::Default, settings: CoatingSettings::default(), seed: None, start_age: None };
        // The preset comes first in the order of names, so that settings change it.
        for (key, value) in own {
            match key {
                "coating" => match value {
                    Value::Bool(true) => {}
                    Value::Bool(false) => return Ok(Some(Self::Exclude)),
                    Value::String(name) if name == "none" => return Ok(Some(Self::Exclude)),
                    Value::String(name) => {
                        coating.preset = name.parse().map_err(|source| in_key(key, source))?;
                        coating.settings = coating.preset.into();
                    }
                    _ => return Err(kind(key, "the name of a preset, true, false or \"none\"", value)),
                },
                "coating_seed" => {
                    let seed = whole(value).ok_or_else(|| kind(key, "a whole number, 0 or more", value))?;
                    coating.seed = Some(seed);
                }
                "coating_start_age" => {
                    let found = value.as_f64().ok_or_else(|| kind(key, "a number", value))?;
                    if !(0.0..=MOST_START_AGE).contains(&found) {
                        return Err(ExtrasError::StartAge { found });
                    }
                    coating.start_age = Some(found);
                }
                _ => {
                    let path = key.strip_prefix(SETTING).ok_or_else(|| ExtrasError::UnknownKey { key: key.into() })?;
                    let text = match value {
                        Value::Number(number) => number.to_string(),
                        Value::String(name) => name.clone(),
                        _ => return Err(kind(key, "a number or a name", value)),
                    };
                    coating.settings.set(path, &text).map_err(|source| in_key(key, source))?;
                }
            }
        }
        Ok(Some(Self::Coat(coating.into())))
    }
}

/// Returns a whole number that is not negative. Blender writes some whole numbers with a decimal point.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "it is a whole number below 2 to the power 53"
)]
fn whole(value: &Value) -> Option<u64> {
    let exact = |number: &f64| number.fract() == 0.0 && (0.0..9.0e15).contains(number);
    value.as_u64().or_else(|| value.as_f64().filter(exact).map(|number| number as u64))
}

fn kind(key: &str, expected: &'static str, found: &Value) -> ExtrasError {
    ExtrasError::Kind { key: key.into(), expected, found: found.to_string() }
}

fn in_key(key: &str, source: crate::settings::SettingsError) -> ExtrasError {
    ExtrasError::Settings { key: key.into(), source: source.into() }
}
