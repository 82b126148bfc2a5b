//! Baking: a model file is aged with the paint of the chosen prop, and written beside it.

use bevy_egui::egui::{Button, CollapsingHeader, ProgressBar, TextEdit, Ui};

use super::{
    action::Action,
    bake_job::written_name,
    cell::{ROW, cell, text},
    state::CoatingPanel,
    view::View,
    widget::PanelWidget,
};

/// Adds the group.
pub(super) fn show(ui: &mut Ui, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    let header = CollapsingHeader::new("Bake a model").id_salt("bake").default_open(false);
    let group = header.show_unindented(ui, |ui| {
        ui.horizontal(|ui| {
            text(ui, 44.0, "model");
            let edit = TextEdit::singleline(&mut panel.model).desired_width(196.0).hint_text("barrel.glb");
            let model = cell(ui, 204.0, |ui| ui.add(edit));
            panel.places.insert(PanelWidget::Model, model.rect);
            let is_free = view.baked.is_none() && !panel.model.trim().is_empty() && view.settings.is_some();
            let bake = ui.add_enabled_ui(is_free, |ui| ui.add_sized([62.0, ROW], Button::new("Bake"))).inner;
            panel.places.insert(PanelWidget::Bake, bake.rect);
            let hint = "ages the model to the age of the chosen prop, with its settings, seed, resolution, masks and \
                        detail, in still air; the prop stays as it is";
            if bake.on_hover_text(hint).clicked() {
                actions.push(Action::Bake);
            }
        });
        ui.horizontal(|ui| match view.baked {
            Some(done) => {
                ui.add_sized([ui.available_width(), ROW], ProgressBar::new(done));
            }
            None => {
                let into = written_name(&panel.model).map_or(String::new(), |name| format!("into {}", name.display()));
                text(ui, ui.available_width(), into);
            }
        });
    });
    panel.places.insert(PanelWidget::BakeGroup, group.header_response.rect);
}
