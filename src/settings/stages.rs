//! The structs of the settings, one a stage, made from the table.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::{ReflectDefault, ReflectDeserialize, ReflectSerialize};
use serde::Serialize;

use super::{rules::Rules, table::with_stages};

/// Makes the range of a row in words, for the documentation.
macro_rules! range_in_words {
    (closed, $min:expr, $max:expr) => {
        concat!(stringify!($min), " to ", stringify!($max))
    };
    (open, $min:expr, $max:expr) => {
        concat!("above ", stringify!($min), " and below ", stringify!($max))
    };
    (named, $min:expr, $max:expr) => {
        "the names of its type"
    };
}

/// Defines the structs and their defaults from the table.
macro_rules! define_structs {
    ($(
        $(#[doc = $stage_doc:literal])+
        $stage:ident: $Settings:ident {
            $($(#[doc = $doc:literal])+ $field:ident: $type:ty = $default:expr, $ends:ident($min:expr, $max:expr);)+
        }
    )+) => {
        /// Settings of a coating, one struct for each stage.
        ///
        /// Every setting acts on films under way: see the documentation of each. What has torn stays torn, and what has
        /// come off stays off.
        ///
        /// The defaults were found by trial on plates, a curved plate, a vase and the Stanford bunny. Reading checks
        /// names and ranges. After changing fields in code, call [`CoatingSettings::validate`].
        ///
        /// Lengths are in mean film edges unless a setting says metres. Forces are in units of the initial contraction
        /// (VC's T). Angles are in radians. Rates are per unit age: age 0 is fresh, and age 1 is the end of the paper's
        /// reference run.
        ///
        /// ```
        /// use bevy_coating::settings::CoatingSettings;
        ///
        /// let mut settings = CoatingSettings::default();
        /// settings.adhesion.mean = 1.9;
        /// settings.stripping.fall_faces = 12;
        /// settings.validate()?;
        /// # Ok::<(), bevy_coating::settings::SettingsError>(())
        /// ```
        #[derive(Clone, Debug, Default, PartialEq, Serialize)]
        #[cfg_attr(
            feature = "plugin",
            derive(bevy::asset::Asset, bevy::reflect::Reflect),
            reflect(Clone, Debug, Default, PartialEq, Serialize, Deserialize),
            type_path = "bevy_coating::settings"
        )]
        pub struct CoatingSettings {
            $($(#[doc = $stage_doc])+ pub $stage: $Settings,)+
        }

        $(
            $(#[doc = $stage_doc])+
            #[derive(Clone, Debug, PartialEq, Serialize)]
            #[cfg_attr(
                feature = "plugin",
                derive(bevy::reflect::Reflect),
                reflect(Clone, Debug, Default, PartialEq, Serialize),
                type_path = "bevy_coating::settings"
            )]
            pub struct $Settings {
                $(
                    $(#[doc = $doc])+
                    ///
                    #[doc = concat!(
                        "Default ", stringify!($default), "; range ", range_in_words!($ends, $min, $max), "."
                    )]
                    pub $field: $type,
                )+
            }

            impl Default for $Settings {
                fn default() -> Self {
                    Self { $($field: $default),+ }
                }
            }
        )+
    };
}

with_stages!(define_structs);
