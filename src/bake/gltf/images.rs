//! Reads texture images as they are stored.

use super::{GltfError, container::Container};
use crate::bake::model::Image;

/// Reads all images of a file.
pub fn read(container: &Container) -> Result<Vec<Image>, GltfError> {
    container
        .document
        .images
        .iter()
        .enumerate()
        .map(|(i, image)| {
            let what = format!("image {i}");
            let (bytes, media) = match (&image.uri, image.buffer_view) {
                (_, Some(view)) => (container.view(view, &what)?.to_vec(), None),
                (Some(uri), None) => container.load_uri(uri, &what)?,
                (None, None) => (Vec::new(), None),
            };
            let mime_type = image.mime_type.clone().or(media).unwrap_or_else(|| sniff(&bytes).into());
            Ok(Image { name: image.name.clone(), mime_type, bytes, rest: image.rest.clone() })
        })
        .collect()
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
