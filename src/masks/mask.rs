//! Where paint is weak or dirty: textures, vertex colours, rules and functions, and what is combined of them.

use serde::{Deserialize, Serialize};

use super::{
    channel::{Channel, UvSet, Wrap},
    custom::CustomMask,
    error::MaskError,
};

/// Source of a weight from 0 to 1 at each vertex of a fresh film.
///
/// In RON it is written like `Multiply([Edges(reach: 0.01), Invert(Under())])`. What is left out of a rule has its
/// default.
///
/// ```
/// use bevy_coating::masks::Mask;
///
/// // Worn edges, in patches of 5 cm.
/// let mask = Mask::Multiply(vec![Mask::edges(0.01), Mask::noise(7, 0.05)]);
/// assert!(mask.validate().is_ok());
/// let text = ron::to_string(&mask)?;
/// assert_eq!(ron::from_str::<Mask>(&text)?, mask);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub enum Mask {
    /// The same weight everywhere, 0 to 1.
    Even(f32),
    /// An image, by the prop's texture coordinates.
    Texture(TextureMask),
    /// A channel of the prop's vertex colours, as they are stored: linear, 0 to 1.
    Color(Channel),
    /// Sharp edges, rims and tight curves that stand out: 1 at edges that turn by `sharp` and more, 0 where the surface
    /// turns by less than `soft`, or further away than the reach. Edges between triangles of what is shaded smooth
    /// count as the curve that they stand for, if they turn by less than 0.7 radians.
    Edges {
        /// Distance up to which an edge counts, in metres, and over which turns are added up: 0.0001 to 100, default
        /// 0.01. It is at least the film's mean edge. Work grows with its square.
        #[serde(default = "edge_reach")]
        reach: f32,
        /// Turn within the reach at which the weight begins, in radians: 0 to pi, default 0.25.
        #[serde(default = "edge_soft")]
        soft: f32,
        /// Turn from which the weight is 1, in radians: above `soft`, at most pi, default 1. A box's edge turns by
        /// 1.57, and so does the rim of a sheet.
        #[serde(default = "edge_sharp")]
        sharp: f32,
    },
    /// The lower part of the film: 1 up to the height `full`, 0 from `none`, in shares of the film's extent against
    /// gravity. With `full` above `none` it is the upper part. Weightless films have none: 0 everywhere.
    Lower {
        /// Height up to which the weight is 1: 0 to 1, default 0.
        #[serde(default)]
        full: f32,
        /// Height from which the weight is 0: 0 to 1, other than `full`, default 0.4.
        #[serde(default = "lower_none")]
        none: f32,
    },
    /// Surfaces that face down, by the cosine of the angle between the normal and gravity: 1 straight down, 0 on walls,
    /// -1 on what faces up. With `full` below `none` it is what faces up.
    Under {
        /// Cosine at which the weight is 1: -1 to 1, default 0.7.
        #[serde(default = "under_full")]
        full: f32,
        /// Cosine at which the weight is 0: -1 to 1, other than `full`, default 0.
        #[serde(default)]
        none: f32,
    },
    /// Smooth noise about 0.5, which hardly ever reaches 0 or 1. [`Levels`](Self::Levels) make patches of it.
    Noise {
        /// Seed of the noise. Films of different props have different noise all the same, as it is noise over places.
        #[serde(default)]
        seed: u64,
        /// Wavelength of the coarser of its two octaves, in metres: 0.0001 to 10,000.
        wavelength: f32,
    },
    /// The product of the weights; 1 if there are none.
    Multiply(Vec<Mask>),
    /// The largest weight; 0 if there are none.
    Max(Vec<Mask>),
    /// One less the weight.
    Invert(Box<Mask>),
    /// The mask's weight with more contrast: 0 up to `black`, 1 from `white`, and in a straight line between them. With
    /// `black` above `white` it is inverted.
    Levels {
        /// Mask that is changed.
        mask: Box<Mask>,
        /// Weight that becomes 0: 0 to 1, default 0.
        #[serde(default)]
        black: f32,
        /// Weight that becomes 1: 0 to 1, other than `black`, default 1.
        #[serde(default = "one")]
        white: f32,
    },
    /// A function of the program. Cannot be written or read.
    #[serde(skip)]
    Custom(CustomMask),
}

/// Image as a mask.
///
/// ```
/// use bevy_coating::masks::{Channel, TextureMask, UvSet};
///
/// let mask: TextureMask = ron::from_str(r#"(image: "wear.png", channel: Green)"#)?;
/// assert_eq!(mask, TextureMask { channel: Channel::Green, ..TextureMask::new("wear.png") });
/// assert_eq!(mask.uv, UvSet::First);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TextureMask {
    /// Name of the image among [`MaskGround::images`](super::MaskGround::images). For `coating-bake` it is a PNG or
    /// JPEG file, relative to the file that names it.
    pub image: String,
    /// Channel that counts, as it is stored, whatever the image's colour space. Default: red.
    #[serde(default)]
    pub channel: Channel,
    /// Set of the prop's texture coordinates. Default: the first.
    #[serde(default)]
    pub uv: UvSet,
    /// Way in which the image goes on beyond its edges. Default: the image again.
    #[serde(default)]
    pub wrap: Wrap,
}

impl TextureMask {
    /// Returns the red channel of the image of this name, repeated over the first texture coordinates.
    pub fn new(image: impl Into<String>) -> Self {
        Self { image: image.into(), channel: Channel::Red, uv: UvSet::First, wrap: Wrap::Repeat }
    }
}

fn edge_reach() -> f32 {
    0.01
}

fn edge_soft() -> f32 {
    0.25
}

fn edge_sharp() -> f32 {
    1.0
}

fn lower_none() -> f32 {
    0.4
}

fn under_full() -> f32 {
    0.7
}

fn one() -> f32 {
    1.0
}

impl Mask {
    /// Returns the mask of edges that are seen from up to `reach` metres.
    pub fn edges(reach: f32) -> Self {
        Self::Edges { reach, soft: edge_soft(), sharp: edge_sharp() }
    }

    /// Returns the mask of what lies below the share `none` of the film's height, strongest at its foot.
    pub fn lower(none: f32) -> Self {
        Self::Lower { full: 0.0, none }
    }

    /// Returns the mask of what faces down.
    pub fn under() -> Self {
        Self::Under { full: under_full(), none: 0.0 }
    }

    /// Returns noise of a wavelength in metres.
    pub fn noise(seed: u64, wavelength: f32) -> Self {
        Self::Noise { seed, wavelength }
    }

    /// Returns the red channel of the image of this name.
    pub fn texture(image: impl Into<String>) -> Self {
        Self::Texture(TextureMask::new(image))
    }

    /// Returns a mask that a function of a place, in metres, and the unit normal there gives.
    pub fn custom(weigh: impl Fn(bevy_math::Vec3, bevy_math::Vec3) -> f32 + Send + Sync + 'static) -> Self {
        Self::Custom(CustomMask::new(weigh))
    }

    /// Returns the opposite mask.
    pub fn invert(self) -> Self {
        Self::Invert(Box::new(self))
    }

    /// Returns the mask with 0 at `black` and 1 at `white`.
    pub fn levels(self, black: f32, white: f32) -> Self {
        Self::Levels { mask: Box::new(self), black, white }
    }

    /// Checks every number of the mask against its range.
    ///
    /// # Errors
    /// [`MaskError::OutOfRange`] for the first that is not in it, [`MaskError::NoSlope`] where two ends are the same.
    ///
    /// ```
    /// use bevy_coating::masks::Mask;
    ///
    /// assert!(Mask::noise(1, 0.2).invert().validate().is_ok());
    /// let error = Mask::noise(1, -0.2).invert().validate().unwrap_err();
    /// assert_eq!(error.to_string(), "`wavelength` of the mask `Noise` is -0.2, but its range is 0.0001 to 10000");
    /// ```
    pub fn validate(&self) -> Result<(), MaskError> {
        let inside = |mask, field, found: f32, least: f32, most: f32| {
            let within = (least..=most).contains(&found);
            if within { Ok(()) } else { Err(MaskError::OutOfRange { of: mask, field, found, least, most }) }
        };
        let apart = |mask, a: f32, b: f32| if a == b { Err(MaskError::NoSlope { mask, both: a }) } else { Ok(()) };
        match *self {
            Self::Even(weight) => inside("the mask `Even`", "weight", weight, 0.0, 1.0),
            Self::Edges { reach, soft, sharp } => {
                let mask = "the mask `Edges`";
                inside(mask, "reach", reach, 0.0001, 100.0)?;
                inside(mask, "soft", soft, 0.0, std::f32::consts::PI)?;
                inside(mask, "sharp", sharp, soft, std::f32::consts::PI)?;
                apart("Edges", soft, sharp)
            }
            Self::Lower { full, none } => {
                let mask = "the mask `Lower`";
                inside(mask, "full", full, 0.0, 1.0)?;
                inside(mask, "none", none, 0.0, 1.0)?;
                apart("Lower", full, none)
            }
            Self::Under { full, none } => {
                let mask = "the mask `Under`";
                inside(mask, "full", full, -1.0, 1.0)?;
                inside(mask, "none", none, -1.0, 1.0)?;
                apart("Under", full, none)
            }
            Self::Noise { wavelength, .. } => inside("the mask `Noise`", "wavelength", wavelength, 0.0001, 10_000.0),
            Self::Multiply(ref masks) | Self::Max(ref masks) => masks.iter().try_for_each(Self::validate),
            Self::Invert(ref mask) => mask.validate(),
            Self::Levels { ref mask, black, white } => {
                let name = "the mask `Levels`";
                inside(name, "black", black, 0.0, 1.0)?;
                inside(name, "white", white, 0.0, 1.0)?;
                apart("Levels", black, white)?;
                mask.validate()
            }
            Self::Texture(_) | Self::Color(_) | Self::Custom(_) => Ok(()),
        }
    }

    /// Calls `visit` with every texture of the mask, in order.
    pub fn textures<'a>(&'a self, visit: &mut dyn FnMut(&'a TextureMask)) {
        match self {
            Self::Texture(texture) => visit(texture),
            Self::Multiply(masks) | Self::Max(masks) => masks.iter().for_each(|mask| mask.textures(visit)),
            Self::Invert(mask) | Self::Levels { mask, .. } => mask.textures(visit),
            _ => {}
        }
    }

    /// Returns the mask with each image's name replaced by what `rename` makes of it.
    pub fn rename_images(&mut self, rename: &mut dyn FnMut(&str) -> String) {
        match self {
            Self::Texture(texture) => texture.image = rename(&texture.image),
            Self::Multiply(masks) | Self::Max(masks) => masks.iter_mut().for_each(|mask| mask.rename_images(rename)),
            Self::Invert(mask) | Self::Levels { mask, .. } => mask.rename_images(rename),
            _ => {}
        }
    }
}
