//! Hands pace and weather of each coating to its films before the steps of a frame, so that a pause acts at once.

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        system::{Local, Query},
    },
    log::warn,
};

use crate::api::{coating::Coating, film_pace::FilmPace, links::CoatedBy, weather::PropWeather};

/// Hands rate, pause, quality and weather of each coating to its films. A rate out of range is told once.
pub(crate) fn follow_coatings(
    coatings: Query<(&Coating, Option<&PropWeather>)>,
    mut films: Query<(&CoatedBy, &mut FilmPace)>,
    mut told: Local<Told>,
) {
    for (&CoatedBy(root), mut pace) in &mut films {
        let Ok((coating, weather)) = coatings.get(root) else { continue };
        pace.bypass_change_detection().weather = weather.map(|weather| weather.0);
        if let Err(fault) = pace.bypass_change_detection().follow(coating)
            && told.is_news(root)
        {
            warn!("coating {root} keeps the rate that it had: {fault}");
        }
    }
    told.retain(|root| coatings.get(root).is_ok_and(|(coating, _)| coating.checked_rate().is_err()));
}

/// Coatings of which it was told that they are out of range, and still are.
#[derive(Debug, Default)]
pub(crate) struct Told(Vec<Entity>);

impl Told {
    /// Returns whether `root` has not been told of, and notes that it has been now.
    fn is_news(&mut self, root: Entity) -> bool {
        let is_news = !self.0.contains(&root);
        if is_news {
            self.0.push(root);
        }
        is_news
    }

    /// Forgets the coatings that are in range again.
    fn retain(&mut self, is_out_of_range: impl Fn(Entity) -> bool) {
        self.0.retain(|&root| is_out_of_range(root));
    }
}

#[cfg(test)]
mod tests {
    use bevy::ecs::world::World;

    use super::*;

    #[test]
    fn a_rate_out_of_range_is_told_once_until_it_is_in_range_again() {
        let mut world = World::new();
        let [one, other] = [0; 2].map(|_| world.spawn_empty().id());
        let mut told = Told::default();
        assert!(told.is_news(one) && !told.is_news(one) && told.is_news(other));
        told.retain(|root| root == other);
        assert!(told.is_news(one) && !told.is_news(other));
    }
}
