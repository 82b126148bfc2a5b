//! Finds the edges at which what is drawn on the prop's surface jumps: the film always follows them.

use super::attributes::Attributes;
use crate::{
    film::{FaceId, HalfEdgeId},
    rest::Rest,
    surface::{CleanSurface, Surface},
};

/// Corner attributes, slots and winding of a clean surface.
pub(super) struct Seams<'a> {
    surface: &'a Surface,
    clean: &'a CleanSurface,
    pub attributes: Attributes,
}

impl<'a> Seams<'a> {
    pub async fn new(surface: &'a Surface, clean: &'a CleanSurface, rest: &mut impl Rest) -> Self {
        Self { surface, clean, attributes: Attributes::new(surface, clean, rest).await }
    }

    /// Returns whether the two faces at an edge differ in slot, winding or an attribute. Where the film must be
    /// `exact`, smaller differences count too.
    pub fn divide(&self, h: HalfEdgeId, t: HalfEdgeId, exact: bool) -> bool {
        let (f, g) = (h.face(), t.face());
        self.slot(f) != self.slot(g) || self.is_flipped(f) != self.is_flipped(g) || self.attributes.jump(h, t, exact)
    }

    fn slot(&self, f: FaceId) -> u32 {
        let source = self.clean.source.get(f.index());
        source.and_then(|&t| self.surface.slots.get(t as usize)).copied().unwrap_or_default()
    }

    fn is_flipped(&self, f: FaceId) -> bool {
        self.clean.flipped.get(f.index()).copied().unwrap_or_default()
    }
}
