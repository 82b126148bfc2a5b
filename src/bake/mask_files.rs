//! Reads masks that a user names: files of masks, images, and rules by their names.

use std::path::{Path, PathBuf};

use super::{
    error::BakeError,
    media::media_type,
    model::Image,
    textures::{MAX_TEXELS, Texture},
};
use crate::{
    files,
    masks::{Channel, CoatingMask, Mask, MaskEffect, MaskError, MaskImage, MaskImages, Span, read_masks},
};

/// Masks with the images that they name, and the files that both are in.
///
/// ```
/// use bevy_coating::{bake::MaskFiles, masks::{Mask, Span}};
///
/// let mut masks = MaskFiles::default();
/// masks.add("edges:adhesion=1..0.3,rust=0..0.5")?;
/// assert_eq!(masks.masks[0].mask, Mask::edges(0.01));
/// assert_eq!(masks.masks[0].effect.adhesion, Span(1.0, 0.3));
///
/// let error = masks.add("edegs:adhesion=1..0.3").unwrap_err().to_string();
/// assert!(error.starts_with("edegs: cannot be read"), "{error}");
/// # Ok::<(), bevy_coating::bake::BakeError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct MaskFiles {
    /// Masks, in the order in which they were added.
    pub masks: Vec<CoatingMask>,
    /// Images, by the paths that the masks name them with.
    pub images: MaskImages,
    /// Files that were read.
    pub files: Vec<PathBuf>,
}

impl MaskFiles {
    /// Names of the rules that [`add`](Self::add) knows, with the masks that they are.
    pub const RULES: [&'static str; 5] = ["edges", "lower", "under", "noise", "color"];

    /// Adds what a text says: `FILE.ron`, a [list of masks](read_masks) whose images lie relative to it; or
    /// `WHERE:EFFECT=A..B`, with further effects after commas. `WHERE` is a PNG or JPEG image, whose red channel
    /// counts, or one of the [rules](Self::RULES) with its defaults, `EFFECT` one of [`MaskEffect::NAMES`], and `A` and
    /// `B` are its values where the mask is 0 and 1.
    ///
    /// # Errors
    /// [`BakeError::Read`] if a file cannot be read, [`BakeError::MaskImage`] if it is no image, [`BakeError::Masks`]
    /// if the text or the list makes no sense. Nothing is added then.
    pub fn add(&mut self, text: &str) -> Result<(), BakeError> {
        let mut added = self.clone();
        if Path::new(text).extension().is_some_and(|ending| ending == "ron") {
            added.add_file(Path::new(text))?;
        } else {
            added.add_one(text)?;
        }
        *self = added;
        Ok(())
    }

    fn add_file(&mut self, path: &Path) -> Result<(), BakeError> {
        let failed = |source| BakeError::Read { path: path.into(), source };
        let bytes = files::read(path).map_err(failed)?;
        let text = String::from_utf8(bytes).map_err(|error| failed(std::io::Error::other(error)))?;
        let mut masks = read_masks(&text, &path.display().to_string())?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut images = Vec::new();
        for CoatingMask { mask, .. } in &mut masks {
            mask.rename_images(&mut |image| {
                let image = folder.join(image).display().to_string();
                images.push(image.clone());
                image
            });
        }
        images.iter().try_for_each(|image| self.load(image))?;
        self.files.push(path.into());
        self.masks.extend(masks);
        Ok(())
    }

    fn add_one(&mut self, text: &str) -> Result<(), BakeError> {
        let malformed = |cause| BakeError::Masks(MaskError::Malformed { text: text.into(), cause });
        // Paths may hold colons.
        let (place, effects) = text.rsplit_once(':').ok_or_else(|| malformed("there is no `:`"))?;
        let mut effect = MaskEffect::default();
        for part in effects.split(',') {
            let (name, span) = part.split_once('=').ok_or_else(|| malformed("an effect has no `=`"))?;
            let number = |text: &str| text.trim().parse::<f32>().ok();
            let ends = span.split_once("..").and_then(|(a, b)| number(a).zip(number(b)));
            let (zero, one) = ends.ok_or_else(|| malformed("an effect has no two numbers"))?;
            effect.set(name.trim(), Span(zero, one))?;
        }
        let mask = match place {
            "edges" => Mask::edges(0.01),
            "lower" => Mask::lower(0.4),
            "under" => Mask::under(),
            "noise" => Mask::noise(0, 0.1).levels(0.4, 0.6),
            "color" => Mask::Color(Channel::Red),
            image => {
                self.load(image)?;
                Mask::texture(image)
            }
        };
        self.masks.push(CoatingMask { mask, effect });
        Ok(())
    }

    /// Loads an image, unless it has been.
    fn load(&mut self, image: &str) -> Result<(), BakeError> {
        if self.images.contains_key(image) {
            return Ok(());
        }
        let path = Path::new(image);
        let bytes = files::read(path).map_err(|source| BakeError::Read { path: path.into(), source })?;
        let refused = |cause| BakeError::MaskImage { path: path.into(), cause };
        let mime_type = media_type(&bytes).unwrap_or("a file of this kind").into();
        let texels: u64 = self.images.values().map(MaskImage::texels).sum();
        let encoded = Image { mime_type, bytes: bytes.into(), ..Image::default() };
        let decoded = Texture::decode(&encoded, false, MAX_TEXELS.saturating_sub(texels)).map_err(refused)?;
        let size = decoded.size();
        let decoded = MaskImage::new(size.x, size.y, decoded.pixels().to_vec())?;
        self.images.insert(image.into(), decoded);
        self.files.push(path.into());
        Ok(())
    }
}
