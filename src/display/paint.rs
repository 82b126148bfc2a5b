//! How the stains of a film are shown, as its coating has it.

use bevy::{
    ecs::{
        change_detection::{DetectChanges, DetectChangesMut, Ref},
        system::Query,
    },
    math::Vec3,
};

use super::FilmDisplay;
use crate::{
    api::{coating::Coating, links::CoatedBy, stain_display::StainDisplay},
    appearance::{
        DisplayChanges,
        shading::{FilmShading, StainPart, StainPattern, StainSample, SurfaceShading},
    },
    stain::StainFields,
};
/// Streaks whose direction differs by less (1 - cosine) are the same: about a degree.
const SAME_DIRECTION: f32 = 1.5e-4;

/// What a film's meshes and materials must be told to show its stains.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FilmPaint {
    pub display: StainDisplay,
    pub shading: FilmShading,
    pub pattern: StainPattern,
}

impl FilmPaint {
    /// That of a film of `coating` on which stains have run along `streaks`.
    pub fn new(coating: &Coating, streaks: Vec3) -> Self {
        Self {
            display: coating.stain_display,
            shading: coating.shading.clone(),
            pattern: StainPattern::new(coating.seed, streaks),
        }
    }

    /// The same, with streaks along `streaks`; as it is where they run that way already.
    fn turn(&mut self, streaks: Vec3) -> bool {
        let (old, new) = (self.pattern.streaks, streaks.normalize_or_zero());
        let turned = old.dot(new) < 1.0 - SAME_DIRECTION && old != new;
        if turned {
            self.pattern.streaks = new;
        }
        turned
    }

    /// Colour of one vertex of `part` whose own colour is `own`. Detail finer than `edge`, the distance between
    /// vertices, is averaged.
    pub fn color(&self, part: StainPart, own: [f32; 4], sample: &StainSample, edge: f32) -> [f32; 4] {
        let [red, green, blue, alpha] = own;
        let own = SurfaceShading { base_color: Vec3::new(red, green, blue), ..self.shading.primer.surface() };
        let base = if part == StainPart::Back { self.shading.primer.surface() } else { own };
        let pattern = self.pattern.with_footprint(edge);
        let shading = self.shading.part(part, base, sample, &pattern);
        shading.base_color.extend(alpha).to_array()
    }
}

/// Hands changed looks, displays and directions of streaks to the films.
pub(super) fn follow_coatings(
    coatings: Query<Ref<Coating>>,
    mut films: Query<(&CoatedBy, Ref<StainFields>, &mut DisplayChanges, &mut FilmDisplay)>,
) {
    for (coated_by, stains, mut changes, mut display) in &mut films {
        let Ok(coating) = coatings.get(coated_by.0) else { continue };
        let new = display.is_added();
        let display = display.bypass_change_detection();
        let turned = (new || stains.is_changed()) && display.paint.turn(stains.streaks);
        if !(new || coating.is_changed() || turned) {
            continue;
        }
        let paint = FilmPaint::new(&coating, display.paint.pattern.streaks);
        if !turned && paint == display.paint {
            continue;
        }
        let other = paint.display != display.paint.display;
        display.paint = paint;
        #[cfg(feature = "render")]
        {
            display.materials_outdated = true;
        }
        let changes = changes.bypass_change_detection();
        changes.stains = true;
        // Stains shown in another way are another layout of the meshes.
        changes.topology |= other;
        changes.exposure |= other;
    }
}
