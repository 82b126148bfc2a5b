//! What the window says of the figure that is looked at: the paper's statement, ours, and numbers of the films there.

use crate::cli::Options;
use crate::common_scene::window::Views;
use crate::films::Wanted;
use bevy::prelude::*;
use bevy_coating::FilmSummary;
use bevy_coating::prelude::*;
use bevy_coating::sim::FilmClock;
use bevy_egui::{EguiContexts, EguiPrimaryContextPass, egui};

pub struct StatementPlugin;

/// Height of the statement, in logical pixels.
pub const HEIGHT: f32 = 240.0;
/// Where it begins, beside the read-out, and the margin around it, in logical pixels.
const LEFT: f32 = 388.0;
const MARGIN: f32 = 16.0;

impl Plugin for StatementPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(EguiPrimaryContextPass, show);
    }
}

fn show(
    mut contexts: EguiContexts,
    views: Res<Views>,
    options: Res<Options>,
    wanted: Query<&Wanted>,
    films: Query<(&FilmClock, &FilmSummary, &CoatedBy)>,
    screen: Single<&Window>,
) -> Result {
    let figures = options.figures();
    let Some(figure) = figures.get(views.first) else { return Ok(()) };
    let window = egui::Window::new(format!("{}: {}", figure.number, figure.title)).id(egui::Id::new("statement"));
    let width = (screen.width() - LEFT - 3.0 * MARGIN).max(300.0);
    let window = window.pivot(egui::Align2::LEFT_BOTTOM).default_pos([LEFT, screen.height() - MARGIN]);
    window.default_width(width).show(contexts.ctx_mut()?, |ui| {
        ui.label(format!("The paper: {}", figure.paper));
        ui.separator();
        ui.label(format!("Here: {}", figure.here));
        ui.separator();
        let mut lines: Vec<(f64, String)> = Vec::new();
        for (clock, summary, coated_by) in &films {
            let Ok(Wanted { panel, figure: own }) = wanted.get(coated_by.0) else { continue };
            if *own == figure.file {
                let line = format!("{} (age {:.2}): {}", panel.exhibit.title, clock.age(), told(summary));
                lines.push((panel.age, line));
            }
        }
        // Queries have no order of their own.
        lines.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| a.1.cmp(&b.1)));
        lines.iter().for_each(|(_, line)| _ = ui.label(line));
    });
    Ok(())
}

/// The figures of a film that are told.
fn told(summary: &FilmSummary) -> String {
    let shares = &summary.shares;
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    format!(
        "{} off the metal, {} gone, {:.1} m of cracks",
        percent(shares.separated),
        percent(shares.gone),
        shares.crack_density * shares.area
    )
}
