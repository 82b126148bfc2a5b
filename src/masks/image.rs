//! Images as masks.

use std::{collections::BTreeMap, sync::Arc};

use bevy_math::Vec2;

use super::{
    channel::{Channel, Wrap},
    error::MaskError,
};

/// Images by the names that [`TextureMask::image`](super::TextureMask::image) gives.
pub type MaskImages = BTreeMap<String, MaskImage>;

/// Image whose channels are weights. Clones share the texels.
///
/// ```
/// use bevy_coating::masks::{Channel, MaskImage, Wrap};
/// use bevy_math::Vec2;
///
/// // A black texel beside a white one.
/// let image = MaskImage::new(2, 1, vec![[0, 0, 0, 255], [255; 4]])?;
/// let at = |u: f32| image.sample(Vec2::new(u, 0.5), Channel::Red, Wrap::Clamp);
/// assert_eq!((at(0.25), at(0.5), at(0.75)), (0.0, 0.5, 1.0));
/// assert!(MaskImage::new(2, 2, vec![[0; 4]]).is_err());
/// # Ok::<(), bevy_coating::masks::MaskError>(())
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct MaskImage {
    width: u32,
    height: u32,
    texels: Arc<[[u8; 4]]>,
}

impl std::fmt::Debug for MaskImage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "MaskImage({} x {})", self.width, self.height)
    }
}

impl MaskImage {
    /// Creates an image of rows of texels from the top down; each is red, green, blue and alpha, 0 to 255.
    ///
    /// # Errors
    /// [`MaskError::ImageSize`] unless there are `width` times `height` texels, at least one.
    pub fn new(width: u32, height: u32, texels: Vec<[u8; 4]>) -> Result<Self, MaskError> {
        let found = texels.len();
        let fits = u64::from(width) * u64::from(height) == found as u64;
        if !fits || found == 0 {
            return Err(MaskError::ImageSize { width, height, found });
        }
        Ok(Self { width, height, texels: texels.into() })
    }

    /// Returns the number of texels.
    pub fn texels(&self) -> u64 {
        self.texels.len() as u64
    }

    /// Returns the channel at texture coordinates, 0 to 1, interpolated between the four nearest texels. (0, 0) is the
    /// upper left corner of the image. What is not finite counts as 0.
    pub fn sample(&self, uv: Vec2, channel: Channel, wrap: Wrap) -> f32 {
        let (x0, x1, across) = neighbours(uv.x, self.width, wrap);
        let (y0, y1, down) = neighbours(uv.y, self.height, wrap);
        let row = |y| {
            let (a, b) = (self.texel(x0, y, channel), self.texel(x1, y, channel));
            a + (b - a) * across
        };
        let (top, bottom) = (row(y0), row(y1));
        (top + (bottom - top) * down).clamp(0.0, 1.0)
    }

    fn texel(&self, x: u64, y: u64, channel: Channel) -> f32 {
        let index = usize::try_from(y * u64::from(self.width) + x).ok();
        let [r, g, b, a] = index.and_then(|i| self.texels.get(i)).copied().unwrap_or_default();
        let value = match channel {
            Channel::Red => r,
            Channel::Green => g,
            Channel::Blue => b,
            Channel::Alpha => a,
        };
        f32::from(value) / 255.0
    }
}

/// Returns the two texels of `count` between whose middles the coordinate lies, and how far from the first to the
/// second it is.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "what is cast is a whole number from 0 to twice the count"
)]
fn neighbours(coordinate: f32, count: u32, wrap: Wrap) -> (u64, u64, f32) {
    let (coordinate, n) = (f64::from(if coordinate.is_finite() { coordinate } else { 0.0 }), f64::from(count));
    // First into a range whose texels can be counted, however far out the coordinate lies.
    let period = if wrap == Wrap::Mirror { 2.0 } else { 1.0 };
    let inside = if wrap == Wrap::Clamp { coordinate.clamp(0.0, 1.0) } else { coordinate.rem_euclid(period) };
    let place = inside * n - 0.5;
    let first = place.floor();
    let fold = |texel: f64| match wrap {
        Wrap::Clamp => texel.clamp(0.0, n - 1.0),
        Wrap::Repeat => texel.rem_euclid(n),
        Wrap::Mirror => {
            let texel = texel.rem_euclid(2.0 * n);
            if texel < n { texel } else { 2.0 * n - 1.0 - texel }
        }
    };
    (fold(first) as u64, fold(first + 1.0) as u64, (place - first) as f32)
}
