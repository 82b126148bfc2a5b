//! The rim of the brush, drawn on the surface.

use bevy::{
    color::palettes::css::ORANGE,
    ecs::system::{Query, Res},
    gizmos::{config::GizmoConfigGroup, gizmos::Gizmos},
    picking::hover::HoverMap,
    reflect::prelude::*,
    transform::components::GlobalTransform,
};

use super::brush::CoatingBrush;
use crate::{
    api::links::FilmSource,
    film::FilmMesh,
    inspect::FilmHit,
    touch::{Site, outline},
};

/// Group of Bevy's gizmos that draws the rim of a [`CoatingBrush`].
#[derive(Clone, Copy, Debug, Default, Reflect, GizmoConfigGroup)]
#[reflect(Default, Debug, Clone)]
pub struct BrushGizmos;

/// Draws the rim of the brush where pointers hover over paint.
pub(super) fn draw_ring(
    brush: Res<CoatingBrush>,
    hovered: Option<Res<HoverMap>>,
    films: Query<(&FilmMesh, &FilmSource, &GlobalTransform)>,
    mut gizmos: Gizmos<BrushGizmos>,
) {
    let Some(hovered) = hovered.filter(|_| brush.effect.is_some() && !brush.blocked) else { return };
    for (&film, hit) in hovered.values().flatten() {
        let Some(FilmHit { point, .. }) = hit.extra_as::<FilmHit>() else { continue };
        let Ok((mesh, source, transform)) = films.get(film) else { continue };
        let place = source.place(transform);
        // Lines on the surface flicker; a hundredth of the radius is not seen from beside.
        let lift = hit.normal.unwrap_or_default() * (0.01 * brush.radius);
        for ends in outline(mesh, Site::new(point.face, point.barycentric), brush.radius * source.metres_per_unit) {
            let [a, b] = ends.map(|p| place.transform_point3(p) + lift);
            gizmos.line(a, b, ORANGE);
        }
    }
}
