//! How the shape of the metal moves the age at which paint lets go (VC eq. 4, fig. 8).

use core::f32::consts::PI;

use bevy_coating::{
    film::{FilmMesh, VertexId},
    settings::CoatingSettings,
    sim::FilmState,
    stain::Environment,
};

use super::{
    exhibit::{Exhibit, NoFilm, Shape, paper},
    spread::{SEEDS, Spread, in_parallel, spreads},
};

/// Triangles of the film on the vase.
pub const TRIANGLES: u32 = 6_000;
/// Values of gamma that the paper compares.
pub const GAMMAS: [f32; 3] = [1.0, 2.0, 4.0];
/// Mean bend of the edges opposite a vertex from which its place counts as convex, or below minus which as concave, in
/// radians: 11 degrees.
pub const STEEP: f32 = 0.2;

const STEPS: u32 = 500;
/// Age at which the runs end: by then nearly everything has let go, so that late places are not left out.
const END: f32 = 2.0;

/// Returns the paper's settings with another gamma.
pub fn settings(gamma: f32) -> CoatingSettings {
    let mut settings = paper();
    settings.bending.gamma = gamma;
    settings
}

/// Returns the mean over the edges opposite a vertex of a film at rest of the angle by which they bend, in radians:
/// above 0 where the surface is convex.
pub fn bend_at(mesh: &FilmMesh, v: VertexId) -> f32 {
    let (mut sum, mut count) = (0.0, 0.0f32);
    for h in mesh.topology.fan(v) {
        sum += mesh.geometry.rest_dihedrals[h.next().index()] - PI;
        count += 1.0;
    }
    sum / count.max(1.0)
}

/// Returns by how much the age at which places of the vase let go differs from that without gamma, for each of
/// [`GAMMAS`]: on convex places, and on concave ones.
///
/// The runs are paired: the same film, adhesion and weak edges with and without gamma. Places count that let go in
/// both, not at once and before the end of the run.
///
/// # Errors
/// [`NoFilm`] if there is no vase.
pub fn shifts() -> Result<[[Spread; 2]; 3], NoFilm> {
    let seeds: Vec<u64> = SEEDS.collect();
    let gammas = [0.0, GAMMAS[0], GAMMAS[1], GAMMAS[2]];
    let runs = in_parallel(seeds.len() * gammas.len(), |index| {
        let mut settings = settings(gammas[index % gammas.len()]);
        settings.deform.sweeps_per_age = 0.0;
        let seed = seeds[index / gammas.len()];
        let vase = Exhibit { seed, ..Exhibit::new("vase", "", Shape::Vase(TRIANGLES), settings.clone()) };
        let mut film = vase.film(STEPS)?;
        let vertices = 0..film.mesh.topology.original_vertex_count();
        let bends: Vec<f32> = vertices.map(|v| bend_at(&film.mesh, VertexId::new(v))).collect();
        film.age_to(f64::from(END), &settings, &Environment::default());
        Ok((bends, film))
    });
    let runs = runs.into_iter().collect::<Result<Vec<(Vec<f32>, FilmState)>, NoFilm>>()?;
    let rows: Vec<[f64; 6]> = runs.chunks(gammas.len()).map(shifts_of_seed).collect();
    let all = spreads(&rows);
    Ok(std::array::from_fn(|gamma| [all[2 * gamma], all[2 * gamma + 1]]))
}

/// Returns the shifts of one seed: convex and concave for each gamma. The first run is the one without gamma.
fn shifts_of_seed(runs: &[(Vec<f32>, FilmState)]) -> [f64; 6] {
    let mut shifts = [0.0; 6];
    let [(bends, without), with @ ..] = runs else { return shifts };
    for (shifts, (_, with)) in shifts.as_chunks_mut::<2>().0.iter_mut().zip(with) {
        let mut sums = [(0.0, 0.0f64); 2];
        for (v, bend) in bends.iter().enumerate().filter(|(_, bend)| bend.abs() > STEEP) {
            let ages = [without, with].map(|film| film.forces.separated_age[v]);
            if ages.iter().all(|&age| age > 1.5 / STEPS as f32 && age <= END) {
                let (sum, count) = &mut sums[usize::from(*bend < 0.0)];
                *sum += f64::from(ages[1] - ages[0]);
                *count += 1.0;
            }
        }
        *shifts = sums.map(|(sum, count)| sum / count.max(1.0));
    }
    shifts
}
