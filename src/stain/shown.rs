//! Decides when stains look different: once any differs by more than display can show from what it was.

use bevy_math::Vec3;

use super::{fields::StainFields, layer::StainLayer};

/// Change of a value from 0 to 1 up to which it looks the same: a step of a colour of 8 bits.
const STEP: f32 = 1.0 / 255.0;

/// Layers of rust beyond which more rust looks the same. Without this limit almost the whole edge between a vertex with
/// many layers and a clean vertex would be covered, and stains would show the outlines of triangles.
pub(crate) const MOST_LAYERS: f32 = 1.0;

/// Stains as they were when they last counted as changed. Whatever creeps adds up against them, so that no change is
/// missed for being slow.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Shown {
    film: Vec<[f32; 4]>,
    metal: Vec<[f32; 4]>,
    /// Unit vector along the streaks, or zero.
    streaks: Vec3,
}

/// Returns what display shows of each vertex of `layer`; `None` for a vertex that has no faces.
fn looks<'a>(layer: &'a StainLayer, corrosion: &'a [f32]) -> impl Iterator<Item = Option<[f32; 4]>> + 'a {
    (0..layer.areas.len()).map(move |v| {
        let corrosion = corrosion.get(v).copied().unwrap_or_default();
        let rust = layer.rust(v);
        let rust = if rust < MOST_LAYERS { rust } else { MOST_LAYERS };
        (layer.areas[v] > 0.0).then(|| [rust, layer.dust[v], layer.moisture[v], corrosion])
    })
}

impl Shown {
    /// Returns whether any stain looks different from how it was shown.
    fn differs(&self, stains: &StainFields) -> bool {
        let far = |(now, shown): (Option<[f32; 4]>, &[f32; 4])| {
            now.is_some_and(|now| now.iter().zip(shown).any(|(now, shown)| !((now - shown).abs() <= STEP)))
        };
        self.film.len() != stains.film.areas.len()
            || self.metal.len() != stains.metal.areas.len()
            || self.streaks.distance_squared(stains.streaks.normalize_or_zero()) > STEP * STEP
            || looks(&stains.film, &[]).zip(&self.film).any(far)
            || looks(&stains.metal, &stains.corrosion).zip(&self.metal).any(far)
    }
}

impl StainFields {
    /// Counts stains as changed if they look different from when they last did.
    pub(super) fn revise_if_seen(&mut self) {
        if self.shown.differs(self) {
            self.revise();
        }
    }

    /// Counts stains as changed.
    pub(super) fn revise(&mut self) {
        self.revision = self.revision.wrapping_add(1);
        let Shown { mut film, mut metal, .. } = std::mem::take(&mut self.shown);
        film.clear();
        film.extend(looks(&self.film, &[]).map(Option::unwrap_or_default));
        metal.clear();
        metal.extend(looks(&self.metal, &self.corrosion).map(Option::unwrap_or_default));
        self.shown = Shown { film, metal, streaks: self.streaks.normalize_or_zero() };
    }
}
