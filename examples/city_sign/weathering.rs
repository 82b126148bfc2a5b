//! The one place where the scene meets the coating plugin.

use bevy::prelude::*;

/// Paint to be put on a mesh of the scene.
#[derive(Component, Clone, Copy, Debug)]
pub struct Coat {
    pub triangles: u32,
    pub seed: u64,
}

/// Props asked for, and those in the scene already.
#[derive(Resource, Default, Debug)]
pub struct Loading {
    pub props: usize,
    pub loaded: usize,
}

impl Loading {
    pub fn finished(&self) -> bool {
        self.loaded == self.props
    }
}

/// How the scene ages: the controls' side and, in the last three fields, the answer.
#[derive(Resource, Debug)]
pub struct Pace {
    pub paused: bool,
    /// Age per second.
    pub speed: f32,
    /// Age to stop at.
    pub goal: Option<f32>,
    /// One step although paused.
    pub step: bool,
    /// Back to fresh paint.
    pub reset: bool,
    pub age: f32,
    /// Films that are built, and films asked for.
    pub films: (usize, usize),
    /// Every film has reached the goal.
    pub settled: bool,
}

impl Default for Pace {
    fn default() -> Self {
        Self { paused: false, speed: 0.05, goal: None, step: false, reset: false, age: 0.0, films: (0, 0), settled: false }
    }
}

pub struct ScenePacePlugin;

impl Plugin for ScenePacePlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<Pace>().add_systems(Update, advance);
    }
}

fn advance(mut pace: ResMut<Pace>, time: Res<Time>, coats: Query<&Coat>) {
    let count = coats.iter().count();
    pace.films = (count, count);
    if std::mem::take(&mut pace.reset) {
        pace.age = 0.0;
    }
    if !pace.paused {
        pace.age += pace.speed * time.delta_secs();
    }
    if let Some(goal) = pace.goal {
        pace.age = goal;
        pace.settled = true;
    }
}
