//! Defines [`FilmPaint`], which says how the stains of a film are drawn.

use bevy::math::Vec3;

use crate::{
    api::{coating::Coating, stain_display::StainDisplay},
    appearance::shading::{FilmShading, StainPart, StainPattern, StainSample, SurfaceShading},
};

/// Difference (1 - cosine) below which two directions of streaks are the same: about a degree.
const SAME_DIRECTION: f32 = 1.5e-4;

/// Display mode, colours and patterns of a film's stains, as its meshes and materials need them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FilmPaint {
    /// Way in which stains are drawn.
    pub display: StainDisplay,
    /// Colours and strengths.
    pub shading: FilmShading,
    /// Placement of the patterns.
    pub pattern: StainPattern,
}

impl FilmPaint {
    /// Returns the paint of a film of `coating` with `seed` on which stains have run along `streaks`.
    pub fn new(coating: &Coating, seed: u64, streaks: Vec3) -> Self {
        Self {
            display: coating.stain_display,
            shading: coating.shading.clone(),
            pattern: StainPattern::new(seed, streaks),
        }
    }

    /// Sets the direction of streaks and returns whether it changed noticeably; small changes are left out.
    pub fn turn(&mut self, streaks: Vec3) -> bool {
        let (old, new) = (self.pattern.streaks, streaks.normalize_or_zero());
        let turned = old.dot(new) < 1.0 - SAME_DIRECTION && old != new;
        if turned {
            self.pattern.streaks = new;
        }
        turned
    }

    /// Returns the stained colour of one vertex of `part` whose own colour is `own`. Detail finer than `edge`, the
    /// distance between vertices in metres, is averaged.
    pub fn color(&self, part: StainPart, own: [f32; 4], sample: &StainSample, edge: f32) -> [f32; 4] {
        let [red, green, blue, alpha] = own;
        let own = SurfaceShading { base_color: Vec3::new(red, green, blue), ..self.shading.primer.surface() };
        let base = if part == StainPart::Back { self.shading.primer.surface() } else { own };
        let pattern = self.pattern.with_footprint(edge);
        let shading = self.shading.part(part, base, sample, &pattern);
        shading.base_color.extend(alpha).to_array()
    }
}
