//! Brings stained materials up to date with the prop's own material and the coating's shading.

use bevy::{
    asset::{AssetEvent, Assets},
    color::{Color, ColorToComponents, LinearRgba},
    ecs::{
        change_detection::{DetectChanges, DetectChangesMut, Ref},
        message::MessageReader,
        system::{Query, Res, ResMut},
    },
    pbr::{MeshMaterial3d, StandardMaterial},
    platform::collections::HashSet,
};

use super::{dress::CoatedMaterial, extension::StainedMaterial};
use crate::{api::links::FilmSource, appearance::shading::StainPart, display::film_display::FilmDisplay};

/// Copies the prop's own materials that were loaded, edited or swapped to the stained ones.
pub(in crate::display) fn follow_standard_materials(
    mut events: MessageReader<AssetEvent<StandardMaterial>>,
    props: Query<(Ref<CoatedMaterial>, &MeshMaterial3d<StainedMaterial>)>,
    own: Res<Assets<StandardMaterial>>,
    mut stained: ResMut<Assets<StainedMaterial>>,
) {
    let changed: HashSet<_> = events
        .read()
        .filter_map(|event| match event {
            AssetEvent::Added { id } | AssetEvent::Modified { id } => Some(*id),
            _ => None,
        })
        .collect();
    for (coated, worn) in &props {
        let swapped = coated.is_changed() && !coated.is_added();
        if !swapped && !changed.contains(&coated.0.id()) {
            continue;
        }
        if let Some(base) = own.get(&coated.0)
            && let Some(mut material) = stained.get_mut(&worn.0)
        {
            material.base = base.clone();
        }
    }
}

/// Hands changed shadings and directions of streaks to all materials of a film.
pub(in crate::display) fn follow_paint(
    mut films: Query<(&FilmSource, &mut FilmDisplay)>,
    props: Query<&MeshMaterial3d<StainedMaterial>>,
    mut stained: ResMut<Assets<StainedMaterial>>,
) {
    for (source, mut display) in &mut films {
        if !display.materials_outdated {
            continue;
        }
        let display = display.bypass_change_detection();
        display.materials_outdated = false;
        let fronts = source.slots.iter().filter_map(|&slot| props.get(slot).ok()).map(|worn| &worn.0);
        for handle in fronts.chain(display.parts.stained()) {
            let Some(mut material) = stained.get_mut(handle) else { continue };
            let paint = &display.paint;
            if material.extension.shading != paint.shading || material.extension.pattern != paint.pattern {
                material.extension.shading = paint.shading.clone();
                material.extension.pattern = paint.pattern;
            }
            if material.extension.part == StainPart::Back {
                let primer = Color::LinearRgba(LinearRgba::from_vec3(paint.shading.primer.color));
                if material.base.base_color != primer {
                    material.base.base_color = primer;
                }
            }
        }
    }
}
