//! Holds how stains come into an aged model.

use super::{error::OptionsError, limits::TEXTURE_SIZES};

/// How stains come into an aged model, which has no shaders of ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StainOutput {
    /// In textures of up to this many texels along a side ([`TEXTURE_SIZES`], default 1,024): base colour, metalness
    /// with roughness, and normals.
    Textures(u32),
    /// In vertex colours. Materials and textures of the prop stay as they are.
    VertexColors,
    /// Not at all.
    None,
}

impl Default for StainOutput {
    fn default() -> Self {
        Self::Textures(1024)
    }
}

impl StainOutput {
    /// Checks the size of textures.
    pub(super) fn validate(self) -> Result<(), OptionsError> {
        match self {
            Self::Textures(found) if !TEXTURE_SIZES.contains(&found) => Err(OptionsError::TextureSize { found }),
            _ => Ok(()),
        }
    }

    /// Returns the same for a prop that has `share` of the surface of all props in the file: its textures are smaller,
    /// so that all together have about as many texels as those of one prop alone.
    pub(super) fn for_share(self, share: f32) -> Self {
        let Self::Textures(size) = self else { return self };
        let wanted = (size as f32 * share.clamp(0.0, 1.0).sqrt()).ceil() as u32;
        Self::Textures(wanted.next_multiple_of(*TEXTURE_SIZES.start()).clamp(*TEXTURE_SIZES.start(), size))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn props_of_one_file_share_its_texels() {
        let size = |share: f32| StainOutput::Textures(1024).for_share(share);
        assert_eq!([size(1.0), size(0.25), size(1e-6)], [1024, 512, 64].map(StainOutput::Textures));
        assert_eq!(StainOutput::Textures(100).for_share(1.0), StainOutput::Textures(100));
        assert_eq!(StainOutput::VertexColors.for_share(0.1), StainOutput::VertexColors);
    }

    #[test]
    fn textures_of_no_size_are_refused() {
        assert!(StainOutput::Textures(0).validate().is_err() && StainOutput::Textures(8193).validate().is_err());
        assert!(StainOutput::default().validate().is_ok() && StainOutput::None.validate().is_ok());
    }
}
