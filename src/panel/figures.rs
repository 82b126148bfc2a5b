//! Figures that are plotted over age.

use super::plot::Plot;

/// Plots of a prop.
pub(super) const PLOTS: [Plot; 4] = [
    Plot { name: "off the metal", of: |sample| sample.separated, top: Some(1.0), text: percent },
    Plot { name: "gone", of: |sample| sample.gone, top: Some(1.0), text: percent },
    Plot { name: "torn edges", of: |sample| sample.cracks, top: None, text: |value| format!("{value:>7.0}") },
    Plot { name: "rust, layer m2", of: |sample| sample.rust, top: None, text: |value| format!("{value:>7.4}") },
];

fn percent(value: f32) -> String {
    format!("{:>5.1} %", value * 100.0)
}
