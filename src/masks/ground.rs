//! Inputs of masks beside the film.

use bevy_math::Vec3;

use super::image::MaskImages;
use crate::{remesh::BuiltFilm, surface::Surface};

/// Inputs of masks beside the film: the prop that it is on, gravity, and images.
#[derive(Clone, Copy, Debug)]
pub struct MaskGround<'a> {
    /// Surface of the prop.
    pub surface: &'a Surface,
    /// Film as it was built on the surface.
    pub built: &'a BuiltFilm,
    /// Direction of gravity in the film's space, of any length; zero in weightlessness.
    pub gravity: Vec3,
    /// Images that texture masks name.
    pub images: &'a MaskImages,
}
