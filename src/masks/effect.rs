//! Effects of masks on a fresh film.

#[cfg(feature = "plugin")]
use bevy::reflect::{Reflect, ReflectDeserialize, ReflectSerialize};
use serde::{Deserialize, Serialize};

use super::{error::MaskError, mask::Mask, names::EFFECTS};

/// Largest factor of a force.
const MOST_FACTOR: f32 = 100.0;
/// Most rust that a film may begin with, in layers.
const MOST_RUST: f32 = 10.0;

/// Value at the weight 0 and at the weight 1, with a straight line between them. In RON: `(1.0, 0.25)`.
///
/// ```
/// use bevy_coating::masks::Span;
///
/// assert_eq!(Span(1.0, 0.25).at(0.5), 0.625);
/// assert_eq!(Span(0.2, 0.7).at(1.0), 0.7, "the ends are exact");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Span(pub f32, pub f32);

impl Span {
    /// Returns the value at a weight from 0 to 1.
    pub fn at(self, weight: f32) -> f32 {
        // Rounding must not make a factor of what is 1 at both ends.
        if self.0 == self.1 { self.0 } else { self.0 * (1.0 - weight) + self.1 * weight }
    }
}

/// Effects of a mask: factors of what holds and pulls, and stains to begin with. The default has none.
///
/// Factors of several masks are multiplied; of stains the largest counts. In RON what is left out has no effect:
/// `(adhesion: (1.0, 0.25), rust: (0.0, 0.5))`.
///
/// ```
/// use bevy_coating::masks::{MaskEffect, Span};
///
/// let effect: MaskEffect = ron::from_str("(adhesion: (1.0, 0.25), dust: (0.0, 0.8))")?;
/// assert_eq!((effect.adhesion, effect.binding), (Span(1.0, 0.25), Span(1.0, 1.0)));
/// assert_eq!(effect.dust, Span(0.0, 0.8));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct MaskEffect {
    /// Factor of the adhesion to the metal: 0 to 100. Below 1 paint comes off sooner.
    pub adhesion: Span,
    /// Factor of the binding of edges: 0 to 100. Below 1 paint cracks sooner.
    pub binding: Span,
    /// Factor of the contraction of faces: 0 to 100. Above 1 paint comes off and cracks sooner.
    pub contraction: Span,
    /// Dust to begin with: 0 (clean) to 1 (black).
    pub dust: Span,
    /// Rust stains on the paint to begin with: 0 to 10 layers.
    pub rust: Span,
    /// Moisture to begin with: 0 (dry) to 1 (wet). It dries as the settings say.
    pub moisture: Span,
}

impl Default for MaskEffect {
    fn default() -> Self {
        let (same, none) = (Span(1.0, 1.0), Span(0.0, 0.0));
        Self { adhesion: same, binding: same, contraction: same, dust: none, rust: none, moisture: none }
    }
}

impl MaskEffect {
    /// Names of the effects, as they are in RON and in [`set`](Self::set).
    pub const NAMES: [&'static str; 6] = EFFECTS;

    /// Checks every value against its range.
    ///
    /// # Errors
    /// [`MaskError::OutOfRange`] for the first that is NaN or not in its range.
    ///
    /// ```
    /// use bevy_coating::masks::{MaskEffect, Span};
    ///
    /// let error = MaskEffect { dust: Span(0.0, 2.0), ..MaskEffect::default() }.validate().unwrap_err();
    /// assert_eq!(error.to_string(), "`dust` of a mask's effect is 2, but its range is 0 to 1");
    /// ```
    pub fn validate(&self) -> Result<(), MaskError> {
        let Self { adhesion, binding, contraction, dust, rust, moisture } = *self;
        let most = [MOST_FACTOR, MOST_FACTOR, MOST_FACTOR, 1.0, MOST_RUST, 1.0];
        for ((field, span), most) in
            Self::NAMES.into_iter().zip([adhesion, binding, contraction, dust, rust, moisture]).zip(most)
        {
            for found in [span.0, span.1] {
                if !(0.0..=most).contains(&found) {
                    return Err(MaskError::OutOfRange { of: "a mask's effect", field, found, least: 0.0, most });
                }
            }
        }
        Ok(())
    }

    /// Sets the effect of this name.
    ///
    /// # Errors
    /// [`MaskError::UnknownEffect`], which lists the names, or [`MaskError::OutOfRange`]. Nothing is changed then.
    ///
    /// ```
    /// use bevy_coating::masks::{MaskEffect, Span};
    ///
    /// let mut effect = MaskEffect::default();
    /// effect.set("binding", Span(1.0, 0.5))?;
    /// assert_eq!(effect.binding, Span(1.0, 0.5));
    /// assert!(effect.set("glue", Span(1.0, 0.5)).is_err());
    /// # Ok::<(), bevy_coating::masks::MaskError>(())
    /// ```
    pub fn set(&mut self, name: &str, span: Span) -> Result<(), MaskError> {
        let mut changed = *self;
        let field = match name {
            "adhesion" => &mut changed.adhesion,
            "binding" => &mut changed.binding,
            "contraction" => &mut changed.contraction,
            "dust" => &mut changed.dust,
            "rust" => &mut changed.rust,
            "moisture" => &mut changed.moisture,
            _ => return Err(MaskError::UnknownEffect { name: name.into() }),
        };
        *field = span;
        changed.validate()?;
        *self = changed;
        Ok(())
    }
}

/// A mask and what it does.
///
/// ```
/// use bevy_coating::masks::{CoatingMask, Mask, MaskEffect, Span};
///
/// let weak_edges = CoatingMask {
///     mask: Mask::edges(0.02),
///     effect: MaskEffect { adhesion: Span(1.0, 0.3), ..MaskEffect::default() },
/// };
/// assert!(weak_edges.validate().is_ok());
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "plugin", derive(Reflect), reflect(opaque, Debug, Clone, PartialEq, Serialize, Deserialize))]
pub struct CoatingMask {
    /// Mask that says where.
    pub mask: Mask,
    /// Effect that it has there.
    pub effect: MaskEffect,
}

impl CoatingMask {
    /// Checks mask and effect against their ranges.
    ///
    /// # Errors
    /// [`MaskError`] for the first value that is not in its range.
    pub fn validate(&self) -> Result<(), MaskError> {
        self.mask.validate()?;
        self.effect.validate()
    }
}
