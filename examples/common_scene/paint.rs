//! Where a scene meets the coating plugin: which meshes are painted, and when all of them have a film.

use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_coating::prelude::*;

/// The paint of a mesh of the scene.
#[derive(Component, Clone, Debug)]
pub struct Paint(pub Coating);

/// Props asked for, and those in the scene already.
#[derive(Resource, Default, Debug)]
pub struct Loading {
    pub props: usize,
    pub loaded: usize,
    /// Files that the props are made from.
    pub files: Vec<UntypedHandle>,
}

/// Fresh paint for everything.
#[derive(Event)]
pub struct Repaint;

pub struct PaintPlugin;

impl Plugin for PaintPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins(CoatingWeatheringPlugin::default())
            .init_resource::<Loading>()
            .add_systems(Update, (coat, report, give_up))
            .add_observer(repaint);
    }
}

fn coat(mut commands: Commands, fresh: Query<(Entity, &Paint), (Without<Coating>, With<Mesh3d>)>) {
    for (entity, paint) in &fresh {
        commands.entity(entity).insert(paint.0.clone());
    }
}

/// Without its coating a mesh is as it was made; [`coat`] then paints it anew.
fn repaint(_: On<Repaint>, mut commands: Commands, painted: Query<Entity, With<Paint>>) {
    for entity in &painted {
        commands.entity(entity).remove::<Coating>();
    }
}

fn report(mut failures: MessageReader<FilmFailed>) {
    for failure in failures.read() {
        error!("{}", failure.error);
    }
}

/// A model that cannot be loaded would be waited for in vain.
fn give_up(assets: Res<AssetServer>, loading: Res<Loading>, mut exit: MessageWriter<AppExit>) {
    if loading.files.iter().any(|file| assets.load_state(file).is_failed()) {
        error!("A model of the scene is missing; run the example from a whole copy of the repository.");
        exit.write(AppExit::error());
    }
}

/// How far the scene has come.
#[derive(SystemParam)]
pub struct Progress<'w, 's> {
    loading: Res<'w, Loading>,
    status: Res<'w, CoatingStatus>,
    painted: Query<'w, 's, (), With<Paint>>,
}

impl Progress<'_, '_> {
    /// Films that are ready, and films asked for.
    pub fn films(&self) -> (usize, usize) {
        (self.status.films, self.painted.iter().count() - self.status.refused.min(self.painted.iter().count()))
    }

    /// Every prop is in the scene, and every painted mesh has its film.
    pub fn is_ready(&self) -> bool {
        let (films, wanted) = self.films();
        self.loading.props > 0
            && self.loading.loaded == self.loading.props
            && self.status.waiting == 0
            && films >= wanted
    }

    /// Films on their way to another age.
    pub fn seeking(&self) -> usize {
        self.status.seeking
    }

    /// Age of the youngest film.
    pub fn age(&self) -> f64 {
        self.status.youngest
    }

    /// Age that films gained per second lately.
    pub fn age_per_second(&self) -> f64 {
        self.status.age_per_second
    }

    /// Every film has come to `age`, to within half a step of the finest film here.
    pub fn has_reached(&self, age: f64) -> bool {
        self.status.youngest > age - 0.5e-3
    }
}
