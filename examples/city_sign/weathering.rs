//! Where the scene meets the coating plugin: which meshes are painted, and when all of them have a film.

use crate::cli::Options;
use bevy::ecs::system::SystemParam;
use bevy::prelude::*;
use bevy_coating::prelude::*;

/// Paint to be put on a mesh of the scene.
#[derive(Component, Clone, Copy, Debug)]
pub struct Painted {
    pub triangles: u32,
    pub seed: u64,
    pub wear: Wear,
}

/// How a part has fared.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wear {
    /// As the command line has it.
    Street,
    /// A better primer, or a sheltered place: less has come off.
    Sheltered,
}

/// Props asked for, and those in the scene already.
#[derive(Resource, Default, Debug)]
pub struct Loading {
    pub props: usize,
    pub loaded: usize,
}

/// Darker than the default: the low sun warms it.
const BARE_METAL: MetalLook = MetalLook {
    steel: Color::srgb(0.24, 0.21, 0.19),
    rust: Color::srgb(0.36, 0.19, 0.095),
    metallic: 0.55,
    roughness: 0.7,
};

/// Fresh paint for everything.
#[derive(Event)]
pub struct Repaint;

pub struct WeatheringPlugin;

impl Plugin for WeatheringPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins(CoatingWeatheringPlugin::default())
            .init_resource::<Loading>()
            .add_systems(Update, (coat, report))
            .add_observer(repaint);
    }
}

fn coat(
    mut commands: Commands,
    options: Res<Options>,
    fresh: Query<(Entity, &Painted), (Without<Coating>, With<Mesh3d>)>,
) {
    for (entity, painted) in &fresh {
        let mut settings = options.preset.1.clone();
        if painted.wear == Wear::Sheltered {
            settings.adhesion.mean += 0.5;
            settings.deform.bend_limit *= 0.6;
        }
        let coating =
            Coating::new(settings).with_seed(painted.seed).with_triangles(painted.triangles).with_metal(BARE_METAL);
        commands.entity(entity).insert(coating);
    }
}

/// Without its coating a mesh is as it was made; [`coat`] then paints it anew.
fn repaint(_: On<Repaint>, mut commands: Commands, painted: Query<Entity, With<Painted>>) {
    for entity in &painted {
        commands.entity(entity).remove::<Coating>();
    }
}

fn report(mut failures: MessageReader<FilmFailed>) {
    for failure in failures.read() {
        error!("{}", failure.error);
    }
}

/// How far the scene has come.
#[derive(SystemParam)]
pub struct Progress<'w, 's> {
    loading: Res<'w, Loading>,
    status: Res<'w, CoatingStatus>,
    painted: Query<'w, 's, (), With<Painted>>,
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

    /// Age of the youngest film.
    pub fn age(&self) -> f64 {
        self.status.youngest
    }

    /// Every film has come to `age`, to within half a step.
    pub fn has_reached(&self, age: f64) -> bool {
        self.status.youngest > age - 0.5e-3
    }
}
