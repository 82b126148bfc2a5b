//! Sources, ways of run-off, streaks.

use bevy_math::Quat;

use super::*;

fn age_one(film: &mut FilmState, settings: &CoatingSettings, environment: &Environment) {
    film.age_to(1.0, settings, environment);
    film.validate().unwrap();
}

#[test]
fn the_lower_end_of_a_crack_is_its_only_source() {
    let settings = held();
    let mut film = plate(1500, &settings, 100);
    crack(&mut film, Vec3::new(-0.1, 0.3, 0.0), Vec3::new(0.05, 0.0, 0.0));
    let lower = nearest(&film, Vec3::new(0.05, 0.0, 0.0));
    film.step(&settings, &Environment::default());
    assert_eq!(sources(&film), [lower]);
    // It runs on further down: the source goes with it.
    crack(&mut film, Vec3::new(0.05, 0.0, 0.0), Vec3::new(0.0, -0.2, 0.0));
    film.step(&settings, &Environment::default());
    assert_eq!(sources(&film), [nearest(&film, Vec3::new(0.0, -0.2, 0.0))]);
    assert_eq!(film.stains.sources[lower.index()], RustSource::Past);
    // And further up: it stays where it is.
    let before = sources(&film);
    crack(&mut film, Vec3::new(-0.1, 0.3, 0.0), Vec3::new(-0.2, 0.4, 0.0));
    film.step(&settings, &Environment::default());
    assert_eq!(sources(&film), before);
}

#[test]
fn an_edge_that_lies_level_makes_no_source() {
    let settings = held();
    let mut film = plate(1500, &settings, 100);
    let edge = crack(&mut film, Vec3::new(-0.1, 0.0, 0.0), Vec3::new(0.1, 0.0, 0.0))[0];
    for v in [film.mesh.topology.origin(edge), film.mesh.topology.target(edge)] {
        film.mesh.geometry.rest_positions[v.index()].y = 0.0;
        film.mesh.geometry.positions[v.index()].y = 0.0;
    }
    for h in film.mesh.topology.all_half_edges().collect::<Vec<_>>() {
        if film.mesh.topology.edge(h) != film.mesh.topology.edge(edge) {
            film.forces.set_binding(&film.mesh.topology, h, 1e6);
        }
    }
    film.step(&settings, &Environment::default());
    assert_eq!(film.forces.torn_edges, 1);
    assert_eq!(sources(&film), []);
}

#[test]
fn rust_runs_down_from_the_source_and_fades() {
    let settings = held();
    let mut film = plate(3012, &settings, 250);
    crack(&mut film, Vec3::new(0.0, 0.35, 0.0), Vec3::new(0.02, 0.3, 0.0));
    film.step(&settings, &Environment::default());
    let source = film.mesh.geometry.rest_positions[sources(&film)[0].index()];
    age_one(&mut film, &settings, &Environment::default());
    let layers = |from: f32, to: f32| {
        let within = |p: &Vec3| (from..to).contains(&(source.y - p.y)) && (p.x - source.x).abs() < 0.25;
        let amounts = amounts(&film);
        let rust = amounts.iter().zip(&film.mesh.geometry.rest_positions);
        rust.filter(|(_, p)| within(p)).map(|(amount, _)| amount).sum::<f64>() / f64::from(to - from)
    };
    assert_eq!(layers(-1.0, -0.03), 0.0, "none above");
    let bands: Vec<f64> = (0..6).map(|i| layers(0.1 * i as f32 + 0.02, 0.1 * i as f32 + 0.12)).collect();
    assert!(bands.windows(2).all(|pair| pair[1] < pair[0]), "{bands:?}");
    // A stream that deposits k on its way at speed u has left wet and stained rust of exp(-k x / u) (1 + k (1 - x / u))
    // at a distance of x after one unit of age.
    let left = |x: f64| (-4.0 * x / 1.5).exp() * (1.0 + 4.0 * (1.0 - x / 1.5));
    let (found, expected) = (bands[2] / bands[0], left(0.27) / left(0.07));
    assert!((found / expected - 1.0).abs() < 0.15, "fades to {found} for {expected}");
    let sideways = mean(&film, |p| (p.x - source.x) * (p.x - source.x)).sqrt();
    assert!((0.01..0.08).contains(&sideways), "a streak {sideways} m wide");
    let drift = mean(&film, |p| p.x - source.x);
    assert!(drift.abs() < 0.02, "straight down: {drift}");
}

#[test]
fn turned_gravity_and_wind_turn_the_run_off() {
    let settings = held();
    let ran = |environment: &Environment| {
        let mut film = plate(2000, &settings, 100);
        crack(&mut film, Vec3::new(0.05, 0.05, 0.0), Vec3::new(-0.05, -0.05, 0.0));
        film.step(&settings, environment);
        age_one(&mut film, &settings, environment);
        let source = film.mesh.geometry.rest_positions[sources(&film)[0].index()];
        (mean(&film, |p| p.x - source.x), mean(&film, |p| p.y - source.y))
    };
    let (x, y) = ran(&Environment::default());
    assert!(x.abs() < 0.03 && y < -0.1, "{x} {y}");
    let (x, y) = ran(&Environment::still(Vec3::NEG_X));
    assert!(x < -0.1 && y.abs() < 0.03, "{x} {y}");
    let (x, y) = ran(&Environment { wind: Vec3::X, ..Environment::default() });
    assert!(x > 0.1 && (x + y).abs() < 0.04, "as far sideways as down: {x} {y}");
}

#[test]
fn gravity_that_turns_half_way_turns_the_run_off_from_then_on() {
    let settings = held();
    let mut film = plate(2000, &settings, 100);
    crack(&mut film, Vec3::new(0.05, 0.1, 0.0), Vec3::new(0.0, 0.0, 0.0));
    film.age_to(0.5, &settings, &Environment::default());
    let before = film.stains.clone();
    let level = |film: &FilmState| (mean(film, |p| p.x), mean(film, |p| p.y));
    let (_, down) = level(&film);
    film.age_to(1.0, &settings, &Environment::still(Vec3::X));
    film.validate().unwrap();
    let (side, still_down) = level(&film);
    assert!(side > 0.05 && still_down > down, "{side}, {down} to {still_down}");
    for (v, stained) in before.film.stained.iter().enumerate() {
        assert!(film.stains.film.stained[v] >= *stained, "stains stay");
    }
}

#[test]
fn streaks_keep_to_the_metre_on_finer_films() {
    let mut settings = held();
    settings.rust.into_cracks = 0.0;
    let streak = |triangles| {
        let mut film = plate(triangles, &settings, 250);
        crack(&mut film, Vec3::new(-0.06, 0.35, 0.0), Vec3::new(0.0, 0.3, 0.0));
        film.step(&settings, &Environment::default());
        let source = film.mesh.geometry.rest_positions[sources(&film)[0].index()];
        age_one(&mut film, &settings, &Environment::default());
        let length = mean(&film, |p| source.y - p.y);
        (length, mean(&film, |p| (p.x - source.x) * (p.x - source.x)).sqrt(), film.stains.budget.emitted)
    };
    let (length, width, emitted) = streak(3012);
    for triangles in [1500, 6000, 12_000] {
        let (l, w, e) = streak(triangles);
        println!("{triangles}: length {l} for {length}, width {w} for {width}, emitted {e} for {emitted}");
        assert!((l / length - 1.0).abs() < 0.1, "{triangles}: length {l} for {length}");
        assert!((w / width - 1.0).abs() < 0.35, "{triangles}: width {w} for {width}");
        assert!((e / emitted - 1.0).abs() < 0.25, "{triangles}: emitted {e} for {emitted}");
    }
}

#[test]
fn run_off_does_not_depend_on_the_number_of_steps() {
    let settings = held();
    let run = |steps| {
        let mut film = plate(1500, &settings, steps);
        film.step(&settings, &Environment::default());
        crack(&mut film, Vec3::new(-0.1, 0.35, 0.0), Vec3::new(0.0, 0.2, 0.0));
        film.age_to(0.4, &settings, &Environment::default());
        crack(&mut film, Vec3::new(0.3, 0.3, 0.0), Vec3::new(0.2, -0.1, 0.0));
        age_one(&mut film, &settings, &Environment::default());
        let m = film.measure();
        assert!(m.sources == 2 && m.rust_dripped > 0.0, "{m:?}");
        [m.rust_emitted, m.rust_wet, m.rust_stained, m.rust_dripped, m.dust_mean.unwrap(), mean(&film, |p| p.y + 1.0)]
    };
    let reference = run(1000);
    for steps in [100, 250, 333, 4000] {
        for (a, b) in run(steps).into_iter().zip(reference) {
            assert!((a / b - 1.0).abs() < 0.03, "{steps} steps: {a} for {b}");
        }
    }
}

#[test]
fn run_off_crosses_cracks_and_falls_into_them() {
    let mut settings = held();
    let mut across = |into_cracks: f32| {
        settings.rust.into_cracks = into_cracks;
        let mut film = plate(3012, &settings, 100);
        crack(&mut film, Vec3::new(0.02, 0.35, 0.0), Vec3::new(0.0, 0.25, 0.0));
        // A wide level crack in the way. The parts of it that slope have sources of their own: none is to give
        // anything.
        let edges = crack(&mut film, Vec3::new(-0.25, 0.1, 0.0), Vec3::new(0.25, 0.1, 0.0));
        film.step(&settings, &Environment::default());
        let upper = nearest(&film, Vec3::new(0.0, 0.25, 0.0));
        for v in sources(&film).into_iter().filter(|&v| v != upper) {
            film.stains.sources[v.index()] = RustSource::Never;
        }
        age_one(&mut film, &settings, &Environment::default());
        let metal = film.stains.metal.rust_of_all();
        let below: f64 = amounts(&film)
            .iter()
            .zip(&film.mesh.geometry.rest_positions)
            .filter(|(_, p)| p.y < 0.05)
            .map(|(amount, _)| amount)
            .sum();
        assert!(edges.len() > 10 && below > 0.0, "goes on below: {below}");
        metal
    };
    assert_eq!(across(0.0), 0.0);
    assert!(across(0.5) > 0.0 && across(1.0) > across(0.5));
}

impl StainLayer {
    fn rust_of_all(&self) -> f64 {
        self.areas.iter().enumerate().map(|(v, &area)| f64::from(area) * f64::from(self.rust(v))).sum()
    }
}

#[test]
fn bare_metal_rusts_first_and_metal_under_whole_film_never() {
    let settings = held();
    let mut film = plate(800, &settings, 100);
    film.step(&settings, &Environment::default());
    let face = film.mesh.topology.fan(nearest(&film, Vec3::ZERO)).next().unwrap().face();
    for h in face.half_edges() {
        film.forces.set_binding(&film.mesh.topology, h, 0.0);
    }
    film.age_to(0.3, &settings, &Environment::default());
    assert!(!film.mesh.topology.is_live(face));
    let corrosion = |place: Vec3| film.stains.corrosion[nearest(&film, place).index()];
    assert!(corrosion(Vec3::ZERO) > 0.5);
    assert_eq!(corrosion(Vec3::new(0.3, 0.3, 0.0)), 0.0);
    let most = film.stains.corrosion.iter().copied().fold(0.0, f32::max);
    assert_eq!(corrosion(Vec3::ZERO), most, "{most}");
}

#[test]
fn rust_on_pieces_that_fall_is_gone_with_them() {
    let settings = held();
    let mut film = plate(800, &settings, 100);
    crack(&mut film, Vec3::new(0.02, 0.35, 0.0), Vec3::new(0.0, 0.2, 0.0));
    film.age_to(0.5, &settings, &Environment::default());
    let before = film.measure();
    let stained = film.mesh.topology.live_faces().max_by(|&a, &b| {
        let rust = |f| film.mesh.topology.corners(f).map(|v| film.stains.film.rust(v.index())).iter().sum::<f32>();
        rust(a).total_cmp(&rust(b))
    });
    for h in stained.unwrap().half_edges() {
        film.forces.set_binding(&film.mesh.topology, h, 0.0);
    }
    film.step(&settings, &Environment::default());
    film.validate().unwrap();
    let after = film.measure();
    assert!(after.stripped > before.stripped);
    assert!(after.rust_stained < before.rust_stained && after.rust_dripped > before.rust_dripped);
}

#[test]
fn a_plate_that_is_turned_has_the_same_streaks() {
    let settings = held();
    let turn = Quat::from_rotation_y(0.7) * Quat::from_rotation_x(0.4);
    let run = |turn: Quat| {
        let piece = sample::plate(1000, 1).unwrap();
        let positions = piece.film.positions.iter().map(|&p| turn * p).collect();
        let mesh = FilmMesh::new(positions, &piece.film.triangles).unwrap();
        let mut film = film_of(mesh, &settings, 100);
        let at = |x: f32, y: f32| turn * Vec3::new(x, y, 0.0);
        crack(&mut film, at(-0.1, 0.35), at(0.0, 0.2));
        film.age_to(1.0, &settings, &Environment::still(turn * Vec3::NEG_Y));
        amounts(&film)
    };
    let (plain, turned) = (run(Quat::IDENTITY), run(turn));
    let total: f64 = plain.iter().sum();
    assert!(total > 0.0);
    for (a, b) in plain.iter().zip(&turned) {
        assert!((a - b).abs() < 1e-3 * total, "{a} {b} of {total}");
    }
}
