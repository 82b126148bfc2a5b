//! Reads settings from RON or any other format of serde.
//!
//! The reading is written by hand over the table rather than derived. So every error (an unknown name, or a value that
//! is not a number, out of range or given twice) names the full path of the setting and its range, and settings that
//! were read are valid.

use std::fmt;

use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, EnumAccess, Error, MapAccess, SeqAccess, VariantAccess, Visitor};

use super::{
    error::{SettingsError, SettingsErrorKind, TextPosition},
    field::Field,
    rows::{STAGE_NAMES, STAGES, Stage},
    stages::CoatingSettings,
};

impl CoatingSettings {
    /// Reads settings from RON. Settings that the text leaves out have their defaults. `file` is the name that errors
    /// use.
    ///
    /// # Errors
    /// [`SettingsError`] with the file, line and column, if the text is not RON, a setting is unknown or given twice,
    /// or a value is not a number or out of its range. The error also names the setting and its range where one is at
    /// fault.
    ///
    /// ```
    /// use bevy_coating::settings::CoatingSettings;
    ///
    /// let settings = CoatingSettings::from_ron("(tearing: (beta: 0.9), adhesion: (decay: 1.3))", "barrel")?;
    /// assert_eq!((settings.tearing.beta, settings.adhesion.decay), (0.9, 1.3));
    /// assert_eq!(settings.dust, CoatingSettings::default().dust);
    /// # Ok::<(), bevy_coating::settings::SettingsError>(())
    /// ```
    pub fn from_ron(text: &str, file: &str) -> Result<Self, SettingsError> {
        let mut fault = None;
        // Some programs begin every text with a byte order mark.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        ron::Options::default().from_str_seed(text, SettingsSeed { fault: &mut fault }).map_err(|error| SettingsError {
            position: Some(TextPosition {
                file: file.into(),
                line: error.span.start.line,
                column: error.span.start.col,
            }),
            kind: fault.unwrap_or_else(|| SettingsErrorKind::Syntax(error.code.to_string())),
        })
    }
}

impl<'de> Deserialize<'de> for CoatingSettings {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        SettingsSeed { fault: &mut None }.deserialize(deserializer)
    }
}

/// Slot for the typed error, since the errors of serde carry text only.
type Fault<'a> = &'a mut Option<SettingsErrorKind>;

/// Keeps the typed error and returns an error of serde with its text.
fn refuse<E: Error>(fault: Fault, kind: SettingsErrorKind) -> E {
    E::custom(fault.insert(kind))
}

/// Reads all settings.
struct SettingsSeed<'a> {
    fault: Fault<'a>,
}

impl<'de> DeserializeSeed<'de> for SettingsSeed<'_> {
    type Value = CoatingSettings;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<CoatingSettings, D::Error> {
        deserializer.deserialize_struct("CoatingSettings", STAGE_NAMES, self)
    }
}

impl<'de> Visitor<'de> for SettingsSeed<'_> {
    type Value = CoatingSettings;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("coating settings")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<CoatingSettings, A::Error> {
        let fault = self.fault;
        let mut settings = CoatingSettings::default();
        let mut seen = Vec::new();
        while let Some(name) = map.next_key_seed(NameSeed)? {
            let Some(stage) = STAGES.iter().find(|stage| stage.name == name) else {
                return Err(refuse(fault, SettingsErrorKind::unknown_field(name, STAGE_NAMES.iter().copied())));
            };
            if seen.contains(&stage.name) {
                return Err(refuse(fault, SettingsErrorKind::Duplicate { path: name }));
            }
            seen.push(stage.name);
            map.next_value_seed(StageSeed { stage, settings: &mut settings, fault })?;
        }
        Ok(settings)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<CoatingSettings, A::Error> {
        let mut settings = CoatingSettings::default();
        for (index, stage) in STAGES.iter().enumerate() {
            seq.next_element_seed(StageSeed { stage, settings: &mut settings, fault: self.fault })?
                .ok_or_else(|| A::Error::invalid_length(index, &"all stages of the coating settings"))?;
        }
        Ok(settings)
    }
}

/// Reads the settings of one stage.
struct StageSeed<'a> {
    stage: &'static Stage,
    settings: &'a mut CoatingSettings,
    fault: Fault<'a>,
}

impl<'de> DeserializeSeed<'de> for StageSeed<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_struct(self.stage.type_name, self.stage.field_names, self)
    }
}

impl<'de> Visitor<'de> for StageSeed<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "the settings of `{}`", self.stage.name)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Self { stage, settings, fault } = self;
        let mut seen = Vec::new();
        while let Some(name) = map.next_key_seed(NameSeed)? {
            let path = format!("{}.{name}", stage.name);
            let Some(field) = stage.fields.iter().find(|field| field.path == path) else {
                let known = stage.fields.iter().map(|field| field.path);
                return Err(refuse(fault, SettingsErrorKind::unknown_field(path, known)));
            };
            if seen.contains(&field.path) {
                return Err(refuse(fault, SettingsErrorKind::Duplicate { path }));
            }
            seen.push(field.path);
            map.next_value_seed(FieldSeed { field, settings, fault })?;
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<(), A::Error> {
        let Self { stage, settings, fault } = self;
        for (index, field) in stage.fields.iter().enumerate() {
            seq.next_element_seed(FieldSeed { field, settings, fault })?
                .ok_or_else(|| A::Error::invalid_length(index, &"all settings of the stage"))?;
        }
        Ok(())
    }
}

/// Reads one setting.
struct FieldSeed<'a> {
    field: &'static Field,
    settings: &'a mut CoatingSettings,
    fault: Fault<'a>,
}

impl<'de> DeserializeSeed<'de> for FieldSeed<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        let Self { field, settings, fault } = self;
        // A binary format must read whole numbers as the type they were written from. Text reads them like all
        // others, so that 2.5 and -1 are reported as out of range rather than as bad syntax.
        let value = if !field.names.is_empty() {
            return deserializer
                .deserialize_enum(field.path, field.names, NamedVisitor { field, settings })
                .map_err(|error| refuse::<D::Error>(fault, field.malformed(error.to_string())));
        } else if field.range.whole && !deserializer.is_human_readable() {
            u32::deserialize(deserializer).map(|whole| whole as f32)
        } else {
            f32::deserialize(deserializer)
        };
        let value = value.map_err(|error| refuse::<D::Error>(fault, field.malformed(error.to_string())))?;
        field.set(settings, value).map_err(|kind| refuse(fault, kind))
    }
}

/// Reads a setting that has names.
struct NamedVisitor<'a> {
    field: &'static Field,
    settings: &'a mut CoatingSettings,
}

impl<'de> Visitor<'de> for NamedVisitor<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "one of {}", self.field.allowed())
    }

    fn visit_enum<A: EnumAccess<'de>>(self, access: A) -> Result<(), A::Error> {
        let (number, rest) = access.variant_seed(NumberSeed(self.field))?;
        rest.unit_variant()?;
        self.field.set(self.settings, number).map_err(A::Error::custom)
    }
}

/// Reads a name as the number that it stands for; binary formats write the number itself.
struct NumberSeed(&'static Field);

impl<'de> DeserializeSeed<'de> for NumberSeed {
    type Value = f32;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<f32, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for NumberSeed {
    type Value = f32;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "one of {}", self.0.allowed())
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<f32, E> {
        self.0.named(name).map_err(|_| E::custom(format_args!("found `{name}`")))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<f32, E> {
        Ok(number as f32)
    }
}

/// Reads the name of a stage or setting.
struct NameSeed;

impl<'de> DeserializeSeed<'de> for NameSeed {
    type Value = String;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<String, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for NameSeed {
    type Value = String;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("the name of a setting")
    }

    fn visit_str<E: Error>(self, name: &str) -> Result<String, E> {
        Ok(name.into())
    }
}
