//! The page of the gallery as text.

use super::{
    claim::Claim,
    exhibit::NoFilm,
    figure::Figure,
    figures::FIGURES,
    table1::{self, ROWS},
};

/// Where the page is, in the repository.
pub const FILE: &str = "docs/gallery.md";
/// Where its pictures are, in the repository.
pub const PICTURES: &str = "assets/gallery";

/// Line before the times, and line after them: the only part of the page that differs from machine to machine.
pub const TIMES: [&str; 2] = ["<!-- times -->", "<!-- end of times -->"];

const HEAD: &str = "# The paper and us, side by side

Each figure of the paper, what it states in our words, and the same made here. This page and its pictures are written by
`cargo run --example gallery -- --headless --page`. `cargo core --test gallery` measures all numbers again and fails if
one of them differs from what is written here, or leaves its band. Where there is a ±, numbers are means and standard
deviations over five seeds.
\"The paper's rules\" are `Preset::Paper`, which count in triangles; the default settings measure in metres.

The paper gives few numbers. Bands are what it gives; figures of an independent prototype of its method, with the
margins of those (fig. 8, fig. 17, sections 5.1 to 5.3); at least or at most, where it states a trend; and elsewhere
wide bands of our own, which hold what one sees in the pictures.
";

/// Measures all figures.
///
/// # Errors
/// [`NoFilm`] if there is no film for one.
pub fn measure() -> Result<Vec<(&'static Figure, Vec<Claim>)>, NoFilm> {
    FIGURES.iter().map(|figure| Ok((*figure, (figure.claims)()?))).collect()
}

/// Returns the page. `times` is what [`times`] says.
pub fn text(measured: &[(&Figure, Vec<Claim>)], times: &str) -> String {
    let mut text = HEAD.to_owned();
    for (figure, claims) in measured {
        text.push_str(&format!("\n## {}: {}\n\n", figure.number, figure.title));
        if !(figure.panels)().is_empty() {
            text.push_str(&format!("![{}](../{PICTURES}/{}.png)\n\n", figure.title, figure.file));
        }
        text.push_str(&format!("**The paper:** {}\n\n**Here:** {}\n", figure.paper, figure.here));
        if !claims.is_empty() {
            text.push_str("\n| measured | here | band | |\n|---|---|---|---|\n");
        }
        for claim in claims {
            let verdict = match claim.expected().as_str() {
                "any" => "",
                _ if claim.holds() => "in",
                _ => "**out**",
            };
            let band = claim.expected().replace("any", "");
            text.push_str(&format!("| {} | {} | {band} | {verdict} |\n", claim.what, claim.number()));
        }
        if figure.file == "fig15" {
            text.push_str(&format!("\n{}\n{times}{}\n", TIMES[0], TIMES[1]));
        }
    }
    text
}

/// Measures the times of Table 1 on this machine and returns them as a table.
///
/// # Errors
/// [`NoFilm`] if there is no film for one.
pub fn times() -> Result<String, NoFilm> {
    let mut text =
        "Table 1 of the paper: seconds for 1,000 steps, there on an Intel Core i9-10980XE, here on one thread of the
machine that wrote this page, and what our seconds were spent on.

| the paper's model | seconds | ours | triangles | seconds | fracture | deformation | mesh | stains |
|---|---|---|---|---|---|---|---|---|
"
        .to_owned();
    for (theirs, ours, shape, seconds) in ROWS {
        let time = table1::time(shape)?;
        let shares = time.shares.map(|share| format!("{:.0} %", 100.0 * share)).join(" | ");
        let row = format!("{theirs} | {seconds:.1} | {ours} | {} | {:.2}", time.triangles, time.seconds);
        text.push_str(&format!("| {row} | {shares} |\n"));
    }
    Ok(text)
}

/// Returns a page without its times.
pub fn without_times(page: &str) -> String {
    match (page.split_once(TIMES[0]), page.split_once(TIMES[1])) {
        (Some((before, _)), Some((_, after))) => format!("{before}{after}"),
        _ => page.to_owned(),
    }
}
