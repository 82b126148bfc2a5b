//! Reads texture images as they are stored.

use std::{
    collections::{BTreeMap, btree_map::Entry},
    sync::Arc,
};

use super::{GltfError, container::Container};
use crate::bake::{media::media_type, model::Image, warning::BakeWarning};

/// Bytes of an image, and its media type if it is a data URI; `None` if they cannot be read.
type Stored = Option<(Arc<[u8]>, Option<String>)>;

/// Reads all images of a file. Those with the same buffer view or URI share their bytes, so a file of many images takes
/// no more memory than there is data. Those that are files of their own and cannot be read stay references.
pub fn read(container: &Container, warnings: &mut Vec<BakeWarning>) -> Result<Vec<Image>, GltfError> {
    let mut views: BTreeMap<usize, Arc<[u8]>> = BTreeMap::new();
    let mut uris: BTreeMap<&str, Stored> = BTreeMap::new();
    let mut unreadable: Vec<(String, String)> = Vec::new();
    let mut images = Vec::with_capacity(container.document.images.len());
    for (i, image) in container.document.images.iter().enumerate() {
        let what = format!("image {i}");
        let mut rest = image.rest.clone();
        let (bytes, media) = match (&image.uri, image.buffer_view) {
            (_, Some(view)) => {
                let bytes = match views.entry(view) {
                    Entry::Occupied(known) => known.get().clone(),
                    Entry::Vacant(free) => free.insert(container.view(view, &what)?.into()).clone(),
                };
                (bytes, None)
            }
            (Some(uri), None) => {
                let stored = match uris.entry(uri) {
                    Entry::Occupied(known) => known.get().clone(),
                    Entry::Vacant(free) => {
                        let stored = match container.load_uri(uri, &what) {
                            Ok((bytes, media)) => Some((bytes.into(), media)),
                            Err(GltfError::External { uri, cause, .. }) => {
                                unreadable.push((uri, cause));
                                None
                            }
                            Err(other) => return Err(other),
                        };
                        free.insert(stored).clone()
                    }
                };
                stored.unwrap_or_else(|| {
                    rest.insert("uri".into(), uri.clone().into());
                    Default::default()
                })
            }
            (None, None) => Default::default(),
        };
        // Declarations are wrong now and then; what is not known by its bytes may be of an extension.
        let declared = || image.mime_type.clone().or(media).unwrap_or_else(|| "image/png".into());
        let mime_type = media_type(&bytes).map_or_else(declared, str::to_owned);
        images.push(Image { name: image.name.clone(), mime_type, bytes, rest });
    }
    if let Some((first, cause)) = unreadable.first().cloned() {
        warnings.push(BakeWarning::ImagesUnreadable { count: unreadable.len(), first, cause });
    }
    Ok(images)
}
