//! The settings that are shown, and the values of each.

use bevy::math::Vec3;
use bevy_coating::{prelude::*, settings::SettingsError};
use clap::ValueEnum;

/// Settings that are shown in one picture.
#[derive(ValueEnum, Clone, Copy, PartialEq, Eq, Debug)]
pub enum Page {
    /// Grain, adhesion and the force that lifts.
    Hold,
    /// Tearing.
    Cracks,
    /// Bending, and what falls.
    Curls,
    /// Rust and its run-off.
    Rust,
    /// Black stains.
    Dust,
    /// Water.
    Moisture,
}

impl Page {
    pub const ALL: [Self; 6] = [Self::Hold, Self::Cracks, Self::Curls, Self::Rust, Self::Dust, Self::Moisture];

    pub fn name(self) -> &'static str {
        match self {
            Self::Hold => "hold",
            Self::Cracks => "cracks",
            Self::Curls => "curls",
            Self::Rust => "rust",
            Self::Dust => "dust",
            Self::Moisture => "moisture",
        }
    }

    /// Stages of the settings that belong to it.
    fn stages(self) -> &'static [&'static str] {
        match self {
            Self::Hold => &["scale", "adhesion", "bending"],
            Self::Cracks => &["tearing"],
            Self::Curls => &["deform", "stripping"],
            Self::Rust => &["rust"],
            Self::Dust => &["dust"],
            Self::Moisture => &["moisture"],
        }
    }

    /// Its settings.
    pub fn rows(self) -> impl Iterator<Item = Row> {
        let belongs = move |row: &&Row| row.path.split('.').next().is_some_and(|stage| self.stages().contains(&stage));
        ROWS.iter().filter(belongs).copied()
    }

    /// The weather of its pieces: rain from the front, and a low sun where water is what counts.
    pub fn weather(self) -> CoatingWeather {
        if self != Self::Moisture {
            return CoatingWeather::default();
        }
        let rain = Vec3::new(0.1, -1.0, -0.5).normalize() * 0.5;
        CoatingWeather { rain, sun: Vec3::new(0.5, -0.5, -0.6).normalize() * 0.6, ..CoatingWeather::default() }
    }
}

/// Names of all pages.
pub fn names() -> Vec<&'static str> {
    Page::ALL.map(Page::name).to_vec()
}

/// A setting with two values beside its default.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    pub path: &'static str,
    one: &'static str,
    other: &'static str,
    /// Whether it acts by the paper's rules only.
    by_paper: bool,
}

const fn row(path: &'static str, one: &'static str, other: &'static str) -> Row {
    Row { path, one, other, by_paper: false }
}

const fn by_paper(path: &'static str, one: &'static str, other: &'static str) -> Row {
    Row { by_paper: true, ..row(path, one, other) }
}

impl Row {
    /// What is written above its pieces.
    pub fn title(&self) -> String {
        format!("{}{}", self.path, if self.by_paper { " (by Paper)" } else { "" })
    }

    /// Settings of its pieces, each with the value of this one, in ascending order: by default, and two others.
    pub fn settings(&self) -> Result<[(String, CoatingSettings); 3], SettingsError> {
        let with = |value: Option<&str>| {
            let mut settings = CoatingSettings::default();
            if self.by_paper {
                settings.set("scale.rules", "Paper")?;
            }
            if self.path != "scale.grain" {
                settings.set("scale.grain", GRAIN)?;
            }
            if let Some(value) = value {
                settings.set(self.path, value)?;
            }
            let field = CoatingSettings::fields().find(|field| field.path == self.path);
            let number = field.map_or(f32::NAN, |field| field.get(&settings));
            let rounded = (1000.0 * number).round() / 1000.0;
            let text = if value.is_some() { format!("{rounded}") } else { format!("{rounded} (default)") };
            Ok::<_, SettingsError>((number, text, settings))
        };
        let mut values = [with(Some(self.one))?, with(None)?, with(Some(self.other))?];
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(values.map(|(_, text, settings)| (text, settings)))
    }
}

/// Grain of all pieces but those of its own row: finer than by default, so that much happens on a small piece.
const GRAIN: &str = "0.016";

/// All settings, in the order of their table, but for `scale.rules`, which is the subject of the scene `fineness`.
const ROWS: [Row; 48] = [
    row("scale.grain", "0.012", "0.016"),
    row("adhesion.mean", "1.5", "2.9"),
    row("adhesion.deviation", "0.1", "1.5"),
    row("adhesion.octaves", "1", "6"),
    by_paper("adhesion.frequency", "2", "15"),
    row("adhesion.wavelength", "3", "15"),
    row("adhesion.decay", "0.4", "1.8"),
    row("bending.gain", "0.2", "0.5"),
    row("bending.gamma", "0", "10"),
    row("tearing.contraction", "0.7", "1.4"),
    row("tearing.contraction_growth", "0.2", "2"),
    by_paper("tearing.contraction_kept", "0.05", "0.8"),
    row("tearing.relief", "0.6", "1"),
    row("tearing.relief_reach", "0.25", "1.5"),
    row("tearing.memory", "0.3", "8"),
    row("tearing.neck_width", "0", "4"),
    row("tearing.binding", "4.5", "8"),
    row("tearing.binding_decay", "0.3", "4"),
    row("tearing.weak_probability", "0.001", "0.06"),
    row("tearing.weak_factor", "0.2", "0.6"),
    row("tearing.alpha", "-0.5", "0.9"),
    row("tearing.beta", "0.05", "0.6"),
    row("deform.narrowing_rate", "0.2", "3"),
    row("deform.bend_limit", "0.1", "0.8"),
    row("deform.curl_reach", "0.7", "5"),
    row("deform.sweeps_per_age", "500", "40000"),
    by_paper("stripping.fall_faces", "0", "60"),
    row("stripping.hold", "0", "1"),
    row("stripping.hold_area", "0", "12"),
    row("rust.emission", "0.02", "0.3"),
    row("rust.speed", "0.4", "5"),
    row("rust.deposit", "1.5", "15"),
    row("rust.spread", "0.005", "0.3"),
    row("rust.into_cracks", "0", "1"),
    row("rust.corrosion", "0.5", "15"),
    row("dust.rate", "0.3", "5"),
    row("dust.height", "0", "1"),
    row("dust.direction", "0", "1"),
    row("dust.curvature", "0", "0.5"),
    row("moisture.wetting", "6", "600"),
    row("moisture.drying", "3", "150"),
    row("moisture.sun", "0", "10"),
    row("moisture.crevice", "0.02", "1"),
    row("moisture.adhesion", "0", "6"),
    row("moisture.emission", "0", "8"),
    row("moisture.travel", "0", "5"),
    row("moisture.wash_dust", "0", "20"),
    row("moisture.wash_rust", "0.5", "8"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_setting_has_a_row_of_three_values() {
        for field in CoatingSettings::fields().filter(|field| field.path != "scale.rules") {
            let row = ROWS.iter().find(|row| row.path == field.path).expect(field.path);
            let values = row.settings().expect(field.path).map(|(_, settings)| field.get(&settings));
            assert!(values[0] < values[1] && values[1] < values[2], "{}: {values:?}", field.path);
            assert_eq!(Page::ALL.iter().filter(|page| page.rows().any(|row| row.path == field.path)).count(), 1);
        }
        assert_eq!(ROWS.len(), CoatingSettings::fields().count() - 1);
    }
}
