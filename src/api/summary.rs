//! Defines the figures and ratings that each film carries.

use bevy::{
    ecs::{component::Component, entity::Entity},
    math::Vec3,
    reflect::prelude::*,
};

use super::messages::RatingReached;
use crate::survey::{FilmShares, FilmSurvey, FilmView, Ratings};

/// Shares by area and ratings of one film, on its entity.
///
/// The plugin keeps it up to date, at every hundredth of the film's age and at the end of each frame in which the film
/// separated, tore, lost a piece, stained visibly, or was edited or put into another state. It counts as changed only
/// where a figure has changed. It is neither cloned nor saved with a scene.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{prelude::*, survey::RustGrade};
///
/// /// Marks props for a new coat of paint.
/// fn condemn(films: Query<(&CoatedBy, &FilmSummary), Changed<FilmSummary>>) {
///     for (CoatedBy(prop), summary) in &films {
///         if summary.ratings.rust >= RustGrade::Ri4 {
///             info!("{prop} has rusted on {:.0} % of its surface", 100.0 * summary.shares.rusted);
///         }
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, condemn);
/// app.update();
/// ```
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Reflect)]
#[component(clone_behavior = Ignore)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub struct FilmSummary {
    /// Shares of the film by area, and its cracks.
    pub shares: FilmShares,
    /// Ratings of the film by the standards for coatings.
    pub ratings: Ratings,
}

/// Survey that keeps the [`FilmSummary`] of a film up to date, and the place of the film.
#[derive(Component, Clone, Debug, Default)]
#[component(clone_behavior = Ignore)]
pub(crate) struct FilmSurveyed {
    /// Keeper of the shares.
    pub survey: FilmSurvey,
    /// Corners of a box around the film as it was at the end of the last frame and at rest, in the film's space; `None`
    /// before the first frame.
    pub bounds: Option<(Vec3, Vec3)>,
    /// Worst ratings so far, and the age at the last look.
    told: Option<(Ratings, f64)>,
}

impl FilmSurveyed {
    /// Looks at the film, in any case or only if its figures may have changed. Returns its summary if it was looked at.
    pub fn look(&mut self, view: FilmView, always: bool) -> Option<FilmSummary> {
        if always {
            self.survey.look(view);
        } else if !self.survey.update(view) {
            return None;
        }
        let shares = *self.survey.shares();
        Some(FilmSummary { shares, ratings: Ratings::from(&shares) })
    }

    /// Calls `tell` with each of the film's ratings that is worse than ever. A film that has just appeared or is
    /// younger than at the last look has no past that its ratings could be worse than.
    pub fn tell(&mut self, entity: Entity, root: Entity, age: f64, now: Ratings, mut tell: impl FnMut(RatingReached)) {
        let before = self.told.filter(|(_, then)| *then <= age).map(|(ratings, _)| ratings);
        if let Some(before) = before {
            for rating in now.worse_than(&before) {
                tell(RatingReached { entity, root, age, rating, before: rating.same_of(&before) });
            }
        }
        self.told = Some((before.map_or(now, |before| before.worst(now)), age));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::survey::{Rating, RustGrade};

    #[test]
    fn ratings_are_told_once_and_again_only_in_another_life() {
        let mut surveyed = FilmSurveyed::default();
        let film = Entity::PLACEHOLDER;
        let mut told = |age: f64, rust: RustGrade| {
            let mut all = Vec::new();
            surveyed.tell(film, film, age, Ratings { rust, ..Ratings::default() }, |reached| all.push(reached));
            all.into_iter().map(|reached| (reached.before, reached.rating)).collect::<Vec<_>>()
        };
        let step = |from, to| vec![(Rating::Rust(from), Rating::Rust(to))];
        assert!(told(0.5, RustGrade::Ri1).is_empty(), "it appeared so");
        assert_eq!(told(0.6, RustGrade::Ri3), step(RustGrade::Ri1, RustGrade::Ri3));
        assert!(told(0.6, RustGrade::Ri3).is_empty() && told(0.7, RustGrade::Ri2).is_empty());
        assert!(told(0.8, RustGrade::Ri3).is_empty(), "no worse than it has been");
        assert!(told(0.1, RustGrade::Ri2).is_empty(), "it went back in time");
        assert_eq!(told(0.2, RustGrade::Ri3), step(RustGrade::Ri2, RustGrade::Ri3));
    }
}
