//! Defines the masks of a coating, which say where its films begin weak or dirty.

use std::{
    collections::BTreeMap,
    hash::{DefaultHasher, Hash, Hasher},
};

use bevy::{asset::Handle, image::Image, reflect::prelude::*};

use crate::masks::{CoatingMask, Mask, MaskEffect};

/// Masks of a coating: where its films are weak or dirty from the start, and the images that they name. The default has
/// none.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{masks::{Mask, MaskEffect, Span, read_masks}, prelude::*};
///
/// fn hull(assets: &AssetServer) -> Coating {
///     let weak = MaskEffect { adhesion: Span(1.0, 0.3), ..MaskEffect::default() };
///     let masks = CoatingMasks::default()
///         .with(Mask::edges(0.02), weak)
///         .with_image("wear.png", assets.load("hull/wear.png"), weak);
///     Coating::default().with_masks(masks)
/// }
///
/// // Or from a file.
/// let masks = read_masks("[(mask: Lower(), effect: (rust: (0.0, 0.5)))]", "hull.masks.ron")?;
/// assert_eq!(CoatingMasks::from(masks).masks.len(), 1);
/// # Ok::<(), bevy_coating::masks::MaskError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub struct CoatingMasks {
    /// Masks and what they do. They act on every film of the coating, each by its own shape and texture coordinates.
    pub masks: Vec<CoatingMask>,
    /// Images by the names that the masks give ([`TextureMask::image`](crate::masks::TextureMask::image)). They must be
    /// uncompressed and in the main world. An image that changes counts from the next build on.
    pub images: BTreeMap<String, Handle<Image>>,
}

impl CoatingMasks {
    /// Adds a mask.
    pub fn with(mut self, mask: Mask, effect: MaskEffect) -> Self {
        self.masks.push(CoatingMask { mask, effect });
        self
    }

    /// Adds the red channel of an image, over the first texture coordinates, under a name.
    pub fn with_image(mut self, name: &str, image: Handle<Image>, effect: MaskEffect) -> Self {
        self.images.insert(name.into(), image);
        self.with(Mask::texture(name), effect)
    }

    /// Returns a number that tells different masks apart, for the time that the program runs.
    pub(crate) fn fingerprint(&self) -> u64 {
        if self.masks.is_empty() {
            return 0;
        }
        let mut hasher = DefaultHasher::new();
        // Their text tells all numbers apart, and functions by their addresses.
        format!("{:?}", self.masks).hash(&mut hasher);
        self.images.iter().for_each(|(name, image)| (name, image.id()).hash(&mut hasher));
        hasher.finish()
    }
}

impl From<Vec<CoatingMask>> for CoatingMasks {
    /// Returns masks that name no images.
    fn from(masks: Vec<CoatingMask>) -> Self {
        Self { masks, images: BTreeMap::new() }
    }
}
