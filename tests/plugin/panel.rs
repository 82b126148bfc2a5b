//! The panel, drawn onto an image and used by a pointer. Needs a graphics adapter, be it a software renderer.

use std::collections::BTreeMap;

use bevy::{gltf::GltfAssetLabel, prelude::*, world_serialization::WorldAssetRoot};
use bevy_coating::{
    CoatingBrush, CoatingGizmos, CoatingPanel, CoatingPanelPlugin, HeatMapView, PanelWidget,
    film::FilmMesh,
    heat::HeatMap,
    prelude::*,
    touch::{Change, Effect},
};
use bevy_egui::{
    EguiContext, EguiGlobalSettings, EguiPlugin, PrimaryEguiContext,
    egui::{self, Pos2, Rect, pos2},
    input::EguiInputEvent,
};

use crate::{common::*, stained::save, studio::Studio};

const SIZE: (u32, u32) = (1280, 720);

/// How often each component that the panel may write was changed.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
struct Writes {
    coatings: usize,
    clocks: usize,
}

fn count_writes(
    mut writes: ResMut<Writes>,
    coatings: Query<(), Changed<Coating>>,
    clocks: Query<(), Changed<FilmClock>>,
) {
    writes.coatings += coatings.iter().count();
    writes.clocks += clocks.iter().count();
}

/// A desk with the panel on its screen.
struct Desk {
    studio: Studio,
    camera: Entity,
}

impl Desk {
    /// Opens one with two plates, if anything can be drawn.
    fn with_plates() -> Option<Self> {
        let mut desk = Self::open(".")?;
        for (name, seed) in [("left plate", 1), ("right plate", 2)] {
            let coating = quick_coating().with_seed(seed);
            let mesh = add_mesh(&mut desk.studio.app, plate(8));
            let at = Transform::from_xyz(seed as f32 * 1.2 - 2.3, -0.5, 0.0);
            desk.studio.app.world_mut().spawn((Name::new(name), Mesh3d(mesh), at, coating));
        }
        wait_for_films(&mut desk.studio.app, 2);
        for _ in 0..4 {
            desk.studio.app.update();
        }
        Some(desk)
    }

    fn open(assets: &str) -> Option<Self> {
        let mut studio = Studio::open_with(SIZE.0, SIZE.1, assets, |app| {
            app.add_plugins((EguiPlugin::default(), CoatingPanelPlugin));
            app.insert_resource(EguiGlobalSettings { auto_create_primary_context: false, ..default() });
            app.init_resource::<Writes>().add_systems(Last, count_writes);
        })?;
        let camera = studio.camera_mut().insert(PrimaryEguiContext).id();
        studio.app.update();
        // A software renderer takes its time between pressing and releasing.
        let mut context = studio.app.world_mut().get_mut::<EguiContext>(camera).expect("a context");
        context.get_mut().options_mut(|options| options.input_options.max_click_duration = 60.0);
        Some(Self { studio, camera })
    }

    fn world(&mut self) -> &mut World {
        self.studio.app.world_mut()
    }

    fn place(&self, widget: PanelWidget) -> Rect {
        let panel = self.studio.app.world().resource::<CoatingPanel>();
        panel.place(widget).unwrap_or_else(|| panic!("{widget:?} is not there"))
    }

    /// Hands an event to egui and lets a frame pass.
    fn send(&mut self, event: egui::Event) {
        let context = self.camera;
        self.world().write_message(EguiInputEvent { context, event });
        self.studio.app.update();
    }

    fn press(&mut self, pos: Pos2, pressed: bool) {
        let button = egui::PointerButton::Primary;
        self.send(egui::Event::PointerButton { pos, button, pressed, modifiers: egui::Modifiers::NONE });
    }

    fn click(&mut self, widget: PanelWidget) {
        let middle = self.place(widget).center();
        self.send(egui::Event::PointerMoved(middle));
        self.press(middle, true);
        self.press(middle, false);
        self.studio.app.update();
    }

    /// Drags along a widget, between two shares of its width.
    fn drag(&mut self, widget: PanelWidget, from: f32, to: f32) {
        let rect = self.place(widget);
        let at = |share: f32| pos2(rect.left() + share * rect.width(), rect.center().y);
        self.send(egui::Event::PointerMoved(at(from)));
        self.press(at(from), true);
        for step in 1..=4 {
            self.send(egui::Event::PointerMoved(at(from + (to - from) * step as f32 / 4.0)));
        }
        self.press(at(to), false);
        self.studio.app.update();
    }

    fn prop(&self) -> Entity {
        self.studio.app.world().resource::<CoatingPanel>().prop.expect("a prop")
    }

    fn settings_of(&self, prop: Entity) -> CoatingSettings {
        match &self.studio.app.world().get::<Coating>(prop).expect("a coating").settings {
            SettingsSource::Inline(settings) => settings.clone(),
            other => panic!("{other:?}"),
        }
    }

    fn props(&mut self) -> Vec<Entity> {
        let world = self.world();
        let mut props: Vec<(String, Entity)> = (world.query_filtered::<(&Name, Entity), With<Coating>>().iter(world))
            .map(|(name, prop)| (name.to_string(), prop))
            .collect();
        props.sort();
        props.into_iter().map(|(_, prop)| prop).collect()
    }

    fn places(&self) -> BTreeMap<PanelWidget, Rect> {
        self.studio.app.world().resource::<CoatingPanel>().places().collect()
    }

    fn age_of(&self, prop: Entity) -> f64 {
        self.studio.app.world().get::<FilmClock>(prop).expect("a clock").age()
    }
}

#[test]
fn sliders_and_buttons_change_the_coating_and_nothing_else_does() {
    let Some(mut desk) = Desk::with_plates() else { return };
    let props = desk.props();
    assert_eq!(desk.prop(), props[0], "the first by name");
    let start = desk.settings_of(props[0]);
    desk.world().insert_resource(Writes::default());
    for _ in 0..5 {
        desk.studio.app.update();
    }
    assert_eq!(*desk.world().resource::<Writes>(), Writes::default(), "looking touches nothing");

    // A slider, which starts where it is grasped.
    desk.drag(PanelWidget::Setting("tearing.alpha"), 0.5, 0.9);
    let dragged = desk.settings_of(props[0]);
    assert!(dragged.tearing.alpha > 0.6 && dragged.tearing.alpha < 1.0, "{}", dragged.tearing.alpha);
    let rest = CoatingSettings { tearing: start.tearing.clone(), ..dragged.clone() };
    assert_eq!(rest, start, "nothing else has changed");
    assert_eq!(desk.settings_of(props[1]), start, "nor the other prop");

    // Presets, and what is reset.
    desk.click(PanelWidget::Preset("gentle"));
    let gentle = CoatingSettings::from(Preset::Gentle);
    assert_eq!(desk.settings_of(props[0]), gentle);
    desk.drag(PanelWidget::Setting("adhesion.mean"), 0.2, 0.8);
    assert!(desk.settings_of(props[0]).adhesion.mean > gentle.adhesion.mean);
    desk.click(PanelWidget::Reset("adhesion.mean"));
    assert_eq!(desk.settings_of(props[0]), gentle);
    desk.drag(PanelWidget::Setting("adhesion.decay"), 0.2, 0.9);
    assert_ne!(desk.settings_of(props[0]), gentle);
    desk.click(PanelWidget::ResetAll);
    assert_eq!(desk.settings_of(props[0]), gentle);

    // All props at once.
    desk.click(PanelWidget::AllProps);
    desk.click(PanelWidget::Preset("heavy"));
    let heavy = CoatingSettings::from(Preset::Heavy);
    assert_eq!([desk.settings_of(props[0]), desk.settings_of(props[1])], [heavy.clone(), heavy]);
    desk.click(PanelWidget::AllProps);

    // Files.
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("hull.coating.ron");
    desk.world().resource_mut::<CoatingPanel>().file = file.to_str().expect("a path").to_owned();
    desk.click(PanelWidget::SaveFile);
    assert!(desk.world().resource::<CoatingPanel>().message().starts_with("saved"), "it says so");
    desk.click(PanelWidget::Preset("harsh"));
    desk.click(PanelWidget::LoadFile);
    assert_eq!(desk.settings_of(props[0]), CoatingSettings::from(Preset::Heavy));
    desk.world().resource_mut::<CoatingPanel>().file = "none.coating.ron".to_owned();
    desk.click(PanelWidget::LoadFile);
    assert!(desk.world().resource::<CoatingPanel>().message().contains("none.coating.ron"), "it says why");
    assert_eq!(desk.settings_of(props[0]), CoatingSettings::from(Preset::Heavy));

    // A file that is followed is loaded again when somebody writes it.
    desk.world().resource_mut::<CoatingPanel>().file = file.to_str().expect("a path").to_owned();
    desk.click(PanelWidget::FollowFile);
    assert!(desk.world().resource::<CoatingPanel>().follows_file);
    let text = std::fs::read_to_string(&file).expect("text");
    let gentle = Preset::Gentle.ron();
    assert_ne!(text, gentle);
    let later = std::time::SystemTime::now() + std::time::Duration::from_secs(5);
    std::fs::write(&file, gentle).expect("it can be written");
    let written = std::fs::File::options().append(true).open(&file).expect("a file");
    written.set_modified(later).expect("a later time");
    let is_gentle = |app: &mut App| {
        let coating = app.world().get::<Coating>(props[0]).expect("a coating");
        coating.settings == SettingsSource::from(Preset::Gentle)
    };
    update_until(&mut desk.studio.app, is_gentle);
    desk.click(PanelWidget::FollowFile);
    assert!(!desk.world().resource::<CoatingPanel>().follows_file);
    desk.click(PanelWidget::Preset("heavy"));

    // Another prop.
    desk.click(PanelWidget::Prop(props[1]));
    assert_eq!(desk.prop(), props[1]);
    assert_eq!(desk.studio.broken_pipelines(), Vec::<String>::new());
}

#[test]
fn the_clock_maps_and_states_are_at_hand_and_nothing_moves() {
    let Some(mut desk) = Desk::with_plates() else { return };
    let prop = desk.prop();
    let before = desk.places();
    for (widget, rect) in &before {
        assert!(rect.min.x >= 0.0 && rect.max.x <= SIZE.0 as f32, "{widget:?} lies in the view: {rect:?}");
    }
    let [left, right] = [PanelWidget::Left, PanelWidget::Right].map(|side| desk.place(side));
    assert!(left.right() + 600.0 < right.left(), "there is room for the scene: {left:?} {right:?}");
    assert!(desk.place(PanelWidget::RestoreState).max.y < desk.place(PanelWidget::Bottom).min.y, "all of it fits");

    // The bar of ages goes forward and back.
    desk.drag(PanelWidget::Age, 0.05, 0.6);
    let bar = desk.place(PanelWidget::Age);
    update_until(&mut desk.studio.app, |app| app.world().get::<FilmClock>(prop).is_some_and(|c| c.sought().is_none()));
    let there = desk.age_of(prop);
    assert!((there - 0.6).abs() < 0.05, "{there}");
    desk.click(PanelWidget::SaveState);
    let saved = film_state(&desk.studio.app, prop).digest();
    desk.drag(PanelWidget::Age, 0.6, 0.2);
    update_until(&mut desk.studio.app, |app| app.world().get::<FilmClock>(prop).is_some_and(|c| c.sought().is_none()));
    assert!(desk.age_of(prop) < 0.25, "{}", desk.age_of(prop));
    assert_eq!(desk.place(PanelWidget::Age), bar);
    desk.click(PanelWidget::RestoreState);
    update_until(&mut desk.studio.app, |app| film_state(app, prop).digest() == saved);
    assert_eq!(desk.age_of(prop), there);

    // The clock.
    desk.click(PanelWidget::Run);
    assert!(!desk.world().resource::<CoatingClock>().paused);
    desk.click(PanelWidget::Run);
    assert!(desk.world().resource::<CoatingClock>().paused);
    let steps = desk.world().get::<FilmClock>(prop).expect("a clock").steps;
    desk.click(PanelWidget::Step);
    update_until(&mut desk.studio.app, |app| app.world().get::<FilmClock>(prop).is_some_and(|c| c.steps > steps));
    assert_eq!(desk.world().get::<FilmClock>(prop).expect("a clock").steps, steps + 1);
    let speed = desk.world().resource::<CoatingClock>().age_per_second;
    desk.drag(PanelWidget::Speed, 0.5, 0.9);
    assert!(desk.world().resource::<CoatingClock>().age_per_second > speed);

    // Maps.
    for map in HeatMap::ALL {
        desk.click(PanelWidget::Heat(Some(map)));
        assert_eq!(desk.world().get::<HeatMapView>(prop), Some(&HeatMapView::new(map)));
    }
    desk.click(PanelWidget::Heat(None));
    assert_eq!(desk.world().get::<HeatMapView>(prop), None);
    let enabled = |desk: &mut Desk| desk.world().resource::<GizmoConfigStore>().config::<CoatingGizmos>().0.enabled;
    assert!(!enabled(&mut desk));
    desk.click(PanelWidget::Gizmos);
    assert!(enabled(&mut desk));
    desk.click(PanelWidget::Gizmos);

    // After all that every widget is where it was, but for the handle of what was dragged.
    let after = desk.places();
    for (widget, rect) in &before {
        let now = after[widget];
        assert!((now.min - rect.min).length() < 0.01 && (now.max - rect.max).length() < 0.01, "{widget:?} has moved");
    }
    assert_eq!(desk.studio.broken_pipelines(), Vec::<String>::new());
}

#[test]
fn the_panel_over_the_sign_can_be_looked_at() {
    let Some(mut desk) = Desk::open("assets") else { return };
    desk.world().insert_resource(ClearColor(Color::srgb(0.55, 0.6, 0.64)));
    let scene =
        desk.world().resource::<AssetServer>().load(GltfAssetLabel::Scene(0).from_asset("city/street_sign.glb"));
    let coating = Coating::new(Preset::Default).with_seed(3).with_triangles(6000).with_steps_per_age(200);
    let sign = desk.world().spawn((Name::new("street sign"), WorldAssetRoot(scene), coating)).id();
    for (i, name) in ["mailbox", "a long name of a prop that does not fit"].into_iter().enumerate() {
        let mesh = add_mesh(&mut desk.studio.app, plate(6));
        let at = Transform::from_xyz(50.0 + 3.0 * i as f32, 0.0, 0.0);
        desk.world().spawn((Name::new(name), Mesh3d(mesh), at, quick_coating().with_seed(i as u64)));
    }
    update_until(&mut desk.studio.app, |app| {
        let status = app.world().resource::<CoatingStatus>();
        status.films >= 3 && status.waiting == 0
    });
    for step in 0..40 {
        let mut clock = desk.world().resource_mut::<CoatingClock>();
        clock.paused = true;
        clock.request_steps(if step == 0 { 1 } else { 3 });
        desk.studio.app.update();
    }
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let world = desk.world();
    let mut boxes =
        world.query_filtered::<(&bevy::camera::primitives::Aabb, &GlobalTransform, &CoatedBy), With<FilmClock>>();
    for (aabb, at, _) in boxes.iter(world).filter(|(.., coated_by)| coated_by.0 == sign) {
        let middle = at.transform_point(aabb.center.into());
        let half = Vec3::from(aabb.half_extents);
        (low, high) = (low.min(middle - half), high.max(middle + half));
    }
    println!("the sign lies between {low} and {high}");
    let (target, size) = (low.midpoint(high), (high - low).length());
    let eye = target + Vec3::new(0.25, 0.1, 1.0).normalize() * size * 1.5;
    desk.world().init_resource::<CoatingBrush>();
    desk.click(PanelWidget::Prop(sign));
    assert_eq!(desk.prop(), sign);
    desk.click(PanelWidget::Brush("weaken"));
    let plain = desk.studio.shoot(eye, target);
    save(&plain, "panel");
    desk.click(PanelWidget::Heat(Some(HeatMap::Adhesion)));
    let middle = desk.place(PanelWidget::Setting("adhesion.mean")).center();
    desk.send(egui::Event::PointerMoved(pos2(desk.place(PanelWidget::Left).left() + 40.0, middle.y)));
    // Long enough for the explanation to appear, and some steps whose times can be seen.
    for _ in 0..8 {
        take_steps(&mut desk.studio.app, 1);
        std::thread::sleep(std::time::Duration::from_millis(100));
    }
    let heated = desk.studio.shoot(eye, target);
    save(&heated, "panel_heat");
    // What is in the middle has the colours of the map now.
    let middle = |picture: &crate::studio::Picture| {
        let (x, y) = (680usize, 230usize);
        let rows = (y - 60..y + 60).flat_map(|y| (x - 60..x + 60).map(move |x| y * SIZE.0 as usize + x));
        rows.map(|i| picture.pixels[i]).collect::<Vec<_>>()
    };
    let differing = middle(&plain).iter().zip(&middle(&heated)).filter(|(a, b)| a != b).count();
    println!("{differing} of 14400 pixels in the middle differ");
    assert!(differing > 1000, "{differing}");
    assert_eq!(desk.studio.broken_pipelines(), Vec::<String>::new());
}

#[test]
fn a_model_is_baked_with_the_paint_of_the_prop() {
    let Some(mut desk) = Desk::with_plates() else { return };
    let folder = tempfile::tempdir().expect("a folder");
    let model = folder.path().join("hydrant.glb");
    std::fs::copy("assets/props/prop_firehydrant.glb", &model).expect("a model");
    take_steps(&mut desk.studio.app, 20);
    // The group lies at the end of all settings.
    desk.world().resource_mut::<CoatingPanel>().model = model.to_str().expect("a path").to_owned();
    let left = desk.place(PanelWidget::Left);
    desk.send(egui::Event::PointerMoved(left.center()));
    for _ in 0..12 {
        let (unit, delta) = (egui::MouseWheelUnit::Point, egui::vec2(0.0, -4000.0));
        let (phase, modifiers) = (egui::TouchPhase::Move, egui::Modifiers::NONE);
        desk.send(egui::Event::MouseWheel { unit, delta, phase, modifiers });
        std::thread::sleep(std::time::Duration::from_millis(30));
    }
    desk.click(PanelWidget::BakeGroup);
    for _ in 0..30 {
        let (unit, delta) = (egui::MouseWheelUnit::Point, egui::vec2(0.0, -4000.0));
        let (phase, modifiers) = (egui::TouchPhase::Move, egui::Modifiers::NONE);
        desk.send(egui::Event::MouseWheel { unit, delta, phase, modifiers });
        std::thread::sleep(std::time::Duration::from_millis(30));
    }
    desk.click(PanelWidget::Bake);
    let message = |app: &App| app.world().resource::<CoatingPanel>().message().to_owned();
    update_until(&mut desk.studio.app, |app| message(app).starts_with("baked into"));
    let aged = folder.path().join("hydrant_aged.glb");
    let model = gltf::Gltf::open(&aged).expect("a model");
    assert!(model.materials().count() > 1, "metal and primer have come with it");
}

#[test]
fn without_egui_there_is_no_panel_and_no_panic() {
    let mut app = app();
    app.add_plugins(CoatingPanelPlugin);
    spawn_plate(&mut app, 4, quick_coating());
    app.finish();
    app.cleanup();
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 3);
    assert_eq!(app.world().resource::<CoatingPanel>().places().count(), 0);
}

#[test]
fn a_brush_is_taken_from_the_panel_and_strokes_are_taken_back() {
    let Some(mut desk) = Desk::with_plates() else { return };
    desk.world().init_resource::<CoatingBrush>();
    desk.studio.app.update();
    let brush = |desk: &Desk| desk.studio.app.world().resource::<CoatingBrush>().clone();
    desk.click(PanelWidget::Brush("weaken"));
    assert_eq!(brush(&desk).effect, Some(Effect::Adhesion(Change::Multiply(0.7))));
    assert!(brush(&desk).blocked, "the pointer is over the panel");
    desk.drag(PanelWidget::BrushRadius, 0.2, 0.4);
    assert_ne!(brush(&desk).radius, CoatingBrush::default().radius);
    desk.send(egui::Event::PointerMoved(pos2(640.0, 300.0)));
    desk.studio.app.update();
    assert!(!brush(&desk).blocked, "it is over the films");
    desk.click(PanelWidget::Brush("weaken"));
    assert_eq!(brush(&desk).effect, None, "it is put away");

    let prop = desk.prop();
    let place = desk.studio.app.world().get::<GlobalTransform>(prop).expect("a place");
    let middle = place.transform_point(Vec3::new(0.5, 0.5, 0.0));
    desk.world().commands().entity(prop).touch_at(TouchAt::new(middle, 0.2, Effect::Strip).in_stroke(1));
    desk.studio.app.update();
    let gone = |app: &App| app.world().get::<FilmMesh>(prop).expect("a film").topology.removed_face_count();
    let stripped = gone(&desk.studio.app);
    assert!(stripped > 0);
    desk.click(PanelWidget::Undo);
    update_until(&mut desk.studio.app, |app| gone(app) == 0);
    desk.click(PanelWidget::Redo);
    update_until(&mut desk.studio.app, |app| gone(app) == stripped);
}
