//! Shelters the films of a model from rain and sun: the model itself casts shadows.

use std::sync::Arc;

use bevy_math::{Affine3A, Vec3};

use super::{coat::Prop, parallel};
use crate::{
    sim::FilmState,
    stain::{
        Environment,
        exposure::{Blocker, ExposedSurface, TriangleTree},
    },
};

/// Casts shadows of all props on all films, as they are at rest. Does nothing in dry weather without sun.
pub fn shelter(props: &[Prop], films: &mut [FilmState], environment: &Environment) {
    let Environment { rain, sun, .. } = *environment;
    if rain == Vec3::ZERO && sun == Vec3::ZERO {
        return;
    }
    let trees: Vec<(Vec3, Arc<TriangleTree>)> =
        props.iter().zip(films.iter()).map(|(prop, film)| (prop.origin, Arc::new(tree(film)))).collect();
    let mut jobs: Vec<(usize, &mut FilmState)> = films.iter_mut().enumerate().collect();
    parallel::for_each(&mut jobs, |(i, film)| {
        let Some(&(origin, _)) = trees.get(*i) else { return };
        // A film shelters itself in any case.
        let others = trees.iter().enumerate().filter(|(other, _)| other != i).map(|(_, (at, tree))| Blocker {
            tree: tree.clone(),
            into: Affine3A::from_translation((origin.as_dvec3() - at.as_dvec3()).as_vec3()),
        });
        let blockers: Vec<Blocker> = others.collect();
        film.stains.exposure = ExposedSurface::new(&film.mesh).cast(&blockers, rain, sun);
    });
}

/// All faces of a film at rest.
fn tree(film: &FilmState) -> TriangleTree {
    let (topology, geometry) = (&film.mesh.topology, &film.mesh.geometry);
    let rest = |v| geometry.rest_positions[topology.original(v).index()];
    TriangleTree::new(topology.all_faces().map(|f| topology.corners(f).map(rest)))
}
