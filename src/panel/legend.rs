//! Legend of a heat map.

use bevy_egui::egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Sense, Shape, Ui, pos2, vec2};

use crate::{api::heat_map_view::HeatMapView, heat::HeatMap};

/// Height of the bar and of the marks below it, in points.
const HEIGHT: f32 = 28.0;
/// Height of the bar.
const BAR: f32 = 12.0;
/// Pieces of the bar, each of which has its own two colours.
const PIECES: u8 = 36;

/// Adds the legend of what is shown; as much room without anything in it where nothing is.
pub(super) fn show(ui: &mut Ui, view: Option<&HeatMapView>) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::hover());
    let Some(view) = view.filter(|_| ui.is_rect_visible(rect)) else { return };
    let bar = Rect::from_min_size(rect.min + vec2(8.0, 0.0), vec2(rect.width() - 16.0, BAR));
    let range = view.spread();
    let color = |value: f32| {
        let [red, green, blue] = view.map.color(value, range).map(|channel| (channel * 255.0).round() as u8);
        Color32::from_rgb(red, green, blue)
    };
    let text = ui.visuals().text_color();
    if view.map.is_of_kinds() {
        // A stripe for each of the first kinds.
        for i in 0..PIECES {
            ui.painter().rect_filled(piece(bar, i), 0.0, color(f32::from(i)));
        }
        ui.painter().text(at(bar, 0.5), Align2::CENTER_TOP, "one colour a piece", FontId::proportional(10.0), text);
        return;
    }
    let mut mesh = Mesh::default();
    for i in 0..PIECES {
        let stripe = piece(bar, i);
        let [from, to] = [i, i + 1].map(|i| color(range.value(f32::from(i) / f32::from(PIECES))));
        let first = mesh.vertices.len() as u32;
        for (corner, color) in [
            (stripe.left_top(), from),
            (stripe.right_top(), to),
            (stripe.right_bottom(), to),
            (stripe.left_bottom(), from),
        ] {
            mesh.colored_vertex(corner, color);
        }
        mesh.add_triangle(first, first + 1, first + 2);
        mesh.add_triangle(first, first + 2, first + 3);
    }
    ui.painter().add(Shape::mesh(mesh));
    let ticks = view.map.legend(range);
    let last = ticks.len().saturating_sub(1);
    for (i, tick) in ticks.iter().enumerate() {
        let align = match i {
            0 => Align2::LEFT_TOP,
            i if i == last => Align2::RIGHT_TOP,
            _ => Align2::CENTER_TOP,
        };
        let unit =
            if i == last && !view.map.unit().is_empty() { format!(" {}", view.map.unit()) } else { String::new() };
        let label = format!("{}{unit}", tick.text);
        ui.painter().text(at(bar, tick.share), align, label, FontId::proportional(10.0), text);
    }
}

/// Returns what the map of the panel's button shows, for a prop without one.
pub(super) fn meaning(map: Option<HeatMap>) -> &'static str {
    map.map_or("no heat map: the prop as it is", HeatMap::meaning)
}

fn piece(bar: Rect, i: u8) -> Rect {
    let x = |i: u8| bar.left() + bar.width() * f32::from(i) / f32::from(PIECES);
    Rect::from_min_max(pos2(x(i), bar.top()), pos2(x(i + 1), bar.bottom()))
}

/// Returns the place of a mark below the bar.
fn at(bar: Rect, share: f32) -> Pos2 {
    pos2(bar.left() + bar.width() * share, bar.bottom() + 3.0)
}
