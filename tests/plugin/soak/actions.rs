//! Actions of the random app: what a game does with its props.

use bevy::{mesh::skinning::SkinnedMesh, prelude::*};
use bevy_coating::prelude::*;
use rand::RngExt;

use super::{
    Soak, one,
    props::{self, ClonedAt, Shape, Trouble},
};

/// Most props at a time.
const PROPS: usize = 30;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    Spawn,
    Clone,
    Despawn,
    DespawnPart,
    Swap,
    Move,
    Pause,
    Rate,
    Quality,
    Display,
    Settings,
    Reload,
    Seek,
    Seed,
    Recoat,
    Weather,
    Clock,
    Request,
    Break,
    Mend,
    Travel,
    Skip,
    History,
    Save,
    Restore,
    Respawn,
}

const ALL: [Action; 26] = [
    Action::Spawn,
    Action::Clone,
    Action::Despawn,
    Action::DespawnPart,
    Action::Swap,
    Action::Move,
    Action::Pause,
    Action::Rate,
    Action::Quality,
    Action::Display,
    Action::Settings,
    Action::Reload,
    Action::Seek,
    Action::Seed,
    Action::Recoat,
    Action::Weather,
    Action::Clock,
    Action::Request,
    Action::Break,
    Action::Mend,
    Action::Travel,
    Action::Skip,
    Action::History,
    Action::Save,
    Action::Restore,
    Action::Respawn,
];

/// All actions but those that the environment leaves out.
pub fn allowed() -> Vec<Action> {
    let without = std::env::var("COATING_SOAK_WITHOUT").unwrap_or_default();
    ALL.into_iter().filter(|action| !without.split(',').any(|name| name == format!("{action:?}"))).collect()
}

impl Soak {
    pub fn act(&mut self, action: Action) {
        let roots = props::roots(&mut self.app);
        if action == Action::Spawn || roots.len() < 3 {
            if roots.len() < PROPS {
                self.spawn();
            }
            return;
        }
        let root = roots[self.rng.random_range(0..roots.len())];
        self.journal.note(format!("{action:?} of {root}"));
        match action {
            Action::Clone if roots.len() < PROPS => self.clone_prop(root),
            Action::Spawn | Action::Clone => {}
            // Props are spawned and cloned more often than they go.
            Action::Despawn if roots.len() < PROPS / 2 => {}
            Action::Despawn => {
                self.app.world_mut().entity_mut(root).despawn();
            }
            Action::DespawnPart => self.despawn_part(root),
            Action::Swap => self.swap(root),
            Action::Move => {
                let by = Vec3::new(self.rng.random_range(-1.0..1.0), 0.0, self.rng.random_range(-1.0..1.0));
                let mut transform = self.app.world_mut().get_mut::<Transform>(root).expect("a transform");
                transform.translation += by;
            }
            Action::Pause => self.coating(root, |coating| coating.paused = !coating.paused),
            Action::Rate => {
                let rates = [0.0, 0.05, 0.3, 1.0, 2.5, f64::NAN, f64::INFINITY, -1.0];
                let rate = rates[self.rng.random_range(0..rates.len())];
                // What is refused at first has no rate to keep.
                if (0.0..=1000.0).contains(&rate) || self.oracle.has_films(root) {
                    self.coating(root, |coating| coating.rate = rate);
                }
            }
            Action::Quality => {
                let quality = [SolverQuality::Fast, SolverQuality::Default, SolverQuality::High];
                let quality = quality[self.rng.random_range(0..quality.len())];
                self.coating(root, |coating| coating.quality = quality);
            }
            Action::Display => {
                let display = [StainDisplay::None, StainDisplay::VertexColor, StainDisplay::Material];
                let display = display[self.rng.random_range(0..display.len())];
                let rust = self.rng.random_range(0.1..1.0);
                self.coating(root, |coating| {
                    coating.stain_display = display;
                    coating.shading.stains.rust_strength = rust;
                });
            }
            Action::Settings => {
                let source = self.settings();
                self.coating(root, |coating| coating.settings = source);
            }
            Action::Reload => self.reload(),
            Action::Seek => {
                let age = self.rng.random_range(0.0..1.5);
                self.rebuilt(root);
                self.coating(root, |coating| coating.start_age = age);
            }
            Action::Seed => {
                let seed = self.rng.random();
                self.rebuilt(root);
                self.coating(root, |coating| *coating = coating.clone().with_seed(seed));
            }
            Action::Recoat => {
                self.rebuilt(root);
                let coating = self.app.world_mut().entity_mut(root).take::<Coating>().expect("a coating");
                if self.rng.random() {
                    self.frame();
                }
                self.app.world_mut().entity_mut(root).insert(coating);
            }
            Action::Weather => self.weather(),
            Action::Clock => self.clock(),
            Action::Request => {
                let steps = self.rng.random_range(1..8);
                self.app.world_mut().resource_mut::<CoatingClock>().request_steps(steps);
            }
            Action::Break => self.break_prop(root),
            Action::Mend => self.mend(root),
            Action::Travel => {
                let age = self.rng.random_range(0.0..1.5);
                self.oracle.wish(root);
                self.app.world_mut().commands().entity(root).age_to(age);
            }
            Action::Skip => {
                let age = self.rng.random_range(0.0..0.1);
                for root in roots {
                    self.oracle.allow_travel(root);
                }
                self.app.world_mut().resource_mut::<CoatingClock>().skip(age);
            }
            Action::History => {
                self.oracle.allow_travel(root);
                let mut prop = self.app.world_mut().entity_mut(root);
                if prop.take::<CoatingHistory>().is_none() {
                    prop.insert(CoatingHistory { keyframe_bytes: 1 << 18 });
                }
            }
            Action::Save => {
                if let Ok(snapshot) = CoatingSnapshot::of(self.app.world(), root) {
                    self.saved.push((root, snapshot));
                }
            }
            Action::Restore => {
                // Also on props that have got other films since: they refuse it.
                let Some((saved, snapshot)) = one(&mut self.rng, &self.saved) else { return };
                let root = if self.rng.random_bool(0.8) { saved } else { root };
                if self.app.world().get::<Coating>(root).is_some() {
                    self.oracle.allow_travel(root);
                    self.app.world_mut().commands().entity(root).restore_films(snapshot);
                }
            }
            Action::Respawn => {
                let Some((_, snapshot)) = one(&mut self.rng, &self.saved) else { return };
                self.rebuilt(root);
                let coating = self.app.world_mut().entity_mut(root).take::<Coating>().expect("a coating");
                self.app.world_mut().entity_mut(root).insert((coating, snapshot));
            }
        }
    }

    fn coating(&mut self, root: Entity, change: impl FnOnce(&mut Coating)) {
        change(&mut self.app.world_mut().get_mut::<Coating>(root).expect("a coating"));
    }

    /// Notes that the films of `root` may be built again. No film can be built with a rate out of range.
    fn rebuilt(&mut self, root: Entity) {
        self.oracle.allow_rebuilding(root);
        self.set_rate_right(root);
        self.app.world_mut().entity_mut(root).remove::<ClonedAt>();
    }

    fn set_rate_right(&mut self, root: Entity) {
        let coating = self.app.world().get::<Coating>(root).expect("a coating");
        if !(0.0..=1000.0).contains(&coating.rate) {
            self.coating(root, |coating| coating.rate = 1.0);
        }
    }

    fn settings(&mut self) -> SettingsSource {
        let presets = [Preset::Heavy, Preset::Gentle, Preset::FewCracks];
        match self.rng.random_range(0..5) {
            i @ 0..3 => presets[i].into(),
            i => self.palette.settings[i - 3].clone().into(),
        }
    }

    fn spawn(&mut self) {
        let [kind, side] = [0; 2].map(|_| self.rng.random_range(0..12));
        let coating = Coating::new(self.settings())
            .with_resolution(FilmResolution::Keep)
            .with_steps_per_age(100)
            .with_rate(self.rng.random_range(0.1..2.0))
            .with_start_age(if self.rng.random() { self.rng.random_range(0.0..0.8) } else { 0.0 })
            .with_seed(self.rng.random());
        let place = Vec3::new(self.rng.random_range(-9.0..9.0), 0.0, self.rng.random_range(-9.0..9.0));
        let root = props::spawn(&mut self.app, &self.palette, kind, side, coating, place);
        if self.rng.random_bool(0.3) {
            self.app.world_mut().entity_mut(root).insert(RainShelter);
        }
        self.rebuilt(root);
    }

    fn clone_prop(&mut self, root: Entity) {
        let world = self.app.world();
        let steps = world.get::<FilmClock>(root).map(|clock| clock.steps);
        let owed = self.oracle.owed(root);
        let is_sound = world.get::<Coating>(root).is_some_and(|coating| coating.validate().is_ok());
        if !is_sound || world.get::<Trouble>(root).is_some() || self.oracle.may_be_rebuilt(root) {
            return;
        }
        let clone = self.app.world_mut().entity_mut(root).clone_and_spawn_with_opt_out(|builder| {
            builder.linked_cloning(true);
        });
        self.rebuilt(clone);
        self.app.world_mut().entity_mut(clone).insert(ClonedAt { of: root, steps, owed });
    }

    fn despawn_part(&mut self, root: Entity) {
        let mut parts = props::shapes(self.app.world(), root);
        parts.retain(|&part| part != root);
        let Some(part) = one(&mut self.rng, &parts) else { return };
        if let Some(Trouble::Mesh(entity) | Trouble::Skin(entity)) = self.app.world().get::<Trouble>(root)
            && *entity == part
        {
            self.app.world_mut().entity_mut(root).remove::<Trouble>();
        }
        self.rebuilt(root);
        self.app.world_mut().entity_mut(part).despawn();
    }

    fn swap(&mut self, root: Entity) {
        let shapes = props::shapes(self.app.world(), root);
        let Some(entity) = one(&mut self.rng, &shapes) else { return };
        if matches!(self.app.world().get::<Trouble>(root), Some(Trouble::Mesh(broken)) if *broken == entity) {
            self.app.world_mut().entity_mut(root).remove::<Trouble>();
        }
        let beside = self.app.world().get::<Shape>(entity).expect("a shape").beside;
        let shape = self.palette.shape(self.rng.random_range(0..4), beside);
        self.rebuilt(root);
        self.app.world_mut().entity_mut(entity).insert((Mesh3d(shape.mesh.clone()), shape));
    }

    fn reload(&mut self) {
        let Some(handle) = one(&mut self.rng, &self.palette.settings) else { return };
        let mut settings = CoatingSettings::from(Preset::Heavy);
        settings.adhesion.decay = self.rng.random_range(0.5..3.0);
        settings.tearing.beta = self.rng.random_range(0.2..0.8);
        let mut assets = self.app.world_mut().resource_mut::<Assets<CoatingSettings>>();
        assets.insert(&handle, settings).expect("settings that are there");
    }

    fn weather(&mut self) {
        let rain = self.rng.random_range(-1.0..1.0);
        let is_fair = self.rng.random_bool(0.5);
        let mut weather = self.app.world_mut().resource_mut::<CoatingWeather>();
        *weather = if is_fair {
            CoatingWeather::default()
        } else {
            let rain = Vec3::new(rain, -1.0, 0.0).normalize();
            CoatingWeather { rain, sun: Vec3::NEG_Y, wind: Vec3::X * 0.3, ..CoatingWeather::default() }
        };
    }

    fn clock(&mut self) {
        let target = self.rng.random_bool(0.2).then(|| self.rng.random_range(0.2..1.2));
        let speed = self.rng.random_range(0.02..0.6);
        let paused = self.rng.random_bool(0.25);
        let mut clock = self.app.world_mut().resource_mut::<CoatingClock>();
        (clock.target_age, clock.age_per_second, clock.paused) = (target, speed, paused);
    }

    /// Gives `root` a reason to be refused when its film is built next, which is at once.
    fn break_prop(&mut self, root: Entity) {
        let shapes = props::shapes(self.app.world(), root);
        let Some(entity) = one(&mut self.rng, &shapes) else { return };
        if self.app.world().get::<Trouble>(root).is_some() {
            return;
        }
        self.rebuilt(root);
        let world = self.app.world_mut();
        let trouble = match self.rng.random_range(0..4) {
            0 => {
                let mesh = world.resource_mut::<Assets<Mesh>>().add(props::broken_mesh());
                let beside = world.get::<Shape>(entity).expect("a shape").beside;
                world.entity_mut(entity).insert((Mesh3d(mesh.clone()), Shape { mesh, triangles: 0, beside }));
                Trouble::Mesh(entity)
            }
            1 => {
                let mut settings = CoatingSettings::default();
                settings.adhesion.decay = f32::NAN;
                let handle = world.resource_mut::<Assets<CoatingSettings>>().add(settings);
                let mut coating = world.entity_mut(root).take::<Coating>().expect("a coating");
                coating.settings = handle.clone().into();
                world.entity_mut(root).insert(coating);
                Trouble::Settings(handle)
            }
            2 => {
                let coating = world.entity_mut(root).take::<Coating>().expect("a coating");
                world.entity_mut(entity).insert(SkinnedMesh::default());
                world.entity_mut(root).insert(coating);
                Trouble::Skin(entity)
            }
            _ => {
                world.get_mut::<Coating>(root).expect("a coating").start_age = f64::NAN;
                Trouble::Field
            }
        };
        world.entity_mut(root).insert(trouble);
    }

    fn mend(&mut self, root: Entity) {
        if self.app.world().get::<Trouble>(root).is_some() {
            self.rebuilt(root);
            props::mend(&mut self.app, root);
        }
    }

    pub fn mend_all(&mut self) {
        for root in props::roots(&mut self.app) {
            self.mend(root);
            self.set_rate_right(root);
        }
    }

    pub fn despawn_all(&mut self) {
        for root in props::roots(&mut self.app) {
            self.app.world_mut().entity_mut(root).despawn();
        }
        *self.app.world_mut().resource_mut::<CoatingWeather>() = CoatingWeather::default();
    }
}
