//! Brings stained materials up to date with the prop's own material and the coating's shading.

use bevy::{
    asset::{AssetEvent, Assets},
    ecs::{
        change_detection::{DetectChanges, DetectChangesMut, Ref},
        message::MessageReader,
        system::{Query, Res, ResMut},
    },
    pbr::{MeshMaterial3d, StandardMaterial},
    platform::collections::HashSet,
};

use super::{dress::CoatedMaterial, extension::StainedMaterial};
use crate::{api::links::FilmSource, display::film_display::FilmDisplay};

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

/// Hands changed shadings and directions of streaks to the materials of a film's fronts.
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
        for worn in source.slots.iter().filter_map(|&slot| props.get(slot).ok()) {
            let Some(mut material) = stained.get_mut(&worn.0) else { continue };
            let paint = &display.paint;
            if material.extension.shading != paint.shading || material.extension.pattern != paint.pattern {
                material.extension.shading = paint.shading.clone();
                material.extension.pattern = paint.pattern;
            }
        }
    }
}
