//! Hands changes of a coating's shading to the display of its films.

use bevy::ecs::{
    change_detection::{DetectChanges, DetectChangesMut, Ref},
    system::Query,
};

use super::{film_display::FilmDisplay, film_paint::FilmPaint};
use crate::{
    api::{
        coating::Coating,
        links::{CoatedBy, FilmSource},
    },
    appearance::DisplayChanges,
    stain::StainFields,
};

/// Hands changed shadings, display modes and directions of streaks to the films.
pub(super) fn follow_coatings(
    coatings: Query<Ref<Coating>>,
    mut films: Query<(&CoatedBy, &FilmSource, Ref<StainFields>, &mut DisplayChanges, &mut FilmDisplay)>,
) {
    for (coated_by, source, stains, mut changes, mut display) in &mut films {
        let Ok(coating) = coatings.get(coated_by.0) else { continue };
        let new = display.is_added();
        let display = display.bypass_change_detection();
        let turned = (new || stains.is_changed()) && display.paint.turn(stains.streaks);
        if !(new || coating.is_changed() || turned) {
            continue;
        }
        let paint = FilmPaint::new(&coating, source.seed, display.paint.pattern.streaks);
        if !turned && paint == display.paint {
            continue;
        }
        let other = paint.display != display.paint.display;
        display.paint = paint;
        display.repainted = true;
        // A material that has been replaced must not meet a mesh of another layout.
        display.urgent |= other;
        #[cfg(feature = "render")]
        {
            display.materials_outdated = true;
            display.parts.outdated = true;
        }
        changes.bypass_change_detection().stains = true;
    }
}
