//! The left side: settings by the paper's stages, presets and files.

use bevy_egui::egui::{Button, CollapsingHeader, ScrollArea, TextEdit, Ui};

#[cfg(feature = "bake")]
use super::bake_group;
use super::{
    action::Action,
    cell::{ROW, cell, text},
    row,
    state::CoatingPanel,
    view::View,
    widget::PanelWidget,
};
use crate::settings::{CoatingSettings, Field, Preset};

/// Group of settings.
struct Group {
    name: &'static str,
    /// Section of the paper; empty for what goes beyond it.
    section: &'static str,
    /// Stages of the settings, as their paths begin.
    stages: &'static [&'static str],
    /// Whether it is open at first.
    open: bool,
}

const fn group(name: &'static str, section: &'static str, stages: &'static [&'static str], open: bool) -> Group {
    Group { name, section, stages, open }
}

/// Groups in the order of the paper.
const GROUPS: [Group; 8] = [
    group("Separation", "VC 5.1", &["adhesion", "bending"], true),
    group("Tearing", "VC 5.2", &["tearing"], true),
    group("Stripping", "VC 5.3", &["stripping"], true),
    group("Bending", "VC 4", &["deform"], false),
    group("Rust", "VC 6.1", &["rust"], false),
    group("Dust", "VC 6.2", &["dust"], false),
    group("Moisture", "", &["moisture"], false),
    group("Scale", "", &["scale"], false),
];

/// Adds the settings of the chosen prop.
pub(super) fn show(ui: &mut Ui, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        ui.heading("Settings");
        ui.weak(format!("reset to: {}", panel.base_name));
    });
    let Some(settings) = &view.settings else {
        ui.weak(if view.props.is_empty() {
            "There is no entity with a `Coating`."
        } else {
            "The settings are loading."
        });
        return;
    };
    presets(ui, panel, actions);
    files(ui, panel, actions);
    ui.separator();
    ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        for group in &GROUPS {
            let title = if group.section.is_empty() {
                group.name.to_owned()
            } else {
                format!("{}   ({})", group.name, group.section)
            };
            let header = CollapsingHeader::new(title).id_salt(group.name).default_open(group.open);
            header.show_unindented(ui, |ui| {
                for field in fields(group) {
                    if let Some(value) = row::show(ui, field, settings, &view.base, &mut panel.places) {
                        actions.push(Action::Set(field, value));
                    }
                }
            });
        }
        #[cfg(feature = "bake")]
        bake_group::show(ui, view, panel, actions);
    });
}

/// Returns the settings of a group.
fn fields(group: &Group) -> impl Iterator<Item = &'static Field> {
    let stages = group.stages;
    let is_in = move |field: &&Field| field.path.split_once('.').is_some_and(|(stage, _)| stages.contains(&stage));
    CoatingSettings::fields().filter(is_in)
}

fn presets(ui: &mut Ui, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    ui.horizontal_wrapped(|ui| {
        for preset in Preset::ALL {
            let button = ui.button(preset.name());
            panel.places.insert(PanelWidget::Preset(preset.name()), button.rect);
            if button.clicked() {
                actions.push(Action::Preset(preset));
            }
        }
    });
    ui.horizontal(|ui| {
        let reset = ui.add_sized([64.0, ROW], Button::new("Reset all"));
        panel.places.insert(PanelWidget::ResetAll, reset.rect);
        if reset.clicked() {
            actions.push(Action::ResetAll);
        }
        ui.add_space(8.0);
        let all = ui.checkbox(&mut panel.all_props, "change all props");
        panel.places.insert(PanelWidget::AllProps, all.rect);
        all.on_hover_text("settings, heat maps and ages act on every prop, not only on the chosen one");
    });
}

fn files(ui: &mut Ui, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let file = cell(ui, 150.0, |ui| ui.add(TextEdit::singleline(&mut panel.file).desired_width(142.0)));
        panel.places.insert(PanelWidget::File, file.rect);
        for (name, widget, action) in
            [("Load", PanelWidget::LoadFile, Action::LoadFile), ("Save", PanelWidget::SaveFile, Action::SaveFile)]
        {
            let button = ui.add_sized([54.0, ROW], Button::new(name));
            panel.places.insert(widget, button.rect);
            if button.clicked() {
                actions.push(action);
            }
        }
        let mut follows = panel.follows_file;
        let follow = ui.checkbox(&mut follows, "follow");
        panel.places.insert(PanelWidget::FollowFile, follow.rect);
        if follow.on_hover_text("loads the file again whenever it changes on the disk").changed() {
            actions.push(Action::FollowFile(follows));
        }
    });
    ui.horizontal(|ui| {
        // Of fixed height, whether there is a message or not.
        text(ui, ui.available_width(), panel.message.as_str()).on_hover_text(&panel.message);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_is_in_one_group() {
        let mut grouped: Vec<&str> = GROUPS.iter().flat_map(fields).map(|field| field.path).collect();
        let mut all: Vec<&str> = CoatingSettings::fields().map(|field| field.path).collect();
        grouped.sort_unstable();
        all.sort_unstable();
        assert_eq!(grouped, all);
    }
}
