//! Writes to the terminal. A closed pipe is no failure.

use std::{fmt::Display, io::Write, path::Path, sync::OnceLock};

use bevy_coating::bake::{BakeWarning, Progress, Stats};
use indicatif::{ProgressBar, ProgressStyle};

/// A progress bar on the standard error; nothing where that is no terminal.
#[derive(Default)]
pub struct Bar(OnceLock<ProgressBar>);

impl Bar {
    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = self.0.get() {
            bar.finish_and_clear();
        }
    }
}

impl Progress for Bar {
    fn begin(&self, work: u64) {
        let bar = self.0.get_or_init(|| ProgressBar::new(work));
        if let Ok(style) = ProgressStyle::with_template("ageing {wide_bar} {percent:>3} % {eta}") {
            bar.set_style(style);
        }
    }

    fn advance(&self, work: u64) {
        if let Some(bar) = self.0.get() {
            bar.inc(work);
        }
    }
}

/// Prints an error, on one line whatever its cause has to say.
pub fn error(error: &dyn Display) {
    let text = error.to_string();
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let _ = writeln!(std::io::stderr(), "bake: {line}");
}

/// Prints warnings, one a line.
pub fn warnings(warnings: &[BakeWarning]) {
    for warning in warnings {
        let _ = writeln!(std::io::stderr(), "warning: {warning}");
    }
}

/// Prints what came out.
pub fn summary<'a>(origin: &str, stats: &Stats, files: impl Iterator<Item = &'a Path>) {
    let mut out = std::io::stdout().lock();
    let share = |x: Option<f64>| x.map_or_else(|| "-".into(), |x| format!("{:.1} %", x * 100.0));
    let last = stats.timeline.last().cloned().unwrap_or_default();
    let (film, seconds) = (&stats.film, &stats.seconds);
    let _ = writeln!(out, "{origin}: {} triangles, film of {}", stats.input.triangles, film.triangles);
    let _ = writeln!(
        out,
        "age {}: {} separated, {} of edges torn, {} stripped, {} fallen, {} pieces",
        last.age,
        share(last.separated),
        share(last.torn),
        share(last.stripped),
        share(last.fallen),
        last.pieces,
    );
    let _ = writeln!(
        out,
        "{:.2} s: build {:.2}, fracture {:.2}, deformation {:.2}, stains {:.2}, meshes and textures {:.2}, other {:.2}",
        seconds.total, seconds.build, seconds.fracture, seconds.deform, seconds.stain, seconds.mesh, seconds.other,
    );
    let _ = writeln!(out, "digest {}", stats.digest);
    for file in files {
        let _ = writeln!(out, "wrote {}", file.display());
    }
}
