//! Keeps the summaries of films up to date, and tells of ratings that have got worse.

use bevy::{
    ecs::{
        change_detection::{DetectChanges, DetectChangesMut, Ref},
        entity::Entity,
        message::MessageWriter,
        query::QueryData,
        system::{Query, ResMut},
    },
    math::Vec3,
};

use crate::{
    api::{
        diagnostics::CoatingTimings,
        film_pace::FilmPace,
        links::{CoatedBy, FilmSource},
        messages::RatingReached,
        summary::{FilmSummary, FilmSurveyed},
    },
    film::{FilmChanges, FilmMesh},
    fracture::FilmForces,
    sim::{FilmClock, Stage},
    stain::StainFields,
    survey::FilmView,
};

/// Everything of a film that its summary is about.
#[derive(QueryData)]
#[query_data(mutable)]
pub(crate) struct Surveyed {
    entity: Entity,
    coated_by: &'static CoatedBy,
    mesh: Ref<'static, FilmMesh>,
    forces: &'static FilmForces,
    stains: &'static StainFields,
    clock: &'static FilmClock,
    source: &'static FilmSource,
    surveyed: &'static mut FilmSurveyed,
    summary: &'static mut FilmSummary,
}

/// Surveys the films that have just completed a tick of stains, if anything about them has changed.
pub(crate) fn survey_due(
    mut films: Query<(&FilmPace, &FilmChanges, Surveyed)>,
    mut reached: MessageWriter<RatingReached>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Other, || {
        for (pace, changes, mut film) in &mut films {
            if pace.due && film.clock.tick().is_some() {
                film.look(changes.moved, &mut reached);
            }
        }
    });
}

/// Surveys the films that have changed since the last survey, and finds where those that have moved are.
pub(crate) fn survey_changed(mut films: Query<Surveyed>, mut reached: MessageWriter<RatingReached>) {
    for mut film in &mut films {
        if film.mesh.is_changed() || film.surveyed.bounds.is_none() {
            film.surveyed.bypass_change_detection().bounds = Some(bounds(&film.mesh));
        }
        film.look(false, &mut reached);
    }
}

impl SurveyedItem<'_, '_> {
    /// Looks at the film, in any case or only if its figures may have changed.
    fn look(&mut self, always: bool, reached: &mut MessageWriter<RatingReached>) {
        let Self { mesh, forces, stains, source, .. } = self;
        let view = FilmView { mesh, forces, stains, hidden: &source.hidden };
        let surveyed = self.surveyed.bypass_change_detection();
        let Some(summary) = surveyed.look(view, always) else { return };
        let (entity, root, age) = (self.entity, self.coated_by.0, self.clock.age());
        surveyed.tell(entity, root, age, summary.ratings, |message| {
            reached.write(message);
        });
        self.summary.set_if_neq(summary);
    }
}

/// Returns the corners of a box around a film as it is now and at rest. Until the next look it may move by a mean edge.
fn bounds(mesh: &FilmMesh) -> (Vec3, Vec3) {
    let geometry = &mesh.geometry;
    let points = geometry.positions.iter().chain(&geometry.rest_positions);
    let (min, max) = points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), &p| (min.min(p), max.max(p)));
    let margin = Vec3::splat(geometry.mean_edge);
    (min - margin, max + margin)
}
