//! What is told: the table, and the same as JSON.

use std::{fmt::Display, io::Write};

use serde_json::{Map, Value, json};

use crate::run::{Row, STAGES};

/// Table 1 of the paper: model, triangles, seconds for 1,000 steps, and percentages in the order of [`STAGES`]; on an
/// Intel Core i9-10980XE.
const PAPER: [(&str, usize, f64, [f64; 5]); 3] = [
    ("flat plate", 3012, 15.4, [46.7, 33.7, 13.3, 4.7, 1.6]),
    ("curved plate", 3005, 16.7, [44.4, 36.8, 12.4, 4.8, 1.6]),
    ("Stanford bunny", 10_000, 65.8, [45.4, 36.7, 11.7, 4.6, 1.6]),
];

/// The paper's line for a model, if it has one: known by its number of triangles.
fn of_paper(row: &Row) -> Option<(&'static str, f64, [f64; 5])> {
    let same = PAPER.iter().find(|(_, triangles, ..)| *triangles == row.triangles && row.steps == 1000)?;
    Some((same.0, same.2, same.3))
}

/// Prints an error, on one line whatever its cause has to say.
pub fn error(error: &dyn Display) {
    let text = error.to_string();
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let _ = writeln!(std::io::stderr(), "table1: {line}");
}

/// Prints the table. A closed pipe is no failure.
pub fn table(rows: &[Row]) {
    let mut out = std::io::stdout().lock();
    let head = ["model", "triangles", "steps", "seconds", "fracture", "deform", "mesh", "stains", "other"];
    let _ = write!(out, "{:<24}", head[0]);
    let _ = head[1..].iter().try_for_each(|name| write!(out, "{name:>10}"));
    let _ = writeln!(out, "{:>10}{:>10}{:>10}", "active", "sweeps", "lift p90");
    for row in rows {
        let name: String = row.model.rsplit(['/', '\\']).next().unwrap_or(&row.model).chars().take(23).collect();
        let _ = write!(out, "{name:<24}{:>10}{:>10}{:>10.3}", row.triangles, row.steps, row.seconds);
        let _ = row.shares.iter().try_for_each(|share| write!(out, "{:>8.1} %", share * 100.0));
        let lift = row.lift_p90.map_or_else(|| "-".into(), |lift| format!("{lift:.2}"));
        let _ = writeln!(out, "{:>8.1} %{:>10.2}{lift:>10}", row.mean_active * 100.0, row.sweeps_per_step);
        if let Some((name, seconds, shares)) = of_paper(row) {
            let _ = write!(out, "  paper: {name:<15}{:>10}{:>10}{seconds:>10.1}", row.triangles, 1000);
            let _ = shares.iter().try_for_each(|share| write!(out, "{share:>8.1} %"));
            let _ = writeln!(out, "   {:.0} times faster here", seconds / row.seconds);
        }
    }
    if let Some(row) = rows.first() {
        let _ = writeln!(out, "quality {}, vectors {}; one thread", row.quality.name(), row.simd);
    }
}

/// The table as JSON text, with a line end.
pub fn json(rows: &[Row]) -> String {
    let rows: Vec<Value> = rows
        .iter()
        .map(|row| {
            let shares: Map<String, Value> =
                STAGES.iter().zip(row.shares).map(|((_, name), share)| ((*name).into(), share.into())).collect();
            json!({
                "model": row.model,
                "triangles": row.triangles,
                "steps": row.steps,
                "seconds": row.seconds,
                "shares": shares,
                "sweeps_per_step": row.sweeps_per_step,
                "mean_active": row.mean_active,
                "lift_p90": row.lift_p90,
                "strain_rms": row.strain_rms,
                "simd": row.simd,
                "paper_seconds": of_paper(row).map(|(_, seconds, _)| seconds),
            })
        })
        .collect();
    format!("{:#}\n", json!({ "rows": rows }))
}
