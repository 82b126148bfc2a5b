//! One setting as a row: name, slider, number, unit, and a button that resets it.

use std::collections::BTreeMap;

use bevy_egui::egui::{Button, DragValue, Rect, Response, RichText, Shape, Slider, Stroke, Ui, pos2};

use super::{
    cell::{ROW, cell, right_text, text},
    widget::PanelWidget,
};
use crate::settings::{CoatingSettings, Field};

const NAME: f32 = 112.0;
const SLIDER: f32 = 88.0;
const NUMBER: f32 = 54.0;
const UNIT: f32 = 46.0;
const RESET: f32 = 17.0;

/// Ranges that are so many times wider than the default are gone through by orders of magnitude.
const WIDE: f32 = 20.0;

/// Adds the row of a setting, which has its value in `settings` and goes back to that in `base`. Returns another value
/// that was asked for.
pub(super) fn show(
    ui: &mut Ui,
    field: &'static Field,
    settings: &CoatingSettings,
    base: &CoatingSettings,
    places: &mut BTreeMap<PanelWidget, Rect>,
) -> Option<f32> {
    let (value, reset_to) = (field.get(settings), field.get(base));
    let mut wanted = value;
    ui.push_id(field.path, |ui| {
        ui.horizontal(|ui| {
            let name = field.path.split_once('.').map_or(field.path, |(_, name)| name).replace('_', " ");
            let name = if value == reset_to { RichText::new(name) } else { RichText::new(name).strong() };
            explain(text(ui, NAME, name), field, reset_to);
            let slider = if field.names.is_empty() {
                slider(ui, field, &mut wanted, reset_to)
            } else {
                names(ui, field, &mut wanted)
            };
            places.insert(PanelWidget::Setting(field.path), slider);
            if field.names.is_empty() {
                let number = cell(ui, NUMBER, |ui| number(ui, field, &mut wanted, reset_to));
                places.insert(PanelWidget::Number(field.path), number.rect);
            }
            right_text(ui, UNIT, RichText::new(field.unit()).weak().small());
            let reset = reset(ui, value != reset_to);
            places.insert(PanelWidget::Reset(field.path), reset.rect);
            if reset.on_hover_text(format!("back to {}", field.text(base))).clicked() {
                wanted = reset_to;
            }
        });
    });
    (wanted != value && field.range.contains(wanted)).then_some(wanted)
}

/// Adds the documentation of a setting as what appears while the pointer rests on its name.
fn explain(name: Response, field: &Field, reset_to: f32) {
    name.on_hover_ui(|ui| {
        ui.set_max_width(340.0);
        ui.strong(field.path);
        ui.label(field.plain_doc());
        let unit = field.unit();
        let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
        let reset_to = match field.names {
            [] => format!("; resets to {reset_to}"),
            _ => String::new(),
        };
        ui.weak(format!("{}{unit}{reset_to}", field.allowed()));
    });
}

/// Adds the slider of a number, and returns its place.
fn slider(ui: &mut Ui, field: &Field, wanted: &mut f32, reset_to: f32) -> Rect {
    let range = field.range;
    // The ends of an open range are no values.
    let margin = if range.open { (range.max - range.min) * 1e-3 } else { 0.0 };
    let scale = if reset_to > 0.0 { reset_to } else { 1.0 };
    let mut slider = Slider::new(wanted, range.min + margin..=range.max - margin).show_value(false);
    if range.min >= 0.0 && range.max > WIDE * scale {
        slider = slider.logarithmic(true).smallest_positive(f64::from(scale) * 1e-2);
    }
    if range.whole {
        slider = slider.integer();
    }
    cell(ui, SLIDER, |ui| {
        ui.spacing_mut().slider_width = SLIDER;
        ui.add(slider).rect
    })
}

/// Adds the field of a number.
fn number(ui: &mut Ui, field: &Field, wanted: &mut f32, reset_to: f32) -> Response {
    let range = field.range;
    let speed = f64::from(wanted.abs().max(reset_to.abs()).max(0.01)) * 0.01;
    let decimals = if range.whole { 0 } else { decimals(*wanted) };
    let number = DragValue::new(wanted).range(range.min..=range.max).speed(if range.whole { 0.1 } else { speed });
    ui.spacing_mut().interact_size.x = NUMBER;
    ui.add_sized([NUMBER, ROW], number.max_decimals(decimals))
}

/// Returns how many decimals a number is shown with, so that it has about four digits.
fn decimals(value: f32) -> usize {
    match value.abs() {
        1000.0.. => 0,
        100.0.. => 1,
        10.0.. => 2,
        0.1.. | 0.0 => 3,
        _ => 5,
    }
}

/// Adds the names that a setting may have, and returns their place.
fn names(ui: &mut Ui, field: &Field, wanted: &mut f32) -> Rect {
    let width = SLIDER + NUMBER + ui.spacing().item_spacing.x;
    cell(ui, width, |ui| {
        for (number, name) in (0u8..).zip(field.names) {
            if ui.selectable_label(*wanted == f32::from(number), *name).clicked() {
                *wanted = f32::from(number);
            }
        }
        ui.min_rect()
    })
}

/// Adds the button that resets a setting: an arrow that turns back, painted, as fonts may lack it.
fn reset(ui: &mut Ui, enabled: bool) -> Response {
    let button = ui.add_enabled_ui(enabled, |ui| ui.add_sized([RESET, ROW], Button::new(""))).inner;
    let color = if enabled { ui.visuals().text_color() } else { ui.visuals().weak_text_color().gamma_multiply(0.4) };
    let stroke = Stroke::new(1.2, color);
    let middle = button.rect.center();
    let at = |x: f32, y: f32| pos2(middle.x + x, middle.y + y);
    let hook = vec![at(-3.5, -1.0), at(1.5, -1.0), at(3.5, 0.5), at(3.5, 2.0), at(1.5, 3.5), at(-2.0, 3.5)];
    ui.painter().add(Shape::line(hook, stroke));
    ui.painter().add(Shape::line(vec![at(-1.0, -3.5), at(-3.5, -1.0), at(-1.0, 1.5)], stroke));
    button
}
