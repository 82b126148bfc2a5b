//! Where rust runs off a lone crack (VC figs. 9 and 10), and where dust gathers (VC fig. 11).

use bevy_coating::{
    film::VertexId,
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    stain::{Environment, RustSource},
};
use bevy_math::Vec3;

use super::{
    exhibit::{Beginning, Exhibit, NoFilm, Shape, held, weaken_chain},
    spread::{Spread, over_seeds},
};

const STEPS: u32 = 250;
/// Upper end and lower end of the lone crack, in metres from the middle of the plate.
pub const CRACK: [Vec3; 2] = [Vec3::new(-0.12, 0.36, 0.0), Vec3::new(0.02, 0.14, 0.0)];

/// Returns the plate with a lone crack.
pub fn cracked_plate(seed: u64) -> Exhibit {
    let plate = Exhibit::new("crack", "", Shape::Plate(3_012), held_with_rust());
    Exhibit { seed, beginning: Beginning::Cracked(vec![CRACK]), ..plate }
}

/// Returns settings under which nothing but rust happens by itself, and dust does not.
fn held_with_rust() -> CoatingSettings {
    let mut settings = held();
    settings.dust.rate = 0.0;
    settings
}

fn sources(film: &FilmState) -> Vec<VertexId> {
    let is_source = |v: &VertexId| film.stains.sources[v.index()] == RustSource::Present;
    film.mesh.topology.all_vertices().filter(is_source).collect()
}

/// Returns the rust on film and metal, in layers times square metres, with the place at rest where it is.
fn rust(film: &FilmState) -> Vec<(f64, Vec3)> {
    let (stains, rest) = (&film.stains, &film.mesh.geometry.rest_positions);
    let layers = [&stains.film, &stains.metal].map(|layer| {
        let amount = |(v, &area): (usize, &f32)| (f64::from(layer.rust(v)) * f64::from(area), rest[v]);
        layer.areas.iter().enumerate().map(amount).collect::<Vec<_>>()
    });
    layers.concat()
}

/// Rust of a lone crack.
pub struct RunOff {
    /// Number of sources.
    pub sources: Spread,
    /// Share of the plates on which a crack that went on downward took its source along, and one that went on upward
    /// did not.
    pub moves: Spread,
    /// Share of the rust that lies below the crack's lower end.
    pub below: Spread,
    /// Rust that lies above the crack's upper end over that which lies below its lower one.
    pub above: Spread,
    /// Rust from 0.2 to 0.3 m below the lower end over that from 0 to 0.1 m.
    pub fading: Spread,
    /// Deviation of the rust from a plumb line through the source, in metres.
    pub width: Spread,
}

/// Measures the rust of a lone crack at age 1.
///
/// # Errors
/// [`NoFilm`] if there is no plate.
pub fn run_off() -> Result<RunOff, NoFilm> {
    let [sources, moves, below, above, fading, width] = over_seeds(|seed| {
        let plate = cracked_plate(seed);
        let mut film = plate.film(STEPS)?;
        film.step(&plate.settings, &Environment::default());
        let moved = moves_with_the_crack(&film, &plate.settings);
        let found = sources(&film);
        let ends = found.iter().map(|v| film.mesh.geometry.rest_positions[v.index()]);
        let source = ends.min_by(|a, b| a.y.total_cmp(&b.y)).unwrap_or(Vec3::NAN);
        film.age_to(1.0, &plate.settings, &Environment::default());
        let rust = rust(&film);
        let within = |low: f32, high: f32| -> f64 {
            rust.iter().filter(|(_, p)| (low..high).contains(&(source.y - p.y))).map(|(amount, _)| amount).sum()
        };
        let all: f64 = rust.iter().map(|(amount, _)| amount).sum();
        // From half an edge above the lower end: the source itself is a vertex of its own area.
        let below = within(-0.014, 2.0);
        let above = within(-2.0, source.y - CRACK[0].y - 0.014);
        let squares = rust.iter().map(|(amount, p)| amount * f64::from((p.x - source.x) * (p.x - source.x)));
        let width = (squares.sum::<f64>() / all).sqrt();
        Ok([found.len() as f64, moved, below / all, above / below, within(0.2, 0.3) / within(0.0, 0.1), width])
    })?;
    Ok(RunOff { sources, moves, below, above, fading, width })
}

/// Returns 1 if the source of the film's crack goes with it when it goes on downward, and stays when it goes on upward;
/// else 0 (VC fig. 9).
fn moves_with_the_crack(film: &FilmState, settings: &CoatingSettings) -> f64 {
    let before = sources(film);
    let longer = |from: Vec3, to: Vec3| {
        let mut film = film.clone();
        weaken_chain(&film.mesh, &mut film.forces, from, to);
        film.step(settings, &Environment::default());
        let sources = sources(&film);
        let lowest = sources.first().map(|v| film.mesh.geometry.rest_positions[v.index()].y);
        (sources.len(), lowest.unwrap_or_default(), sources)
    };
    let (count, down, _) = longer(CRACK[1], CRACK[1] - 0.12 * Vec3::Y);
    let (_, _, up) = longer(CRACK[0], CRACK[0] + Vec3::new(-0.05, 0.08, 0.0));
    f64::from(u8::from(count == 1 && down < CRACK[1].y - 0.08 && up == before))
}

/// What dust depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Factor {
    Height,
    Direction,
    Curvature,
    All,
}

impl Factor {
    pub const EVERY: [Self; 4] = [Self::Height, Self::Direction, Self::Curvature, Self::All];

    /// Returns settings of sound paint on which dust gathers by this factor: each alone with all its weight.
    pub fn settings(self) -> CoatingSettings {
        let mut settings = CoatingSettings::from(Preset::Paper);
        (settings.adhesion.mean, settings.tearing.weak_probability, settings.tearing.binding) = (100.0, 0.0, 1e6);
        let dust = &mut settings.dust;
        dust.rate *= 1.6;
        match self {
            Self::Height => (dust.height, dust.direction, dust.curvature) = (1.0, 0.0, 0.0),
            Self::Direction => (dust.height, dust.direction, dust.curvature) = (0.0, 1.0, 0.0),
            Self::Curvature => (dust.height, dust.direction, dust.curvature) = (0.0, 0.0, 1.0),
            Self::All => {}
        }
        settings
    }
}

/// Age at which dust is compared.
pub const DUST_AGE: f64 = 0.7;

/// Returns how much more dust there is on the vase where the factor says so, for height, direction and curvature each
/// alone: at the foot over the top, on what faces up over what faces down, and in hollows over ridges.
///
/// # Errors
/// [`NoFilm`] if there is no vase.
pub fn dust() -> Result<[Spread; 3], NoFilm> {
    over_seeds(|seed| {
        let ratio = |factor: Factor, much: &dyn Fn(&FilmState, usize) -> f32| {
            let settings = factor.settings();
            let vase = Exhibit { seed, ..Exhibit::new("dust", "", Shape::Vase(6_000), settings.clone()) };
            let mut film = vase.film(50)?;
            film.age_to(DUST_AGE, &settings, &Environment::default());
            let mut places: Vec<(f32, f32)> = (0..film.mesh.topology.original_vertex_count())
                .map(|v| (much(&film, v), film.stains.film.dust[v]))
                .collect();
            places.sort_by(|a, b| a.0.total_cmp(&b.0));
            let tenth = places.len() / 10;
            let mean = |places: &[(f32, f32)]| places.iter().map(|(_, dust)| f64::from(*dust)).sum::<f64>();
            Ok::<f64, NoFilm>(mean(&places[places.len() - tenth..]) / mean(&places[..tenth]))
        };
        let rest = |film: &FilmState, v: usize| film.mesh.geometry.rest_positions[v].y;
        let facing = |film: &FilmState, v: usize| film.mesh.geometry.rest_normals[v].y;
        let hollow = |film: &FilmState, v: usize| -super::curvature::bend_at(&film.mesh, VertexId::new(v));
        Ok([
            ratio(Factor::Height, &|film, v| -rest(film, v))?,
            ratio(Factor::Direction, &facing)?,
            ratio(Factor::Curvature, &hollow)?,
        ])
    })
}
