//! A small plot of a figure over age.

use bevy_egui::egui::{Align2, Color32, FontId, Rect, Sense, Shape, Stroke, Ui, pos2, vec2};

use super::statistics::Sample;

/// Height of a plot, in points.
const HEIGHT: f32 = 34.0;
/// Width at the left for name and value.
const TEXT: f32 = 84.0;

/// Figure that is plotted.
pub(super) struct Plot {
    pub name: &'static str,
    /// Figure of a sample.
    pub of: fn(&Sample) -> f32,
    /// Upper end of the scale; `None`: that follows the greatest value, in powers of two.
    pub top: Option<f32>,
    /// Writes a value.
    pub text: fn(f32) -> String,
}

impl Plot {
    /// Adds the plot of samples up to `last`, with a line at `age`. What lies beyond is dimmed: a future that was.
    pub fn show(&self, ui: &mut Ui, samples: &[Sample], age: f64, last: f64) {
        let width = ui.available_width();
        let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::hover());
        if !ui.is_rect_visible(rect) {
            return;
        }
        let area = Rect::from_min_max(pos2(rect.left() + TEXT, rect.top() + 1.0), rect.right_bottom() - vec2(1.0, 1.0));
        let (painter, visuals) = (ui.painter_at(rect), ui.visuals().clone());
        painter.rect_filled(area, 2.0, visuals.extreme_bg_color);
        let greatest = samples.iter().map(self.of).fold(0.0, f32::max);
        let top = self.top.unwrap_or_else(|| scale(greatest));
        let last = last.max(f64::MIN_POSITIVE);
        let place = |sample: &Sample| {
            let x = (sample.age() / last).clamp(0.0, 1.0) as f32;
            let y = ((self.of)(sample) / top).clamp(0.0, 1.0);
            pos2(area.left() + x * area.width(), area.bottom() - 1.0 - y * (area.height() - 2.0))
        };
        let (past, ahead): (Vec<&Sample>, Vec<&Sample>) = samples.iter().partition(|sample| sample.age() <= age + 1e-6);
        let line = |samples: &[&Sample], color: Color32| {
            let points = samples.iter().map(|sample| place(sample)).collect();
            Shape::line(points, Stroke::new(1.4, color))
        };
        let color = visuals.selection.stroke.color;
        painter.add(line(&ahead, color.gamma_multiply(0.35)));
        painter.add(line(&past, color));
        let x = area.left() + (age / last).clamp(0.0, 1.0) as f32 * area.width();
        painter.vline(x, area.y_range(), Stroke::new(1.0, visuals.weak_text_color()));
        let value = past.last().map_or(0.0, |sample| (self.of)(sample));
        painter.text(rect.left_top(), Align2::LEFT_TOP, self.name, FontId::proportional(11.0), visuals.text_color());
        let at = pos2(area.left() - 8.0, rect.bottom() - 2.0);
        painter.text(
            at,
            Align2::RIGHT_BOTTOM,
            (self.text)(value),
            FontId::monospace(11.5),
            visuals.strong_text_color(),
        );
        let whole = (self.text)(top);
        response.on_hover_text(format!("{} over age 0 to {last:.1}; the top is {}", self.name, whole.trim()));
    }
}

/// Returns the power of two that is at least `greatest`, so that the scale seldom changes; at least 2^-10.
fn scale(greatest: f32) -> f32 {
    let mut top = 1.0 / 1024.0;
    // No figure is beyond 2^60.
    for _ in 0..70 {
        if top >= greatest {
            break;
        }
        top *= 2.0;
    }
    top
}
