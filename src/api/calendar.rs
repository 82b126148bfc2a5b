//! Defines [`CoatingCalendar`], the date of the world and the weather since it began.

use bevy::{
    ecs::{reflect::ReflectResource, resource::Resource},
    reflect::prelude::*,
    transform::components::GlobalTransform,
};

use super::{clock::CoatingGravity, weather::CoatingWeather};
use crate::stain::Environment;

/// Most changes of weather that are remembered. When there are more, every second of the older half is forgotten.
const MOST_STRETCHES: usize = 4096;

/// Date of the world, and the weather that it has had.
///
/// The date is an age: that of paint of rate 1 which was fresh at date 0 and has never been away. It runs with the
/// [clock](super::clock::CoatingClock), at the pace that is reached. Props that say when they were
/// [painted](super::coating::Coating::painted) are as old as the date says when they appear, however late that is, in
/// the weather that there has been. A game that saves its world saves this with it.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{CoatingCalendar, prelude::*};
///
/// /// Streams a part of the world in, whose props were painted when the world began.
/// fn load_cell(mut commands: Commands, calendar: Res<CoatingCalendar>, mut meshes: ResMut<Assets<Mesh>>) {
///     info!("it is date {:.2}", calendar.date());
///     let tank = meshes.add(Cylinder::new(1.0, 2.0));
///     commands.spawn((Mesh3d(tank), Coating::new(Preset::Heavy).with_painted(0.0)));
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Startup, load_cell);
/// app.update();
/// ```
#[derive(Resource, Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingCalendar {
    date: f64,
    /// Stretches of the past, in order, each with one weather.
    stretches: Vec<Stretch>,
}

/// Time with one weather.
#[derive(Clone, Copy, Debug, PartialEq, Reflect)]
#[reflect(Debug, Clone, PartialEq)]
struct Stretch {
    /// Date at which it began.
    begin: f64,
    weather: CoatingWeather,
    gravity: CoatingGravity,
}

impl CoatingCalendar {
    /// Returns the calendar of a world that has this `date`, an age, with weather of which nothing is known.
    pub fn at(date: f64) -> Self {
        Self { date: if date.is_finite() { date } else { 0.0 }, stretches: Vec::new() }
    }

    /// Returns the date, an age.
    pub fn date(&self) -> f64 {
        self.date
    }

    /// Lets time pass by `age` in this weather.
    pub(crate) fn pass(&mut self, age: f64, weather: CoatingWeather, gravity: CoatingGravity) {
        if !(age > 0.0 && age.is_finite()) {
            return;
        }
        let is_new = |last: &Stretch| (last.weather, last.gravity) != (weather, gravity);
        if self.stretches.last().is_none_or(is_new) {
            self.stretches.push(Stretch { begin: self.date, weather, gravity });
            if self.stretches.len() > MOST_STRETCHES {
                let mut number = 0;
                self.stretches.retain(|_| {
                    number += 1;
                    number % 2 == 1 || number > MOST_STRETCHES / 2
                });
            }
        }
        self.date += age;
    }

    /// Returns the environment of a film at `transform` whose prop has had a weather of its own since `date`, with the
    /// age that has passed.
    pub(crate) fn since_in(
        &self,
        date: f64,
        weather: CoatingWeather,
        gravity: CoatingGravity,
        transform: &GlobalTransform,
    ) -> Vec<(f64, Environment)> {
        let age = self.date - date;
        if age > 0.0 && age.is_finite() { vec![(age, weather.environment(gravity, transform))] } else { Vec::new() }
    }

    /// Returns the environments of a film at `transform` since `date`, with the age that passed in each. Of what lies
    /// before the first weather that is known, `before` is taken. Since a date that is none, nothing has passed.
    pub(crate) fn since(
        &self,
        date: f64,
        before: CoatingWeather,
        gravity: CoatingGravity,
        transform: &GlobalTransform,
    ) -> Vec<(f64, Environment)> {
        if !date.is_finite() {
            return Vec::new();
        }
        let first = self.stretches.first().map_or(self.date, |stretch| stretch.begin);
        let unknown = Stretch { begin: f64::NEG_INFINITY, weather: before, gravity };
        let begins = self.stretches.iter().map(|stretch| stretch.begin).chain([self.date]);
        let ends = std::iter::once(first).chain(begins.skip(1));
        let stretches = std::iter::once(&unknown).chain(&self.stretches);
        let passed = |(stretch, end): (&Stretch, f64)| {
            let age = end - stretch.begin.max(date);
            (age > 0.0).then(|| (age, stretch.weather.environment(stretch.gravity, transform)))
        };
        stretches.zip(ends).filter_map(passed).collect()
    }
}

#[cfg(test)]
mod tests {
    use bevy::math::Vec3;

    use super::*;

    fn rain(strength: f32) -> CoatingWeather {
        CoatingWeather { rain: Vec3::NEG_Y * strength, ..CoatingWeather::default() }
    }

    fn rains(calendar: &CoatingCalendar, date: f64) -> Vec<(f64, f32)> {
        let at = GlobalTransform::IDENTITY;
        let since = calendar.since(date, rain(0.9), CoatingGravity::default(), &at);
        since.iter().map(|(age, environment)| (*age, environment.rain.length())).collect()
    }

    #[test]
    fn the_past_is_told_stretch_by_stretch() {
        let mut calendar = CoatingCalendar::at(1.0);
        assert_eq!(rains(&calendar, 0.5), [(0.5, 0.9)]);
        for (age, strength) in [(0.25, 0.5), (0.25, 0.5), (1.0, 0.0), (0.5, 0.75)] {
            calendar.pass(age, rain(strength), CoatingGravity::default());
        }
        for nothing in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            calendar.pass(nothing, rain(0.1), CoatingGravity::default());
        }
        assert_eq!(calendar.date(), 3.0);
        assert_eq!(rains(&calendar, 0.0), [(1.0, 0.9), (0.5, 0.5), (1.0, 0.0), (0.5, 0.75)]);
        assert_eq!(rains(&calendar, 1.25), [(0.25, 0.5), (1.0, 0.0), (0.5, 0.75)]);
        assert_eq!(rains(&calendar, 2.75), [(0.25, 0.75)]);
        assert_eq!(rains(&calendar, 3.0), []);
        assert_eq!(rains(&calendar, f64::NAN), [], "a date that is none");
        assert_eq!(CoatingCalendar::at(f64::NAN).date(), 0.0);
    }

    #[test]
    fn a_long_past_is_remembered_more_and_more_roughly() {
        let mut calendar = CoatingCalendar::default();
        for i in 0..20_000 {
            calendar.pass(0.5, rain(0.001 * (i % 7) as f32), CoatingGravity::default());
        }
        let since = rains(&calendar, 0.0);
        assert!(since.len() <= MOST_STRETCHES + 1);
        assert_eq!(since.iter().map(|(age, _)| age).sum::<f64>(), 10_000.0, "no time is lost");
    }
}
