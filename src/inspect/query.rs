//! Answers what lies where in the world, over all films.

use bevy::{
    ecs::{
        entity::Entity,
        system::{Query, SystemParam},
    },
    math::{Affine3A, Dir3, Vec3},
    transform::components::GlobalTransform,
};

use crate::{
    api::{
        links::{CoatedBy, FilmSource},
        summary::FilmSurveyed,
    },
    film::FilmMesh,
    fracture::FilmForces,
    stain::StainFields,
    survey::{FilmArea, FilmPoint, FilmView},
};

/// Place of a film, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmHit {
    /// Entity of the film.
    pub entity: Entity,
    /// Entity with the film's `Coating`.
    pub root: Entity,
    /// Place of the film. Positions, normal and distance are those in the world.
    pub point: FilmPoint,
}

/// Questions to all films about places in the world, as a parameter of systems.
///
/// Everything is in world space and in its units. Films are asked where they stand at their present
/// [`GlobalTransform`]; those whose boxes are out of reach cost next to nothing. A film that becomes ready in this
/// frame answers from the next on.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{FilmQuery, prelude::*, survey::FilmSurface};
///
/// #[derive(Component)]
/// struct Boot;
///
/// /// Plays the sound of what a boot steps on.
/// fn step(boots: Query<&GlobalTransform, With<Boot>>, films: FilmQuery) {
///     for boot in &boots {
///         match films.at_point(boot.translation(), 0.1).map(|hit| hit.point.surface) {
///             Some(FilmSurface::RustedMetal) => info!("crunch"),
///             Some(FilmSurface::BareMetal) => info!("clank"),
///             Some(_) => info!("thud"),
///             None => {}
///         }
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, step);
/// app.update();
/// ```
#[derive(SystemParam)]
pub struct FilmQuery<'w, 's> {
    films: Query<
        'w,
        's,
        (
            Entity,
            &'static CoatedBy,
            &'static FilmSource,
            &'static GlobalTransform,
            &'static FilmMesh,
            &'static FilmForces,
            &'static StainFields,
            &'static FilmSurveyed,
        ),
    >,
}

/// One film and its place in the world.
struct Placed<'a> {
    entity: Entity,
    root: Entity,
    view: FilmView<'a>,
    /// From the film's space to the world.
    place: Affine3A,
    /// From the world to the film's space.
    back: Affine3A,
    /// Metres in the film's space that a unit of the world is long.
    metres_per_unit: f32,
    bounds: (Vec3, Vec3),
}

impl FilmQuery<'_, '_> {
    /// Returns the place nearest to `point`, of film or of metal that is bare, or `None` if there is none within the
    /// distance `within`. See [`FilmView::nearest`] for what counts.
    pub fn at_point(&self, point: Vec3, within: f32) -> Option<FilmHit> {
        self.nearest(within, |film, within| {
            let point = film.back.transform_point3(point);
            (film.distance(point) <= within).then(|| film.view.nearest(point, within)).flatten()
        })
    }

    /// Returns the first place that a ray from `origin` along `direction` meets within the distance `within`. See
    /// [`FilmView::along_ray`] for what counts.
    pub fn along_ray(&self, origin: Vec3, direction: Dir3, within: f32) -> Option<FilmHit> {
        self.nearest(within, |film, within| {
            let origin = film.back.transform_point3(origin);
            let direction = film.back.transform_vector3(*direction).normalize_or_zero();
            film.is_met(origin, direction, within).then(|| film.view.along_ray(origin, direction, within)).flatten()
        })
    }

    /// Returns what lies within `radius` of `centre`, of all films together, or `None` if there is nothing. Areas are
    /// in square metres. See [`FilmView::in_sphere`] for what counts.
    pub fn in_sphere(&self, centre: Vec3, radius: f32) -> Option<FilmArea> {
        self.films_in_sphere(centre, radius).map(|(.., area)| area).reduce(|all, area| all.merged(&area))
    }

    /// Returns each film of which something lies within `radius` of `centre`: its entity, the entity with its
    /// `Coating`, and what lies there. See [`FilmView::in_sphere`] for what counts.
    pub fn films_in_sphere(&self, centre: Vec3, radius: f32) -> impl Iterator<Item = (Entity, Entity, FilmArea)> {
        self.placed().filter_map(move |film| {
            let (centre, radius) = (film.back.transform_point3(centre), radius * film.metres_per_unit);
            let area = (film.distance(centre) <= radius).then(|| film.view.in_sphere(centre, radius)).flatten()?;
            Some((film.entity, film.root, area))
        })
    }

    /// Returns the nearest of what `find` finds on the films within a distance, which is given to it in the film's
    /// space. Of two that are equally near, that of the lower entity.
    fn nearest(&self, within: f32, find: impl Fn(&Placed, f32) -> Option<FilmPoint>) -> Option<FilmHit> {
        let mut best: Option<FilmHit> = None;
        for film in self.placed() {
            let reach = best.map_or(within, |best| best.point.distance);
            let Some(point) = find(&film, reach * film.metres_per_unit) else { continue };
            let point = point.placed(&film.place);
            let hit = FilmHit { entity: film.entity, root: film.root, point };
            let nearer = |best: FilmHit| {
                let (new, old) = (point.distance, best.point.distance);
                new < old || (new == old && hit.entity < best.entity)
            };
            if best.is_none_or(nearer) {
                best = Some(hit);
            }
        }
        best
    }

    /// Returns all films that have been surveyed, with their places.
    fn placed(&self) -> impl Iterator<Item = Placed<'_>> {
        self.films.iter().filter_map(|(entity, coated_by, source, transform, mesh, forces, stains, surveyed)| {
            let place = source.place(transform);
            let (root, metres_per_unit) = (coated_by.0, source.metres_per_unit);
            let view = FilmView { mesh, forces, stains, hidden: &source.hidden };
            let bounds = surveyed.bounds?;
            Some(Placed { entity, root, view, place, back: place.inverse(), metres_per_unit, bounds })
        })
    }
}

impl Placed<'_> {
    /// Returns the distance of a point from the film's box, in the film's space; NaN for a point that is none.
    fn distance(&self, point: Vec3) -> f32 {
        let (min, max) = self.bounds;
        // `max` of vectors may take either where one is NaN.
        if point.is_nan() { f32::NAN } else { (min - point).max(point - max).max(Vec3::ZERO).length() }
    }

    /// Returns whether a ray may meet the film's box within a distance, in the film's space.
    fn is_met(&self, origin: Vec3, direction: Vec3, within: f32) -> bool {
        let (min, max) = self.bounds;
        let (mut enter, mut leave) = (0.0f32, within);
        for axis in 0..3 {
            if direction[axis] == 0.0 {
                if !(min[axis]..=max[axis]).contains(&origin[axis]) {
                    return false;
                }
                continue;
            }
            let [one, other] = [min, max].map(|corner| (corner[axis] - origin[axis]) / direction[axis]);
            enter = enter.max(one.min(other));
            leave = leave.min(one.max(other));
        }
        enter <= leave
    }
}
