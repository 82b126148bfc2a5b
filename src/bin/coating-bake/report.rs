//! Writes to the terminal. A closed pipe is no failure.

use std::{fmt::Display, io::Write, path::Path, sync::OnceLock};

use bevy_coating::bake::{BakeWarning, Printable, Progress, Stats};
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

/// Makes text from files fit for the terminal: names may hold line breaks and the codes that move its cursor.
pub fn printable(text: &str) -> String {
    Printable(text).to_string()
}

/// Prints one line. All that is printed goes through here.
fn line(mut to: impl Write, text: &str) {
    let _ = writeln!(to, "{}", printable(text));
}

/// Prints an error, on one line whatever its cause has to say.
pub fn error(error: &dyn Display) {
    let text = error.to_string();
    let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
    line(std::io::stderr(), &format!("bake: {words}"));
}

/// Prints warnings, one a line, each after the name of the input if there is one.
pub fn warnings(origin: Option<&str>, warnings: &[BakeWarning]) {
    for warning in warnings {
        let text = match origin {
            Some(origin) => format!("warning: {origin}: {warning}"),
            None => format!("warning: {warning}"),
        };
        line(std::io::stderr(), &text);
    }
}

/// Prints how many of several inputs were baked.
pub fn batch(inputs: usize, failed: usize) {
    let done = inputs - failed;
    let text = match failed {
        0 => format!("aged {done} models"),
        _ => format!("aged {done} of {inputs} models, {failed} failed"),
    };
    line(std::io::stdout(), &text);
}

/// Prints what came out.
pub fn summary<'a>(origin: &str, stats: &Stats, files: impl Iterator<Item = &'a Path>) {
    let mut out = std::io::stdout().lock();
    let mut print = |text: &str| line(&mut out, text);
    let share = |x: Option<f64>| x.map_or_else(|| "-".into(), |x| format!("{:.1} %", x * 100.0));
    let last = stats.timeline.last().cloned().unwrap_or_default();
    let (film, seconds) = (&stats.film, &stats.seconds);
    print(&format!("{origin}: {} triangles, film of {}", stats.input.triangles, film.triangles));
    print(&format!(
        "age {}: {} separated, {} of edges torn, {} stripped, {} fallen, {} pieces",
        last.age,
        share(last.separated),
        share(last.torn),
        share(last.stripped),
        share(last.fallen),
        last.pieces,
    ));
    if let Some(rated) = stats.ratings.last() {
        print(&format!("rated {}", rated.ratings));
    }
    if let Some(until) = stats.run.until.as_ref().filter(|until| until.reached) {
        print(&format!("reached {} at age {}", until.goal, until.age));
    }
    print(&format!(
        "{:.2} s: build {:.2}, fracture {:.2}, deformation {:.2}, stains {:.2}, meshes and textures {:.2}, other {:.2}",
        seconds.total, seconds.build, seconds.fracture, seconds.deform, seconds.stain, seconds.mesh, seconds.other,
    ));
    print(&format!("digest {}", stats.digest));
    for file in files {
        print(&format!("wrote {}", file.display()));
    }
}
