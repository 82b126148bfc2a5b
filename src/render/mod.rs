//! Display.
use crate::{
    film::{
        FilmMesh,
        build::{BuiltFilm, Surface},
    },
    fracture::FilmForces,
    plugin::SlotAttributes,
};
use bevy::{
    app::{App, Plugin},
    asset::{Assets, Handle},
    ecs::component::Component,
    math::Vec3,
    mesh::Mesh,
};
#[derive(Component)]
pub(crate) struct ShownFilm;
impl ShownFilm {
    pub fn new(_: &FilmMesh, _: &Surface, _: &BuiltFilm, _: Vec<SlotAttributes>, _: Vec3, _: u64) -> Self {
        Self
    }
    pub fn put_on(&mut self, _: &FilmMesh, _: &FilmForces, _: &mut Assets<Mesh>) -> Vec<Handle<Mesh>> {
        Vec::new()
    }
}
pub(crate) struct ShownFilmPlugin;
impl Plugin for ShownFilmPlugin {
    fn build(&self, _: &mut App) {}
}
#[cfg(feature = "render")]
pub(crate) fn is_material_ready(
    _: &bevy::ecs::world::World,
    _: bevy::ecs::world::EntityRef,
) -> Result<bool, crate::plugin::CoatingFault> {
    Ok(true)
}
