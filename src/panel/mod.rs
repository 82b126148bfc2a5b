//! A panel for all that can be set and seen of films, drawn with egui.
//!
//! | place | contents |
//! |---|---|
//! | left | every setting of the chosen prop by the paper's stages, presets, files, and baking (feature `bake`) |
//! | right | props, heat map and gizmos, brush, figures over age, times of stages, saved state |
//! | bottom | clock: run, step, speed, and a bar that goes to any age |
//!
//! Each frame goes through three hands: [`view`] collects what there is to see, the parts of the panel draw it and
//! return [actions](action::Action), and [`apply`] does them. So nothing is touched unless somebody touched a widget.

mod action;
mod apply;
#[cfg(feature = "bake")]
mod bake_group;
#[cfg(feature = "bake")]
mod bake_job;
mod bar;
mod brush_group;
mod cell;
mod figures;
mod files;
mod followed;
mod legend;
mod past;
mod plot;
mod row;
mod seen;
mod settings_side;
mod state;
mod statistics;
mod view;
mod watch_side;
mod widget;

use bevy::{
    app::{App, Plugin, PostUpdate, PreUpdate},
    ecs::{error::Result, schedule::IntoScheduleConfigs, system::ResMut},
    gizmos::GizmoPlugin,
    log::warn,
};
use bevy_egui::{
    EguiContexts, EguiPlugin, EguiPrimaryContextPass,
    egui::{self, Color32, FontId, LayerId, TextStyle, Ui, UiBuilder},
};

pub use state::CoatingPanel;
pub use widget::PanelWidget;

use crate::gizmos::CoatingGizmosPlugin;

/// Width of the settings at the left, in points.
const LEFT: f32 = 356.0;
/// Width of what there is to watch at the right, in points.
const RIGHT: f32 = 276.0;
/// Height of the clock at the bottom, in points.
const BOTTOM: f32 = 44.0;

/// Plugin of the panel. Add it after `DefaultPlugins`, `CoatingWeatheringPlugin` and
/// [`EguiPlugin`](bevy_egui::EguiPlugin), which it does not add by itself, as an app may have only one and sets it up
/// its own way. Without an `EguiPlugin` a warning says so, and there is no panel.
///
/// It is drawn in the primary context of egui, at both sides and at the bottom of the view. It fits into 1280 by 720
/// points. [`CoatingPanel`] opens and closes it.
///
/// ```no_run
/// use bevy::prelude::*;
/// use bevy_coating::{CoatingPanelPlugin, prelude::*};
/// use bevy_egui::EguiPlugin;
///
/// App::new()
///     .add_plugins((DefaultPlugins, EguiPlugin::default()))
///     .add_plugins((CoatingWeatheringPlugin::default(), CoatingPanelPlugin))
///     .run();
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct CoatingPanelPlugin;

impl Plugin for CoatingPanelPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<CoatingPanel>().init_resource::<statistics::Statistics>();
        if app.is_plugin_added::<GizmoPlugin>() && !app.is_plugin_added::<CoatingGizmosPlugin>() {
            app.add_plugins(CoatingGizmosPlugin);
        }
        #[cfg(feature = "bake")]
        app.init_resource::<bake_job::BakeJob>().add_systems(PreUpdate, bake_job::finish_baking);
        app.add_systems(PreUpdate, (past::keep_past, followed::follow_file).run_if(state::is_open))
            .add_systems(PostUpdate, statistics::record.run_if(state::is_open))
            .add_systems(EguiPrimaryContextPass, show_panel.run_if(state::is_open));
    }

    /// Warns if there is no egui to draw with.
    fn finish(&self, app: &mut App) {
        if !app.is_plugin_added::<EguiPlugin>() {
            warn!(
                "there is no panel for coatings: add `EguiPlugin::default()` of `bevy_egui` to the app, which \
                 `CoatingPanelPlugin` leaves to you"
            );
        }
    }
}

/// Draws the panel and does what was asked for.
fn show_panel(mut contexts: EguiContexts, mut panel: ResMut<CoatingPanel>, mut world: view::PanelWorld) -> Result {
    let context = contexts.ctx_mut()?.clone();
    let view = world.view(&mut panel);
    let mut actions = Vec::new();
    if std::mem::take(&mut panel.file_has_changed) {
        actions.push(action::Action::LoadFile);
    }
    let area = UiBuilder::new().layer_id(LayerId::background()).max_rect(context.viewport_rect());
    let mut root = Ui::new(context, "coating panel".into(), area);
    make_small(&mut root);
    let bottom = egui::Panel::bottom("coating clock").exact_size(BOTTOM).resizable(false);
    let bottom = bottom.show(&mut root, |ui| bar::show(ui, &view, &mut panel, &mut actions));
    panel.places.insert(PanelWidget::Bottom, bottom.response.rect);
    let left = egui::Panel::left("coating settings").exact_size(LEFT).resizable(false);
    let left = left.show(&mut root, |ui| settings_side::show(ui, &view, &mut panel, &mut actions));
    panel.places.insert(PanelWidget::Left, left.response.rect);
    let right = egui::Panel::right("coating watch").exact_size(RIGHT).resizable(false);
    let right = right.show(&mut root, |ui| watch_side::show(ui, &view, &mut panel, &mut actions));
    panel.places.insert(PanelWidget::Right, right.response.rect);
    // What happens over the panel belongs to it, and not to the brush.
    let sides = [bottom, left, right].map(|side| side.response.rect);
    let pointer = root.ctx().input(|input| input.pointer.interact_pos());
    let is_over = root.ctx().egui_is_using_pointer()
        || pointer.is_some_and(|pointer| sides.iter().any(|side| side.contains(pointer)));
    if let Some(brush) = world.brush.as_mut().filter(|brush| brush.blocked != is_over) {
        brush.blocked = is_over;
    }
    for action in actions {
        apply::apply(action, &mut panel, &mut world);
    }
    Ok(())
}

/// Makes text and rows small enough for all of it, and text bright enough at that size.
fn make_small(ui: &mut Ui) {
    let style = ui.style_mut();
    for (text, size) in [(TextStyle::Body, 12.0), (TextStyle::Button, 12.0), (TextStyle::Small, 10.0)] {
        style.text_styles.insert(text, FontId::proportional(size));
    }
    style.text_styles.insert(TextStyle::Monospace, FontId::monospace(11.5));
    style.text_styles.insert(TextStyle::Heading, FontId::proportional(14.0));
    let widgets = &mut style.visuals.widgets;
    if style.visuals.dark_mode {
        widgets.noninteractive.fg_stroke.color = Color32::from_gray(190);
        widgets.inactive.fg_stroke.color = Color32::from_gray(210);
        style.visuals.weak_text_alpha = 0.7;
    }
    style.spacing.item_spacing = egui::vec2(4.0, 3.0);
    style.spacing.interact_size.y = cell::ROW;
    style.spacing.button_padding = egui::vec2(5.0, 1.0);
}
