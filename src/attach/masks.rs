//! Collects the masks of a build with their images, and reads these.

use std::{collections::BTreeMap, sync::Arc};

use bevy::{
    asset::AssetId,
    color::Color,
    ecs::world::World,
    image::{Image, TextureAccessError},
    math::Vec3,
};

use crate::{
    api::{
        assets::{Waited, loaded},
        coating::Coating,
        error::CoatingFault,
    },
    masks::{CoatingMask, MaskError, MaskGround, MaskImage, MaskImages, apply_masks},
    remesh::BuiltFilm,
    sim::FilmState,
    surface::Surface,
};

/// Copies of images that films of one coating share.
pub(super) type SharedImages = BTreeMap<AssetId<Image>, Arc<Image>>;

/// Masks of a film that is to be built.
#[derive(Clone, Debug, Default)]
pub(super) struct MaskOrder {
    masks: Vec<CoatingMask>,
    images: Vec<(String, Arc<Image>)>,
    /// Gravity in the film's space.
    gravity: Vec3,
}

/// Collects the masks of a coating; `None` while an image is loading.
///
/// # Errors
/// [`CoatingFault::MaskNotLoaded`] if an image could not be loaded, [`CoatingFault::Mask`] if a mask is out of range.
pub(super) fn masks_of(
    world: &World,
    coating: &Coating,
    gravity: Vec3,
    shared: &mut SharedImages,
) -> Waited<MaskOrder> {
    let mut order = MaskOrder { masks: coating.masks.masks.clone(), images: Vec::new(), gravity };
    let mut names = Vec::new();
    for CoatingMask { mask, effect } in &coating.masks.masks {
        mask.validate()?;
        effect.validate()?;
        mask.textures(&mut |texture| names.push(texture.image.as_str()));
    }
    names.sort_unstable();
    names.dedup();
    for name in names {
        // What has no image is refused where the masks are put on.
        let Some(handle) = coating.masks.images.get(name) else { continue };
        let fault = CoatingFault::MaskNotLoaded { name: name.into() };
        let Some(image) = loaded(world, handle, fault)? else { return Ok(None) };
        let copy = shared.entry(handle.id()).or_insert_with(|| Arc::new(image.clone()));
        order.images.push((name.into(), copy.clone()));
    }
    Ok(Some(order))
}

impl MaskOrder {
    /// Puts the masks on a film that was just built.
    ///
    /// # Errors
    /// [`CoatingFault::MaskImage`] if an image cannot be read, [`CoatingFault::Mask`] if a mask cannot be used.
    pub fn apply(self, film: &mut FilmState, surface: &Surface, built: &BuiltFilm) -> Result<(), CoatingFault> {
        let mut images = MaskImages::new();
        for (name, image) in self.images {
            let read = texels(&image).map_err(|cause| CoatingFault::MaskImage { name: name.clone(), cause })?;
            images.insert(name, read);
        }
        let ground = MaskGround { surface, built, gravity: self.gravity, images: &images };
        Ok(apply_masks(film, &self.masks, &ground)?)
    }
}

/// Returns the texels of an image as they are stored.
fn texels(image: &Image) -> Result<MaskImage, String> {
    if image.data.is_none() {
        return Err("it is in the render world only; load it with `RenderAssetUsages::MAIN_WORLD` as well".into());
    }
    let (width, height) = (image.width(), image.height());
    let texel = |x, y| {
        // Colours come in the space that the image is stored in.
        let [r, g, b, a] = match image.get_color_at(x, y)? {
            Color::Srgba(color) => [color.red, color.green, color.blue, color.alpha],
            Color::LinearRgba(color) => [color.red, color.green, color.blue, color.alpha],
            other => {
                let color = other.to_linear();
                [color.red, color.green, color.blue, color.alpha]
            }
        };
        Ok([r, g, b, a].map(|channel| (channel.clamp(0.0, 1.0) * 255.0).round() as u8))
    };
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let texels = places.map(|(x, y)| texel(x, y)).collect::<Result<Vec<_>, TextureAccessError>>();
    let texels = texels.map_err(|error| {
        let format = image.texture_descriptor.format;
        format!("{error}; save it in an uncompressed format such as PNG (its format is {format:?})")
    })?;
    MaskImage::new(width, height, texels).map_err(|error: MaskError| error.to_string())
}
