//! Reads texture images as they are stored.

use super::{GltfError, container::Container};
use crate::bake::{media::media_type, model::Image, warning::BakeWarning};

/// Reads all images of a file. Those that are files of their own and cannot be read stay references.
pub fn read(container: &Container, warnings: &mut Vec<BakeWarning>) -> Result<Vec<Image>, GltfError> {
    let mut unreadable = (0, None);
    let mut images = Vec::new();
    for (i, image) in container.document.images.iter().enumerate() {
        let what = format!("image {i}");
        let mut rest = image.rest.clone();
        let (bytes, media) = match (&image.uri, image.buffer_view) {
            (_, Some(view)) => (container.view(view, &what)?.to_vec(), None),
            (Some(uri), None) => match container.load_uri(uri, &what) {
                Ok(found) => found,
                Err(GltfError::External { uri: first, cause, .. }) => {
                    unreadable.0 += 1;
                    unreadable.1.get_or_insert((first, cause));
                    rest.insert("uri".into(), uri.clone().into());
                    (Vec::new(), None)
                }
                Err(other) => return Err(other),
            },
            (None, None) => (Vec::new(), None),
        };
        // Declarations are wrong now and then; what is not known by its bytes may be of an extension.
        let declared = || image.mime_type.clone().or(media).unwrap_or_else(|| "image/png".into());
        let mime_type = media_type(&bytes).map_or_else(declared, str::to_owned);
        images.push(Image { name: image.name.clone(), mime_type, bytes, rest });
    }
    if let (count, Some((first, cause))) = unreadable {
        warnings.push(BakeWarning::ImagesUnreadable { count, first, cause });
    }
    Ok(images)
}
