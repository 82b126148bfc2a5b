//! Does what was asked for by widgets.

use bevy::ecs::{change_detection::DetectChangesMut, entity::Entity};

use super::{
    action::Action,
    files,
    seen::Seen,
    state::CoatingPanel,
    view::{PanelWorld, settings_of},
};
use crate::{
    api::{heat_map_view::HeatMapView, paint::SettingsSource},
    gizmos::CoatingGizmos,
    settings::CoatingSettings,
    stepping::TouchCommands,
    timeline::CoatingCommands,
};

/// Does `action`.
pub(super) fn apply(action: Action, panel: &mut CoatingPanel, world: &mut PanelWorld) {
    match action {
        Action::Choose(prop) => {
            panel.prop = Some(prop);
            if let Ok(prop) = world.props.get(prop) {
                panel.rebase(settings_of(prop.coating, &world.assets));
            }
        }
        Action::Set(field, value) => change(panel, world, |settings| {
            // The row asks for values in range only.
            let _ = field.set(settings, value);
        }),
        Action::ResetAll => {
            let base = panel.base.clone();
            change(panel, world, |settings| settings.clone_from(&base));
        }
        Action::Preset(preset) => load(panel, world, preset.name(), &preset.into()),
        Action::LoadFile => match files::load(&panel.file) {
            Ok(settings) => {
                let file = panel.file.clone();
                load(panel, world, &file, &settings);
            }
            Err(error) => panel.message = error.to_string(),
        },
        Action::SaveFile => {
            let coating = panel.prop.and_then(|prop| world.props.get(prop).ok());
            let settings = coating.as_ref().and_then(|prop| settings_of(prop.coating, &world.assets));
            if let Some(settings) = settings {
                let saved = files::save(&panel.file, settings);
                panel.seen = Seen::look(&panel.file);
                panel.message = match saved {
                    Ok(()) => format!("saved {}", panel.file),
                    Err(error) => error.to_string(),
                };
            }
        }
        Action::FollowFile(follows) => {
            panel.follows_file = follows;
            panel.seen = Seen::look(&panel.file);
        }
        #[cfg(feature = "bake")]
        Action::Bake => {
            let coating = panel.prop.and_then(|prop| world.props.get(prop).ok()).map(|prop| (prop.coating, prop.seed));
            if let Some((coating, seed)) = coating
                && let Some(settings) = settings_of(coating, &world.assets)
            {
                let age = world.films.iter().filter(|(by, ..)| Some(by.0) == panel.prop).map(|(_, c, ..)| c.age());
                let age = age.fold(0.0, f64::max);
                panel.message = world.bake.begin(&panel.model, coating, seed.map_or(0, |seed| seed.0), settings, age);
            }
        }
        Action::Heat(map) => {
            for prop in targets(panel, world) {
                match map {
                    Some(map) => world.commands.entity(prop).try_insert(HeatMapView::new(map)),
                    None => world.commands.entity(prop).try_remove::<HeatMapView>(),
                };
            }
        }
        Action::Gizmos(on) => {
            if let Some(store) = &mut world.gizmos
                && store.get_config::<CoatingGizmos>().is_some()
            {
                store.config_mut::<CoatingGizmos>().0.enabled = on;
            }
        }
        Action::Brush(brush) => {
            if let Some(held) = &mut world.brush {
                held.set_if_neq(brush);
            }
        }
        Action::Undo => targets(panel, world).into_iter().for_each(|prop| {
            world.commands.entity(prop).undo_touch();
        }),
        Action::Redo => targets(panel, world).into_iter().for_each(|prop| {
            world.commands.entity(prop).redo_touch();
        }),
        Action::SaveState => save_state(panel, world),
        Action::RestoreState => restore_state(panel, world),
        Action::Pause(paused) => world.clock.paused = paused,
        Action::Step => {
            world.clock.paused = true;
            world.clock.request_steps(1);
        }
        Action::Speed(speed) => world.clock.age_per_second = speed,
        Action::Age(age) => {
            world.clock.paused = true;
            let roots = targets(panel, world);
            for (coated_by, mut clock, ..) in &mut world.films {
                if roots.contains(&coated_by.0) {
                    clock.seek(age);
                }
            }
        }
    }
}

/// Returns the props on which changes act.
fn targets(panel: &CoatingPanel, world: &PanelWorld) -> Vec<Entity> {
    if panel.all_props {
        world.props.iter().map(|prop| prop.entity).collect()
    } else {
        panel.prop.into_iter().collect()
    }
}

/// Changes the settings of the props on which changes act. Settings that were an asset become the prop's own, so that
/// others with the same asset stay as they are.
fn change(panel: &CoatingPanel, world: &mut PanelWorld, change: impl Fn(&mut CoatingSettings)) {
    for target in targets(panel, world) {
        let Ok(mut prop) = world.props.get_mut(target) else { continue };
        let Some(settings) = settings_of(&prop.coating, &world.assets) else { continue };
        let mut settings = settings.clone();
        change(&mut settings);
        // `Coating` is compared as a whole, so a value that stays touches nothing.
        let coating = prop.coating.bypass_change_detection();
        let changed = SettingsSource::Inline(settings);
        if coating.settings != changed {
            coating.settings = changed;
            prop.coating.set_changed();
        }
    }
}

/// Gives `settings`, called `name`, to the props on which changes act. Resetting goes back to them from then on.
fn load(panel: &mut CoatingPanel, world: &mut PanelWorld, name: &str, settings: &CoatingSettings) {
    panel.set_base(name, settings);
    panel.message = format!("loaded {name}");
    change(panel, world, |own| own.clone_from(settings));
}

fn save_state(panel: &mut CoatingPanel, world: &mut PanelWorld) {
    let Some(prop) = panel.prop else { return };
    let ages = world.films.iter().filter(|(coated_by, ..)| coated_by.0 == prop).map(|(_, clock, ..)| clock.age());
    if let Some(age) = ages.reduce(f64::max) {
        panel.saved.insert(prop, age);
        world.commands.entity(prop).save_films();
    }
}

fn restore_state(panel: &CoatingPanel, world: &mut PanelWorld) {
    let Some(prop) = panel.prop else { return };
    if let Ok(found) = world.props.get(prop)
        && let Some(snapshot) = found.snapshot
    {
        world.clock.paused = true;
        world.commands.entity(prop).restore_films(snapshot.clone());
    }
}
