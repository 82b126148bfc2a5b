//! The right side: props, heat maps, gizmos, figures over age, times of stages, saved state.

use bevy_egui::egui::{Button, CollapsingHeader, RichText, ScrollArea, Ui};

use super::{
    action::Action,
    bar, brush_group,
    cell::{ROW, cell, right_text, text},
    figures::PLOTS,
    legend,
    state::CoatingPanel,
    view::{PropLine, View},
    widget::PanelWidget,
};
use crate::{heat::HeatMap, survey::Ratings};

/// Height of the list of props, in points.
const PROPS: f32 = 92.0;
/// Width of a button of a heat map: four a row.
const MAP: f32 = 62.0;

/// Adds everything that there is to watch.
pub(super) fn show(ui: &mut Ui, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    ui.add_space(4.0);
    ui.heading("Props");
    props(ui, view, panel, actions);
    ui.separator();
    ui.heading("Heat map");
    maps(ui, view, panel, actions);
    brush_group::show(ui, view, panel, actions);
    ui.separator();
    ui.horizontal(|ui| {
        ui.heading("Over age");
        ratings(ui, view);
    });
    for plot in &PLOTS {
        plot.show(ui, &view.samples, view.age, bar::last_age(view));
    }
    ui.separator();
    // Where there is a brush, there is no room for both.
    let times_are_open = view.brush.is_none();
    let header =
        CollapsingHeader::new("Time of a frame").id_salt(("times", times_are_open)).default_open(times_are_open);
    header.show(ui, |ui| times(ui, view));
    ui.separator();
    state(ui, view, panel, actions);
}

fn props(ui: &mut Ui, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        text(ui, 128.0, RichText::new("name").weak().small());
        right_text(ui, 52.0, RichText::new("age").weak().small());
        right_text(ui, 64.0, RichText::new("triangles").weak().small());
    });
    ScrollArea::vertical().id_salt("props").max_height(PROPS).min_scrolled_height(PROPS).auto_shrink(false).show(
        ui,
        |ui| {
            for prop in &view.props {
                ui.push_id(prop.entity, |ui| line(ui, prop, view, panel, actions));
            }
        },
    );
}

fn line(ui: &mut Ui, prop: &PropLine, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let is_chosen = view.chosen == Some(prop.entity);
        let label = Button::selectable(is_chosen, prop.name.as_str()).truncate();
        let name = cell(ui, 128.0, |ui| ui.add(label));
        panel.places.insert(PanelWidget::Prop(prop.entity), name.rect);
        if name.on_hover_text(&prop.name).clicked() {
            actions.push(Action::Choose(prop.entity));
        }
        let age = prop.age.map_or("building".to_owned(), |age| format!("{age:.3}"));
        right_text(ui, 52.0, RichText::new(age).monospace());
        right_text(ui, 64.0, RichText::new(prop.triangles.to_string()).monospace());
    });
}

fn maps(ui: &mut Ui, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    let shown = view.heat.map(|heat| heat.map);
    let choices: Vec<Option<HeatMap>> = [None].into_iter().chain(HeatMap::ALL.map(Some)).collect();
    for row in choices.chunks(4) {
        ui.horizontal(|ui| {
            // The longest name just fits.
            ui.spacing_mut().button_padding.x = 1.0;
            for &map in row {
                let name = map.map_or("off", HeatMap::name);
                let button = ui.add_sized([MAP, ROW], Button::selectable(shown == map, name));
                panel.places.insert(PanelWidget::Heat(map), button.rect);
                if button.on_hover_text(legend::meaning(map)).clicked() {
                    actions.push(Action::Heat(map));
                }
            }
        });
    }
    legend::show(ui, view.heat.as_ref());
    let Some(mut on) = view.gizmos else { return };
    let gizmos = ui.checkbox(&mut on, "tips of cracks, lengths and bends");
    panel.places.insert(PanelWidget::Gizmos, gizmos.rect);
    if gizmos.on_hover_text("draws `CoatingGizmos` on all films").changed() {
        actions.push(Action::Gizmos(on));
    }
}

/// Adds the ratings of the chosen prop, with their meaning where the pointer rests.
fn ratings(ui: &mut Ui, view: &View) {
    let Some((shares, Ratings { rust, astm, flaking, cracking })) = &view.rated else { return };
    let short = format!("{rust}  {astm}  fl {}  cr {}", flaking.quantity(), cracking.quantity());
    let label = text(ui, ui.available_width(), RichText::new(short).monospace().small());
    label.on_hover_ui(|ui| {
        let percent = |share: f64| format!("{:.2} %", 100.0 * share);
        ui.label(format!("{rust} (ISO 4628-3), {astm} (ASTM): rusted on {}", percent(shares.rusted)));
        ui.label(format!("{flaking} (ISO 4628-5): gone from {}", percent(shares.gone)));
        ui.label(format!("{cracking} (ISO 4628-4)"));
    });
}

fn times(ui: &mut Ui, view: &View) {
    let sum: f64 = view.times.iter().filter_map(|(_, time)| *time).sum();
    for (name, time) in view.times.iter().copied().chain([("all of it", Some(sum))]) {
        ui.horizontal(|ui| {
            text(ui, 128.0, name);
            let time = time.map_or("-".to_owned(), |time| format!("{time:.2} ms"));
            right_text(ui, 80.0, RichText::new(time).monospace());
        });
    }
}

fn state(ui: &mut Ui, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    ui.horizontal(|ui| {
        let save = ui.add_sized([72.0, ROW], Button::new("Save state"));
        panel.places.insert(PanelWidget::SaveState, save.rect);
        if save.on_hover_text("keeps the films of the prop as they are, as its `CoatingSnapshot`").clicked() {
            actions.push(Action::SaveState);
        }
        let restore = ui.add_enabled_ui(view.is_saved, |ui| ui.add_sized([64.0, ROW], Button::new("Restore"))).inner;
        panel.places.insert(PanelWidget::RestoreState, restore.rect);
        if restore.clicked() {
            actions.push(Action::RestoreState);
        }
        let saved = view.chosen.filter(|_| view.is_saved).and_then(|chosen| panel.saved.get(&chosen));
        text(ui, 96.0, RichText::new(saved.map_or(String::new(), |age| format!("of age {age:.3}"))).weak());
    });
}
