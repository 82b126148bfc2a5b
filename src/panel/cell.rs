//! Cells of fixed size, so that nothing moves when what is in them changes.

use bevy_egui::egui::{Align, Label, Layout, Response, RichText, Sense, Ui, UiBuilder, WidgetText, vec2};

/// Height of a row, in points.
pub(super) const ROW: f32 = 17.0;

/// Adds a cell of `width` to a row, and what is in it from the left.
pub(super) fn cell<R>(ui: &mut Ui, width: f32, add: impl FnOnce(&mut Ui) -> R) -> R {
    cell_with(ui, width, Layout::left_to_right(Align::Center), add).0
}

/// Adds a cell of `width` to a row, with a text at its right end.
pub(super) fn right_text(ui: &mut Ui, width: f32, text: impl Into<RichText>) {
    let label = Label::new(text.into()).selectable(false);
    cell_with(ui, width, Layout::right_to_left(Align::Center), |ui| ui.add(label));
}

/// Adds a cell of `width` to a row, with a text that is cut off at its end. Returns the response of the whole cell.
pub(super) fn text(ui: &mut Ui, width: f32, text: impl Into<WidgetText>) -> Response {
    let label = Label::new(text).truncate().selectable(false);
    cell_with(ui, width, Layout::left_to_right(Align::Center), |ui| ui.add(label)).1
}

fn cell_with<R>(ui: &mut Ui, width: f32, layout: Layout, add: impl FnOnce(&mut Ui) -> R) -> (R, Response) {
    let (rect, response) = ui.allocate_exact_size(vec2(width, ROW), Sense::hover());
    let mut inner = ui.new_child(UiBuilder::new().max_rect(rect).layout(layout));
    (add(&mut inner), response)
}
