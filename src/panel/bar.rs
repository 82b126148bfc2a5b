//! The clock at the bottom: run, step, the bar of ages, and the speed.

use bevy_egui::egui::{Button, RichText, Slider, Ui};

use super::{
    action::Action,
    cell::{cell, right_text},
    state::CoatingPanel,
    view::View,
    widget::PanelWidget,
};

const BUTTON: f32 = 56.0;
const AGE: f32 = 52.0;
const SPEED: f32 = 110.0;
const PER_SECOND: f32 = 96.0;
const NAME: f32 = 28.0;
const STATE: f32 = 62.0;
const SPEED_NAME: f32 = 38.0;
const GAP: f32 = 8.0;

/// Speeds that the slider goes through, an age per second.
const SPEEDS: [f64; 2] = [0.001, 1.0];

/// Adds the clock.
pub(super) fn show(ui: &mut Ui, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    ui.add_space(9.0);
    ui.horizontal(|ui| {
        let run = ui.add_sized([BUTTON, 22.0], Button::new(if view.is_paused { "Run" } else { "Pause" }));
        panel.places.insert(PanelWidget::Run, run.rect);
        if run.clicked() {
            actions.push(Action::Pause(!view.is_paused));
        }
        let step = ui.add_sized([BUTTON, 22.0], Button::new("Step"));
        panel.places.insert(PanelWidget::Step, step.rect);
        if step.on_hover_text("pauses, and takes one step").clicked() {
            actions.push(Action::Step);
        }
        cell(ui, NAME, |ui| ui.label("age"));
        let space = ui.spacing().item_spacing.x;
        let others = AGE + GAP + STATE + SPEED_NAME + SPEED + PER_SECOND + 7.0 * space;
        ages(ui, view, panel, actions, (ui.available_width() - others).max(80.0));
        right_text(ui, AGE, RichText::new(format!("{:.3}", view.age)).monospace());
        let state = match (view.travels, view.is_paused) {
            (true, _) => "seeking",
            (false, true) => "paused",
            (false, false) => "ageing",
        };
        ui.add_space(GAP);
        cell(ui, STATE, |ui| ui.weak(state));
        cell(ui, SPEED_NAME, |ui| ui.label("speed"));
        speed(ui, view, panel, actions);
        right_text(ui, PER_SECOND, RichText::new(format!("{:.3} age/s", view.age_per_second)).monospace());
    });
}

/// Adds the bar that goes to any age.
fn ages(ui: &mut Ui, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>, width: f32) {
    let mut age = view.age;
    let bar = cell(ui, width, |ui| {
        ui.spacing_mut().slider_width = width;
        ui.add(Slider::new(&mut age, 0.0..=last_age(view)).show_value(false))
    });
    panel.places.insert(PanelWidget::Age, bar.rect);
    if bar.changed() {
        actions.push(Action::Age(age));
    }
    bar.on_hover_text("brings the prop to any age, back as far as its past was kept");
}

/// Adds the slider of the clock's speed.
fn speed(ui: &mut Ui, view: &View, panel: &mut CoatingPanel, actions: &mut Vec<Action>) {
    let mut speed = view.age_per_second;
    let slider = cell(ui, SPEED, |ui| {
        ui.spacing_mut().slider_width = SPEED;
        ui.add(Slider::new(&mut speed, SPEEDS[0]..=SPEEDS[1]).logarithmic(true).show_value(false))
    });
    panel.places.insert(PanelWidget::Speed, slider.rect);
    if slider.changed() {
        actions.push(Action::Speed(speed));
    }
}

/// Returns the age at the end of the bar: one of few, so that the bar seldom changes under the pointer.
pub(super) fn last_age(view: &View) -> f64 {
    let greatest = view.oldest.max(view.age);
    [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0].into_iter().find(|&end| greatest <= end).unwrap_or(greatest)
}
