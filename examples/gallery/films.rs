//! Each film on its way: what is done to it before it ages, the age at which it is shown, and how.

use crate::cli::Options;
use crate::common_scene::paint::Loading;
use crate::measure::exhibit::Beginning;
use crate::measure::figure::{Look, Panel};
use crate::measure::spread::in_parallel;
use crate::wires;
use bevy::prelude::*;
use bevy_coating::deform::FilmConstraints;
use bevy_coating::film::FilmMesh;
use bevy_coating::fracture::FilmForces;
use bevy_coating::sim::{FilmClock, FilmState};
use bevy_coating::stain::{Environment, StainFields};
use bevy_coating::{CoatingPart, CoatingStatus, HeatMapView, prelude::*};

/// What is wanted of a film, on the prop.
#[derive(Component, Clone, Debug)]
pub struct Wanted {
    pub panel: Panel,
    /// File of its figure.
    pub figure: &'static str,
}

/// Whether a film is as it is wanted, on the prop.
#[derive(Component, Clone, Copy, PartialEq, Eq, Debug)]
struct Begun;

pub struct FilmsPlugin;

impl Plugin for FilmsPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Update, (begin, arrive, hide_metal).chain());
    }
}

/// Begins what is done to films that are ready, and sends them to the age at which they are shown. For a moving picture
/// they age with the clock.
fn begin(
    mut commands: Commands,
    mut ready: MessageReader<FilmReady>,
    wanted: Query<&Wanted, Without<Begun>>,
    mut films: Query<(&mut FilmMesh, &mut FilmForces, &mut FilmConstraints, &mut FilmClock)>,
    options: Res<Options>,
) {
    for film in ready.read() {
        let Ok(Wanted { panel, .. }) = wanted.get(film.root) else { continue };
        let Ok((mut mesh, mut forces, mut constraints, mut clock)) = films.get_mut(film.entity) else { continue };
        panel.exhibit.beginning.begin(&mut mesh, &mut forces, &mut constraints);
        if panel.age > 0.0 && options.scene.animate.is_none() {
            clock.seek(panel.age);
        }
        commands.entity(film.root).insert(Begun);
        if let Look::Heat(map) = panel.look {
            commands.entity(film.root).insert(HeatMapView::new(map));
        }
    }
}

/// In free space there is no metal under a film.
fn hide_metal(mut parts: Query<(&Name, &ChildOf, &mut Visibility), Added<CoatingPart>>, props: Query<&Wanted>) {
    for (name, prop, mut visibility) in &mut parts {
        let is_free = props.get(prop.parent()).is_ok_and(|prop| prop.panel.exhibit.beginning == Beginning::Free);
        if is_free && name.as_str() == "bare metal" {
            *visibility = Visibility::Hidden;
        }
    }
}

/// Lets pictures be taken when all films are as they are wanted, and then tells whether they are those that are
/// measured.
fn arrive(
    mut commands: Commands,
    mut loading: ResMut<Loading>,
    status: Res<CoatingStatus>,
    options: Res<Options>,
    wanted: Query<(&Wanted, &Transform, Has<Begun>)>,
    films: Query<(&FilmMesh, &FilmForces, &FilmConstraints, &StainFields, &FilmClock, &CoatedBy)>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let moving = options.scene.animate.is_some();
    let is_there = |clock: &FilmClock, coated_by: &CoatedBy| {
        let age = wanted.get(coated_by.0).map_or(0.0, |(Wanted { panel, .. }, ..)| panel.age);
        clock.sought().is_none() && (moving || clock.age() > age - 0.5e-3)
    };
    if loading.loaded == loading.props
        || status.seeking > 0
        || wanted.is_empty()
        || wanted.iter().any(|(.., begun)| !begun)
        || films.iter().count() < wanted.iter().count()
        || !films.iter().all(|(.., clock, coated_by)| is_there(clock, coated_by))
    {
        return;
    }
    loading.loaded = loading.props;
    if moving {
        return;
    }
    let mut found: Vec<(Panel, FilmState)> = Vec::new();
    for (mesh, forces, constraints, stains, clock, coated_by) in &films {
        let Ok((Wanted { panel, .. }, place, _)) = wanted.get(coated_by.0) else { continue };
        let film = FilmState {
            mesh: mesh.clone(),
            forces: forces.clone(),
            constraints: constraints.clone(),
            stains: stains.clone(),
            clock: *clock,
            ..FilmState::default()
        };
        match panel.look {
            Look::Wires => wires::draw(&mut commands, &mut meshes, &mut materials, (panel, *place, &film)),
            Look::Cracks => wires::draw_cracks(&mut commands, &mut meshes, &mut materials, (panel, *place, &film)),
            Look::Paint | Look::Heat(_) => {}
        }
        found.push((panel.clone(), film));
    }
    if options.scene.pictures() {
        check(&found);
    }
}

/// Tells whether the films that are drawn have the bits of those that are measured.
fn check(found: &[(Panel, FilmState)]) {
    let same = in_parallel(found.len(), |index| {
        let (panel, film) = &found[index];
        let mut measured = panel.exhibit.film(film.clock.steps_per_age).ok()?;
        measured.age_to(panel.age, &panel.exhibit.settings, &Environment::default());
        Some(measured.digest() == film.digest())
    });
    let count = same.iter().filter(|same| **same == Some(true)).count();
    println!("{count} of {} films that are drawn have the bits of those that are measured", found.len());
    for ((panel, _), _) in found.iter().zip(&same).filter(|(_, same)| **same != Some(true)) {
        println!("  not so: {} \"{}\" at age {}", panel.exhibit.name, panel.exhibit.title, panel.age);
    }
}
