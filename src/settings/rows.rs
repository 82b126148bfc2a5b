//! The settings as rows that can be looked up by name, made from the table.

use super::{field::Field, range::Range, rules::Rules, table::with_stages};

/// Makes the range of a row.
macro_rules! range {
    (closed, $min:expr, $max:expr, $type:ty) => {
        Range { min: $min, max: $max, open: false, whole: <$type as Number>::WHOLE }
    };
    (open, $min:expr, $max:expr, $type:ty) => {
        Range { min: $min, max: $max, open: true, whole: <$type as Number>::WHOLE }
    };
    (named, $min:expr, $max:expr, $type:ty) => {
        Range { min: $min, max: $max, open: false, whole: <$type as Number>::WHOLE }
    };
}

/// Defines the rows from the table.
macro_rules! define_rows {
    ($(
        $(#[doc = $stage_doc:literal])+
        $stage:ident: $Settings:ident {
            $($(#[doc = $doc:literal])+ $field:ident: $type:ty = $default:expr, $ends:ident($min:expr, $max:expr);)+
        }
    )+) => {
        /// Names of the stages, in the order of the structs.
        pub(super) const STAGE_NAMES: &[&str] = &[$(stringify!($stage)),+];

        /// Rows of all stages, in the order of the structs.
        pub(super) const STAGES: &[Stage] = &[$(Stage {
            name: stringify!($stage),
            type_name: stringify!($Settings),
            field_names: &[$(stringify!($field)),+],
            fields: &[$(Field {
                path: concat!(stringify!($stage), ".", stringify!($field)),
                doc: concat!($($doc),+),
                range: range!($ends, $min, $max, $type),
                names: <$type as Number>::NAMES,
                get: |settings| settings.$stage.$field.to_f32(),
                set: |settings, value| settings.$stage.$field = Number::from_f32(value),
            }),+],
        }),+];
    };
}

/// Settings of one stage.
pub(super) struct Stage {
    pub name: &'static str,
    /// Name of the stage's struct.
    pub type_name: &'static str,
    pub field_names: &'static [&'static str],
    pub fields: &'static [Field],
}

/// Type that a setting can have.
trait Number: Copy {
    const WHOLE: bool;
    /// Names of the values, for a type that has names instead of numbers.
    const NAMES: &[&str] = &[];
    fn to_f32(self) -> f32;
    fn from_f32(value: f32) -> Self;
}

impl Number for f32 {
    const WHOLE: bool = false;
    fn to_f32(self) -> f32 {
        self
    }
    fn from_f32(value: f32) -> Self {
        value
    }
}

impl Number for u32 {
    const WHOLE: bool = true;
    fn to_f32(self) -> f32 {
        self as f32
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "the range was checked: it is whole, not negative, and not too large"
    )]
    fn from_f32(value: f32) -> Self {
        value as u32
    }
}

impl Number for Rules {
    const WHOLE: bool = true;
    const NAMES: &[&str] = Rules::NAMES;
    fn to_f32(self) -> f32 {
        f32::from(self as u8)
    }
    fn from_f32(value: f32) -> Self {
        if value == 0.0 { Self::Paper } else { Self::Grain }
    }
}

with_stages!(define_rows);
