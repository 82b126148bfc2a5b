//! Reads texture images as they are stored.

use std::{collections::BTreeMap, sync::Arc};

use super::{GltfError, container::Container};
use crate::bake::model::Image;

/// Bytes of an image, and its media type if it is a data URI.
type Stored = (Arc<[u8]>, Option<String>);

/// Reads all images of a file. Those with the same buffer view or URI share their bytes, so a file of many images takes
/// no more memory than there is data.
pub fn read(container: &Container) -> Result<Vec<Image>, GltfError> {
    let mut views: BTreeMap<usize, Arc<[u8]>> = BTreeMap::new();
    let mut uris: BTreeMap<&str, Stored> = BTreeMap::new();
    let mut images = Vec::with_capacity(container.document.images.len());
    for (i, image) in container.document.images.iter().enumerate() {
        let what = format!("image {i}");
        let (bytes, media) = match (&image.uri, image.buffer_view) {
            (_, Some(view)) => {
                if !views.contains_key(&view) {
                    views.insert(view, container.view(view, &what)?.into());
                }
                (views.get(&view).cloned().unwrap_or_default(), None)
            }
            (Some(uri), None) => {
                if !uris.contains_key(uri.as_str()) {
                    let (bytes, media) = container.load_uri(uri, &what)?;
                    uris.insert(uri, (bytes.into(), media));
                }
                uris.get(uri.as_str()).cloned().unwrap_or_default()
            }
            (None, None) => Stored::default(),
        };
        let mime_type = image.mime_type.clone().or(media).unwrap_or_else(|| sniff(&bytes).into());
        images.push(Image { name: image.name.clone(), mime_type, bytes, rest: image.rest.clone() });
    }
    Ok(images)
}

/// Media type by the first bytes.
fn sniff(bytes: &[u8]) -> &'static str {
    match bytes {
        [0xff, 0xd8, 0xff, ..] => "image/jpeg",
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => "image/webp",
        [0xab, b'K', b'T', b'X', ..] => "image/ktx2",
        _ => "image/png",
    }
}
