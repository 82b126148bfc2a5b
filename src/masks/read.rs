//! Reads lists of masks.

use super::{effect::CoatingMask, error::MaskError};

/// Reads a list of masks from RON, and checks them. `file` is its name in errors.
///
/// ```ron
/// // hull.masks.ron
/// [
///     (mask: Edges(reach: 0.02), effect: (adhesion: (1.0, 0.3))),
///     (mask: Texture((image: "dirt.png")), effect: (dust: (0.0, 1.0))),
/// ]
/// ```
///
/// # Errors
/// [`MaskError::Text`] with the place in the text, or [`MaskError::InFile`] for a value out of its range.
///
/// ```
/// use bevy_coating::masks::read_masks;
///
/// let masks = read_masks("[(mask: Edges(), effect: (binding: (1.0, 0.5)))]", "hull.masks.ron")?;
/// assert_eq!(masks.len(), 1);
/// let error = read_masks("[(mask: Egdes(), effect: ())]", "hull.masks.ron").unwrap_err().to_string();
/// assert!(error.starts_with("hull.masks.ron:1:") && error.contains("Edges"), "{error}");
/// # Ok::<(), bevy_coating::masks::MaskError>(())
/// ```
pub fn read_masks(text: &str, file: &str) -> Result<Vec<CoatingMask>, MaskError> {
    let masks: Vec<CoatingMask> = ron::from_str(text).map_err(|error| MaskError::Text {
        file: file.into(),
        line: error.span.start.line,
        column: error.span.start.col,
        cause: error.code.to_string(),
    })?;
    for (i, mask) in masks.iter().enumerate() {
        mask.validate().map_err(|source| MaskError::InFile {
            file: file.into(),
            number: i + 1,
            source: Box::new(source),
        })?;
    }
    Ok(masks)
}
