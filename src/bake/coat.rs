//! Makes films of meshes, which share a budget of triangles.

use bevy_math::Vec3;

use super::{
    error::{BakeError, BrokenFilm},
    model::{ModelMesh, Place, Slot},
    options::{BakeOptions, Resolution},
    parallel,
    warning::BakeWarning,
};
use crate::{
    remesh::{self, BuiltFilm, FilmResolution},
    sim::FilmState,
    surface::{BuildError, Surface},
};

/// Fewest triangles of a film, however small its share of the surface is.
const LEAST_TRIANGLES: u32 = 12;

/// A prop and the film that was made for it.
#[derive(Clone, Debug)]
pub struct Prop {
    /// Name of the node or mesh.
    pub name: String,
    /// The prop's own surface, around [`Self::origin`].
    pub surface: Surface,
    /// Place in the scene where the surface's zero lies.
    pub origin: Vec3,
    /// Attributes and material of each slot of the surface.
    pub slots: Vec<Slot>,
    /// Place in the document that the model was read from.
    pub place: Option<Place>,
    /// The film at rest.
    pub built: BuiltFilm,
    /// Seed of the film. The first prop has the seed of the options, others have one that follows from it.
    pub seed: u64,
}

/// Props with their films.
#[derive(Debug, Default)]
pub struct Coated {
    /// The props.
    pub props: Vec<Prop>,
    /// The props' films, fresh, one to one.
    pub films: Vec<FilmState>,
    /// Everything that was put right or left out.
    pub warnings: Vec<BakeWarning>,
}

/// Makes a fresh film for every mesh: the first step of [`bake`](super::bake()), for tools that do the ageing
/// themselves. Meshes that are all slivers are left out with a warning, unless there is nothing else. `origin` is the
/// name of the input in messages.
///
/// ```
/// use bevy_coating::bake::{BakeOptions, Images, Input, coat};
///
/// let model = Input::parse("curved:80".as_ref())?.read(0, Images::Skip)?;
/// let options = BakeOptions::default();
/// let mut coated = coat(&model.origin, model.meshes, &options)?;
/// coated.films[0].step(&options.settings, &options.environment);
/// assert_eq!(coated.films[0].clock.steps, 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BakeError::Build`] if no film can be made of a mesh, [`BakeError::Broken`] if a film that came with a mesh is no
/// oriented manifold.
pub fn coat(origin: &str, meshes: Vec<ModelMesh>, options: &BakeOptions) -> Result<Coated, BakeError> {
    let areas: Vec<f64> = meshes.iter().map(|mesh| area(&mesh.surface)).collect();
    let resolutions: Vec<FilmResolution> = match options.resolution {
        Resolution::Keep => vec![FilmResolution::Keep; meshes.len()],
        Resolution::Triangles(budget) => share(budget, &areas).into_iter().map(FilmResolution::Triangles).collect(),
    };
    let mut jobs: Vec<Job> = meshes
        .into_iter()
        .zip(resolutions)
        .enumerate()
        .map(|(i, (mesh, resolution))| Job { seed: film_seed(options.seed, i), mesh, resolution, result: None })
        .collect();
    parallel::for_each(&mut jobs, |job| job.run(options));

    let mut coated = Coated::default();
    let mut nothing = None;
    for Job { mesh, result, seed, .. } in jobs {
        let ModelMesh { name, surface, origin: at, slots, place, .. } = mesh;
        let broken = |source| BakeError::Broken { origin: origin.into(), mesh: name.clone(), source };
        match result {
            Some(Ok((built, film))) => {
                let warnings = built.warnings.iter().cloned();
                coated.warnings.extend(warnings.map(|warning| BakeWarning::Build { mesh: name.clone(), warning }));
                coated.films.push(film.ok_or_else(|| broken(BrokenFilm::NotManifold))?);
                coated.props.push(Prop { name, surface, origin: at, slots, place, built, seed });
            }
            Some(Err(source @ (BuildError::NoTriangles | BuildError::AllDegenerate { .. }))) => {
                coated.warnings.push(BakeWarning::LeftOut { mesh: name.clone(), cause: source.clone() });
                nothing = Some(BakeError::Build { origin: origin.into(), mesh: name, source });
            }
            Some(Err(source)) => return Err(BakeError::Build { origin: origin.into(), mesh: name, source }),
            None => return Err(broken(BrokenFilm::NotBuilt)),
        }
    }
    match nothing {
        Some(error) if coated.films.is_empty() => Err(error),
        _ => Ok(coated),
    }
}

/// The build of one film.
struct Job {
    mesh: ModelMesh,
    resolution: FilmResolution,
    seed: u64,
    result: Option<Result<(BuiltFilm, Option<FilmState>), BuildError>>,
}

impl Job {
    fn run(&mut self, options: &BakeOptions) {
        let built = match self.mesh.film.take() {
            Some(film) => Ok(film),
            None => remesh::build_film(&self.mesh.surface, self.resolution, self.seed),
        };
        self.result = Some(built.map(|built| {
            let mut film = FilmState::new(&built, &options.settings, self.seed, options.steps);
            if let Some(film) = &mut film {
                film.quality = options.quality;
            }
            (built, film)
        }));
    }
}

/// Returns the seed of film `index`. The first film has the seed itself, so that one mesh alone and the same mesh as
/// the first of many age alike; others differ, so that four wheels do not crack alike.
fn film_seed(seed: u64, index: usize) -> u64 {
    seed.wrapping_add((index as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// Shares `budget` triangles by area. Films too small for [`LEAST_TRIANGLES`] get that; the others share
/// the rest.
fn share(budget: u32, areas: &[f64]) -> Vec<u32> {
    if let [_] = areas {
        return vec![budget];
    }
    let least = f64::from(LEAST_TRIANGLES);
    let mut small = vec![false; areas.len()];
    loop {
        let taken = small.iter().filter(|&&small| small).count() as f64 * least;
        let rest = (f64::from(budget) - taken).max(0.0);
        let area: f64 = areas.iter().zip(&small).filter(|&(_, &small)| !small).map(|(&area, _)| area).sum();
        let part = |own: f64| if area > 0.0 { rest * own / area } else { 0.0 };
        let mut changed = false;
        for (&own, small) in areas.iter().zip(&mut small) {
            if !*small && part(own) < least {
                (*small, changed) = (true, true);
            }
        }
        if !changed {
            let parts = areas.iter().zip(&small);
            return parts
                .map(|(&own, &small)| if small { LEAST_TRIANGLES } else { part(own).round() as u32 })
                .collect();
        }
    }
}

/// Area of all triangles that can be measured.
fn area(surface: &Surface) -> f64 {
    let corner = |v: u32| surface.positions.get(v as usize).map(|p| p.as_dvec3());
    let areas = surface.triangles.iter().filter_map(|&[a, b, c]| {
        let (a, b, c) = (corner(a)?, corner(b)?, corner(c)?);
        Some((b - a).cross(c - a).length() * 0.5).filter(|area| area.is_finite())
    });
    areas.sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_budget_is_shared_by_area_with_a_minimum() {
        assert_eq!(share(4000, &[2.0]), [4000]);
        assert_eq!(share(1000, &[3.0, 1.0]), [750, 250]);
        assert_eq!(share(1000, &[1.0, 1e-9]), [988, LEAST_TRIANGLES]);
        assert_eq!(share(4, &[1.0, 1.0]), [LEAST_TRIANGLES; 2]);
        assert_eq!(share(100, &[0.0, 0.0]), [LEAST_TRIANGLES; 2]);
    }
}
