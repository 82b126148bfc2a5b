//! What the command lines of all scenes have.

use super::camera::Orbit;
use bevy::math::Vec3;
use bevy_coating::{appearance::Detail, settings::CoatingSettings};
use clap::Args;
use std::path::PathBuf;

/// Options of every scene.
#[derive(Args, Clone, Debug)]
pub struct SceneArgs {
    /// Render PNG files instead of opening a window (the default where there is no display).
    #[arg(long)]
    pub headless: bool,
    /// Where the pictures go [default: output and the example's name].
    #[arg(long, value_name = "DIR")]
    pub output: Option<PathBuf>,
    /// Size of the pictures or of the window [default: fits the view].
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub size: Option<(u32, u32)>,
    /// Render one moving picture instead: a GIF of the first view, from age 0 to age 1.
    #[arg(long, value_name = "FILE")]
    pub animate: Option<PathBuf>,
    /// Frames of the moving picture.
    #[arg(long, value_name = "NUMBER", default_value_t = 24, value_parser = clap::value_parser!(u32).range(2..=500))]
    pub frames: u32,
    /// Where the camera stands, for one picture of each age from there (with --to).
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_place, requires = "to", allow_hyphen_values = true)]
    from: Option<Vec3>,
    /// What it looks at.
    #[arg(long, value_name = "X,Y,Z", value_parser = parse_place, requires = "from", allow_hyphen_values = true)]
    to: Option<Vec3>,
    /// Another seed, other cracks.
    #[arg(long, default_value_t = 7)]
    pub seed: u64,
}

impl SceneArgs {
    /// Where the pictures of `example` go.
    pub fn folder(&self, example: &str) -> PathBuf {
        self.output.clone().unwrap_or_else(|| PathBuf::from("output").join(example))
    }

    /// The camera that the command line asks for, if it does.
    pub fn camera(&self) -> Option<Orbit> {
        let (from, to) = (self.from?, self.to?);
        let back = from - to;
        let distance = back.length().max(1e-3);
        let yaw = back.x.atan2(back.z);
        let pitch = (back.y / distance).clamp(-1.0, 1.0).asin();
        Some(Orbit { centre: to, distance, yaw, pitch, field_of_view: 0.6 })
    }

    /// Whether pictures are asked for, rather than a window.
    pub fn pictures(&self) -> bool {
        self.headless || self.animate.is_some() || self.from.is_some()
    }

    /// How finely paint is shown: at `level` at most. Pictures do not wait for levels that follow the distance: theirs
    /// stays.
    pub fn detail(&self, level: u32) -> Detail {
        let detail = Detail { level, ..Detail::default() };
        if self.pictures() { Detail { pixels: 0.0, ..detail } } else { detail }
    }

    /// Ages of the pictures, in order: those `given`, or the moving picture's, spread evenly.
    pub fn ages(&self, given: &[f64]) -> Vec<f64> {
        if self.animate.is_none() {
            return in_order(given);
        }
        let last = self.frames - 1;
        (0..=last).map(|frame| f64::from(frame) / f64::from(last)).collect()
    }
}

fn parse_place(text: &str) -> Result<Vec3, String> {
    let numbers: Vec<f32> = text.split(',').map_while(|number| number.trim().parse().ok()).collect();
    match numbers.as_slice() {
        &[x, y, z] if Vec3::new(x, y, z).is_finite() => Ok(Vec3::new(x, y, z)),
        _ => Err(format!("`{text}` is not a place such as 0.1,1.2,-0.5, in metres")),
    }
}

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let parsed = text.split_once(['x', 'X']).and_then(|(w, h)| Some((w.trim().parse().ok()?, h.trim().parse().ok()?)));
    match parsed {
        Some((w, h)) if (16..=4096).contains(&w) && (16..=4096).contains(&h) => Ok((w, h)),
        _ => Err(format!("`{text}` is not WIDTHxHEIGHT with sides from 16 to 4096, such as 1280x720")),
    }
}

/// An age from 0 to 4.
pub fn parse_age(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(age) if (0.0..=4.0).contains(&age) => Ok(age),
        _ => Err(format!("`{text}` is not an age from 0 to 4")),
    }
}

/// A preset, with its name.
pub fn parse_preset(name: &str) -> Result<(String, CoatingSettings), String> {
    CoatingSettings::preset(name).map(|settings| (name.to_owned(), settings)).map_err(|error| error.to_string())
}

/// Paint does not grow back: pictures are taken in order of age, each age once.
fn in_order(ages: &[f64]) -> Vec<f64> {
    let mut ages = ages.to_vec();
    ages.sort_by(f64::total_cmp);
    ages.dedup();
    ages
}
