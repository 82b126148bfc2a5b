//! The structs of the settings, one a stage, made from the table.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::{ReflectDefault, ReflectDeserialize, ReflectSerialize};
use serde::Serialize;

use super::table::with_stages;

/// A row's range in words, for the documentation.
macro_rules! range_in_words {
    (closed, $min:expr, $max:expr) => {
        concat!(stringify!($min), " to ", stringify!($max))
    };
    (open, $min:expr, $max:expr) => {
        concat!("above ", stringify!($min), " and below ", stringify!($max))
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
        /// All settings of a coating, one struct a stage.
        ///
        /// The defaults are those with which the method was tried out on plates, a curved plate, a vase and the
        /// Stanford bunny. Reading checks names and ranges; after changing fields by hand, call
        /// [`CoatingSettings::validate`].
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
