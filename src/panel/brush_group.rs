//! The brush: what it does, how wide and hard it is, and strokes taken back.

use bevy_egui::egui::{Button, Slider, Ui};

use super::{
    action::Action,
    cell::{ROW, text},
    state::CoatingPanel,
    view::View,
    widget::PanelWidget,
};
use crate::{
    pointing::CoatingBrush,
    touch::{Change, Effect},
};

/// Brushes of the panel: name, effect, and what it is for.
pub(super) const BRUSHES: [(&str, Effect, &str); 12] = [
    ("protect", Effect::Adhesion(Change::Multiply(1.5)), "the film holds better: adhesion times 1.5 a touch"),
    ("weaken", Effect::Adhesion(Change::Multiply(0.7)), "the film lets go earlier: adhesion times 0.7 a touch"),
    ("seal", Effect::Binding(Change::Multiply(2.0)), "cracks keep away: binding times 2 a touch"),
    ("score", Effect::Binding(Change::Multiply(0.3)), "cracks come here: binding times 0.3 a touch"),
    ("rust", Effect::Rust(0.2), "wet rust, which runs down and stains"),
    ("dust", Effect::Dust(Change::Add(0.2)), "dust and soot"),
    ("wet", Effect::Moisture(Change::Set(1.0)), "water"),
    ("hit", Effect::Hit(9.0), "blows that chip the paint and begin cracks"),
    ("strip", Effect::Strip, "takes the film off"),
    ("paint", Effect::Repaint, "the film is whole again, and fresh"),
    ("wash", Effect::Wash(0.3), "takes dust and wet rust away"),
    ("sand", Effect::Sand(0.5), "takes loose film, stains and rust away"),
];

/// Widths of buttons: four a row, and two.
const BRUSH: f32 = 62.0;
const STROKE: f32 = 62.0;

/// Adds the group, where there is a brush.
pub(super) fn show(ui: &mut Ui, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    let Some(brush) = &view.brush else { return };
    ui.separator();
    ui.horizontal(|ui| {
        ui.heading("Brush");
        for (name, widget, action, hint) in [
            ("undo", PanelWidget::Undo, Action::Undo, "takes the last stroke back, also from the middle of the past"),
            ("redo", PanelWidget::Redo, Action::Redo, "lets it happen again"),
        ] {
            let button = ui.add_sized([STROKE, ROW], Button::new(name));
            panel.places.insert(widget, button.rect);
            if button.on_hover_text(hint).clicked() {
                actions.push(action);
            }
        }
    });
    for row in BRUSHES.chunks(4) {
        ui.horizontal(|ui| {
            ui.spacing_mut().button_padding.x = 1.0;
            for &(name, effect, meaning) in row {
                let is_chosen = brush.effect == Some(effect);
                let button = ui.add_sized([BRUSH, ROW], Button::selectable(is_chosen, name));
                panel.places.insert(PanelWidget::Brush(name), button.rect);
                if button.on_hover_text(meaning).clicked() {
                    // Chosen again, it is put away.
                    let effect = (!is_chosen).then_some(effect);
                    actions.push(Action::Brush(CoatingBrush { effect, ..brush.clone() }));
                }
            }
        });
    }
    let mut changed = brush.clone();
    ui.horizontal(|ui| {
        text(ui, 52.0, "radius");
        ui.spacing_mut().slider_width = 120.0;
        let radius = ui.add(Slider::new(&mut changed.radius, 0.005..=1.0).logarithmic(true).fixed_decimals(3));
        panel.places.insert(PanelWidget::BrushRadius, radius.rect);
    });
    ui.horizontal(|ui| {
        text(ui, 52.0, "hardness");
        ui.spacing_mut().slider_width = 120.0;
        ui.add(Slider::new(&mut changed.hardness, 0.0..=1.0).fixed_decimals(2));
    });
    if changed != *brush {
        actions.push(Action::Brush(changed));
    }
}
